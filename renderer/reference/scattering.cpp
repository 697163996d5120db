#include "renderer/reference/scattering.h"

#include "renderer/reference/surface_response.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::reference {
namespace {

/// Smooth surfaces in a row that a ray follows; what is met after them is black.
constexpr std::size_t max_smooth = 64;

double greatest(const glm::dvec3& rgb) { return std::max({rgb.x, rgb.y, rgb.z}); }

/// About the share of light that facets send on, by which a path chooses them; 0..1.
double facet_share(const glm::dvec3& normal, const glm::dvec3& out, double roughness, double index) {
    return photometry::dielectric_reflectance(photometry::facet_cosine(std::clamp(glm::dot(normal, out), 0.0, 1.0), roughness), index);
}

} // namespace

Surface surface_at(const Shot& shot, const SurfaceHit& hit, const glm::dvec3& out) {
    const Scene& scene = shot.embree.scene();
    const Material& material = scene.materials[hit.material];
    Surface surface{hit, response_at(scene, hit), {}, 0.0, 0.0, static_cast<double>(material.glass_index), out};
    if (surface.is_glass()) {
        surface.response = {};
        return surface;
    }
    surface.mirror = static_cast<double>(material.mirror);
    surface.albedo = greatest(surface.response.albedo);
    surface.lobe = retro_lobe(surface.response, surface.albedo + surface.mirror);
    surface.wetness = wetness_at(shot, surface.response);
    return surface;
}

double fresnel_reflectance(double cosine, double ratio) {
    const double c = std::clamp(cosine, 0.0, 1.0), g2 = ratio * ratio - 1.0 + c * c; // g = (n2 / n1) cos(refracted)
    if (g2 <= 0.0)
        return 1.0;
    const double g = std::sqrt(g2), across = (c - g) / (c + g), along = (ratio * ratio * c - g) / (ratio * ratio * c + g);
    return 0.5 * (across * across + along * along);
}

SpecularSplit specular_split(const Surface& surface) {
    SpecularSplit split;
    const glm::dvec3 n = surface.hit.from_behind ? -surface.hit.normal : surface.hit.normal;
    const double cosine = std::clamp(glm::dot(n, surface.out), 0.0, 1.0);
    split.mirrored = glm::normalize(n * (2.0 * cosine) - surface.out);
    if (!surface.is_glass()) {
        split.mirrored_share = surface.hit.from_behind ? 0.0 : surface.mirror;
        return split;
    }
    const double ratio = surface.hit.from_behind ? 1.0 / surface.glass_index : surface.glass_index;
    split.mirrored_share = fresnel_reflectance(cosine, ratio);
    split.refracted_share = 1.0 - split.mirrored_share;
    if (split.refracted_share > 0.0) {
        const double beyond = std::sqrt(std::max(0.0, 1.0 - (1.0 - cosine * cosine) / (ratio * ratio)));
        split.refracted = glm::normalize((n * cosine - surface.out) / ratio - n * beyond);
    }
    return split;
}

Ray leaving(const SurfaceHit& hit, const glm::dvec3& direction) {
    const glm::dvec3 raised = EmbreeScene::raised(hit);
    return {glm::dot(direction, hit.facet_normal) > 0.0 ? raised : 2.0 * hit.point_m - raised, direction};
}

glm::dvec3 lamps_on(const Shot& shot, const Surface& surface, const SamplePoint& point, std::size_t pair, std::uint64_t& rays) {
    glm::dvec3 sum(0.0);
    for (const LitLamp& lamp : shot.moment.lamps) {
        const glm::dvec3 lamp_m = lamp_point_m(shot, lamp, point, pair++), to_lamp = lamp_m - surface.hit.point_m;
        const double cosine = photometry::incidence(surface.hit.normal, to_lamp);
        const double e_perp = cosine > 0.0 ? facing_lx(lamp, lamp_m, surface.hit.point_m) : 0.0;
        if (e_perp <= 0.0)
            continue;
        if (shot.settings.shadows) {
            ++rays;
            if (!shot.embree.visible(surface.hit, lamp_m))
                continue;
        }
        glm::dvec3 reflected = surface.response.albedo * (cosine / pi), beads(0.0);
        if (surface.lobe.is_there())
            beads = surface.response.retro_tint * retro_times_cosine(surface.lobe, photometry::observation_angle(to_lamp, surface.out),
                                                                     cosine, glm::dot(surface.hit.normal, surface.out));
        reflected += beads;
        const double left = air_transmittance(shot.moment.weather, glm::length(to_lamp)); // 1 in clear air
        glm::dvec3 returned = reflected * (e_perp * left);
        if (surface.response.facets.share > 0.0)
            returned += gloss_light(surface.response.facets, surface.hit.normal, glm::normalize(to_lamp), surface.out, e_perp * left);
        if (surface.wetness > 0.0)
            returned =
                partly_wet(returned,
                           wet_light(surface.response.albedo, surface.hit.normal, glm::normalize(to_lamp), surface.out, e_perp * left) +
                               surface.response.retro_wet * (e_perp * left) * beads,
                           surface.wetness);
        sum += lamp.colour.linear_srgb * returned;
    }
    if (const DirectLight* sun = shot.moment.daylight.direct()) {
        const double e = photometry::directional_illuminance(sun->illuminance_lx, surface.hit.normal, sun->towards());
        if (e > 0.0 && shot.settings.shadows)
            ++rays;
        if (e > 0.0 && (!shot.settings.shadows || shot.embree.visible(surface.hit, surface.hit.point_m + sun->towards() * sun_distance_m)))
            sum += partly_wet(surface.response.albedo * (e / pi) + gloss_light(surface.response.facets, surface.hit.normal, sun->towards(),
                                                                               surface.out, sun->illuminance_lx),
                              surface.wetness > 0.0
                                  ? wet_light(surface.response.albedo, surface.hit.normal, sun->towards(), surface.out, sun->illuminance_lx)
                                  : glm::dvec3(0.0),
                              surface.wetness);
    }
    return sum;
}

bool go_on_from(const Surface& surface, const SamplePoint& point, std::size_t pair, Ray& ray, glm::dvec3& weight, bool& specular) {
    const SpecularSplit smooth = specular_split(surface);
    const Facets& facets = surface.response.facets;
    const glm::dvec3& n = surface.hit.normal;
    const double dry = 1.0 - surface.wetness, returning = dry + surface.response.retro_wet * surface.wetness,
                 retro = surface.lobe.returned * returning,
                 film = surface.wetness > 0.0 ? surface.wetness * facet_share(n, surface.out, wet_roughness, photometry::water_index) : 0.0,
                 gloss =
                     facets.share > 0.0 ? dry * facets.share * facet_share(n, surface.out, facets.roughness, photometry::facet_index) : 0.0;
    const double rough = surface.albedo + retro + film + gloss, reflected = rough + smooth.mirrored_share + smooth.refracted_share;
    if (reflected <= 0.0)
        return false;
    const glm::dvec2 choice = point.pair(pair), square = point.pair(pair + 1);
    double lobe_choice = choice.x * reflected; // within its part, over the part's width, uniform again
    specular = lobe_choice >= rough;
    if (lobe_choice < surface.albedo) {
        lobe_choice = choice.x * (reflected / surface.albedo);
        ray.direction = sample_cosine(surface.hit.normal, square);
        weight *= diffuse_reflectance(surface.response.albedo, surface.wetness, glm::dot(surface.hit.normal, ray.direction),
                                      glm::dot(surface.hit.normal, surface.out)) *
                  (reflected / surface.albedo);
    } else if (lobe_choice < surface.albedo + retro) {
        lobe_choice = (lobe_choice - surface.albedo) / retro;
        const RetroSample sample = sample_retro(surface.lobe, surface.out, surface.hit.normal, square, choice.y);
        ray.direction = sample.direction;
        weight *= surface.response.retro_tint * (sample.weight * (reflected / retro) * returning);
    } else if (lobe_choice < surface.albedo + retro + gloss) {
        lobe_choice = (lobe_choice - surface.albedo - retro) / gloss;
        const FacetSample sample = sample_facets(n, surface.out, square, facets.roughness, photometry::facet_index);
        ray.direction = sample.direction;
        weight *= sample.weight * dry * facets.share * (reflected / gloss);
    } else if (!specular) {
        lobe_choice = (lobe_choice - surface.albedo - retro - gloss) / film;
        const FacetSample sample = sample_film(surface.hit.normal, surface.out, square);
        ray.direction = sample.direction;
        weight *= sample.weight * surface.wetness * (reflected / film);
    } else {
        const bool mirrored = lobe_choice - rough < smooth.mirrored_share;
        lobe_choice = mirrored ? (lobe_choice - rough) / smooth.mirrored_share
                               : (lobe_choice - rough - smooth.mirrored_share) / smooth.refracted_share;
        ray.direction = mirrored ? smooth.mirrored : smooth.refracted;
        weight *= reflected;
    }
    const double stay = std::min(1.0, 2.0 * greatest(weight)); // Russian roulette
    if (lobe_choice >= stay)
        return false;
    weight /= stay;
    ray = leaving(surface.hit, ray.direction);
    return surface.is_glass() || glm::dot(ray.direction, surface.hit.facet_normal) > 0.0;
}

std::optional<Surface> cast_past_smooth(const Shot& shot, const SamplePoint& point, std::size_t pair, Ray& ray, std::uint64_t& rays) {
    std::optional<Surface> surface;
    for (std::size_t k = 0; k < max_smooth; ++k) {
        ++rays;
        const std::optional<SurfaceHit> hit = shot.embree.cast(ray);
        if (!hit)
            return std::nullopt;
        surface = surface_at(shot, *hit, -ray.direction);
        if (!surface->is_glass() && (surface->mirror <= 0.0 || hit->from_behind))
            return surface;
        const SpecularSplit split = specular_split(*surface);
        const double choice = point.pair(pair + k).x;
        if (choice < split.mirrored_share)
            ray = leaving(*hit, split.mirrored);
        else if (choice < split.mirrored_share + split.refracted_share)
            ray = leaving(*hit, split.refracted);
        else
            return surface;
    }
    surface->hit.from_behind = true;
    surface->glass_index = 0.0;
    return surface;
}

glm::dvec3 sky_luminance(const Moment& moment, const glm::dvec3& direction) {
    return glm::dvec3(direction.z > 0.0 ? moment.daylight.horizontal_illuminance_lx / pi : 0.0);
}

glm::dvec3 diffuse_reflectance(const glm::dvec3& albedo, double wetness, double cosine_in, double cosine_out) {
    if (wetness <= 0.0)
        return albedo;
    const double in = photometry::facet_cosine(std::max(cosine_in, 0.0), wet_roughness),
                 out = photometry::facet_cosine(std::max(cosine_out, 0.0), wet_roughness);
    glm::dvec3 wet;
    for (int i = 0; i < 3; ++i)
        wet[i] = photometry::wet_albedo(albedo[i], in, out);
    return (1.0 - wetness) * albedo + wetness * wet;
}

FacetSample sample_facets(const glm::dvec3& normal, const glm::dvec3& out, const glm::dvec2& square, double roughness, double index) {
    const auto [u, v] = across(normal);
    const double c_out = glm::dot(normal, out);
    if (c_out <= 0.0)
        return {};
    // E. Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018: on the stretched hemisphere the facets seen are a
    // disc.
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(roughness * glm::dot(u, out), roughness * glm::dot(v, out), c_out));
    const auto [s, t] = across(stretched);
    const double radius = std::sqrt(square.x), turn = 2.0 * pi * square.y, upright = 0.5 * (1.0 + stretched.z);
    // `t` must lie on the side that the horizon cuts: the frame is turned so that `s` is level.
    glm::dvec3 level = glm::cross(glm::dvec3(0.0, 0.0, 1.0), stretched);
    const double slope = glm::length(level);
    level = slope > 1e-9 ? level / slope : s;
    const glm::dvec3 upwards = slope > 1e-9 ? glm::cross(stretched, level) : t;
    const double a = radius * std::cos(turn), full = radius * std::sin(turn),
                 b = (1.0 - upright) * std::sqrt(std::max(0.0, 1.0 - a * a)) + upright * full;
    const glm::dvec3 facet = a * level + b * upwards + std::sqrt(std::max(0.0, 1.0 - a * a - b * b)) * stretched;
    const glm::dvec3 h = glm::normalize(roughness * (u * facet.x + v * facet.y) + normal * std::max(1e-12, facet.z));
    FacetSample sample;
    const double c_h = glm::dot(out, h);
    sample.direction = glm::normalize(2.0 * c_h * h - out);
    const double c_in = glm::dot(normal, sample.direction);
    if (c_in <= 0.0 || c_h <= 0.0)
        return sample;
    // Smith's correlated shadowing of both directions over that of one.
    const double a2 = roughness * roughness, root_out = std::sqrt(a2 + (1.0 - a2) * c_out * c_out),
                 root_in = std::sqrt(a2 + (1.0 - a2) * c_in * c_in);
    sample.weight =
        photometry::dielectric_reflectance(std::min(c_h, 1.0), index) * c_in * (c_out + root_out) / (c_out * root_in + c_in * root_out);
    return sample;
}

namespace {

constexpr double nearest_pass_m = 1e-3; // as fog_light.cpp has it

/// The part of a ray that lies before the lamp: the only one that it lights.
struct LitPart {
    double begin_m = 0.0, end_m = 0.0;
};
LitPart before_lamp(const LitLamp& lamp, const glm::dvec3& lamp_m, const Ray& ray, double way_m) {
    const glm::dvec3 forward = lamp.pose.forward();
    const double at = glm::dot(ray.origin_m - lamp_m, forward), slope = glm::dot(ray.direction, forward);
    const double crossing = slope != 0.0 ? -at / slope : -1.0;
    if (at > 0.0)
        return {0.0, slope < 0.0 ? std::min(way_m, crossing) : way_m};
    return slope > 0.0 ? LitPart{crossing, way_m} : LitPart{};
}

} // namespace

double left_on_way_to_eye(const Shot& shot, const glm::dvec3& point_m) {
    if (!is_in_air(shot) || shot.camera.is_map)
        return 1.0;
    return air_transmittance(shot.moment.weather, glm::length(shot.to_eye(point_m)));
}

glm::dvec3 airlight(const Shot& shot, const glm::dvec3& eye_m, const glm::dvec3& end_m) {
    glm::dvec3 sum(0.0);
    const glm::dvec3& origin_m = shot.embree.origin_m();
    for (const LitLamp& lamp : shot.moment.lamps)
        sum += lamp.colour.linear_srgb * airlight_cdm2(lamp, shot.moment.weather, origin_m + eye_m, origin_m + end_m);
    return sum;
}

glm::dvec3 through_air(const Shot& shot, const Ray& ray, const glm::dvec3& end_m, const glm::dvec3& light) {
    const Weather& weather = shot.moment.weather;
    if (!is_in_air(shot) || shot.camera.is_map)
        return light;
    const double way = glm::length(end_m - ray.origin_m);
    const glm::dvec3 behind = light * air_transmittance(weather, way) + sky_airlight_cdm2(shot.moment.daylight, weather, way);
    return shot.settings.integrator == Integrator::path ? behind : behind + airlight(shot, ray.origin_m, end_m);
}

glm::dvec3 lamps_in_air(const Shot& shot, const Ray& ray, double way_m, const SamplePoint& point, std::size_t pair, std::uint64_t& rays) {
    const Weather& weather = shot.moment.weather;
    glm::dvec3 sum(0.0);
    for (const LitLamp& lamp : shot.moment.lamps) {
        const double choice = point.pair(pair).x;
        const glm::dvec3 lamp_m = lamp_point_m(shot, lamp, point, pair + 1);
        pair += 2;
        const LitPart lit = before_lamp(lamp, lamp_m, ray, way_m);
        if (lit.end_m <= lit.begin_m)
            continue;
        const double nearest_m = glm::dot(lamp_m - ray.origin_m, ray.direction),
                     apart_m = std::max(glm::length(ray.origin_m + nearest_m * ray.direction - lamp_m), nearest_pass_m),
                     first = std::atan((lit.begin_m - nearest_m) / apart_m), last = std::atan((lit.end_m - nearest_m) / apart_m),
                     beyond_m = apart_m * std::tan(first + choice * (last - first)),
                     at_m = std::clamp(nearest_m + beyond_m, lit.begin_m, lit.end_m);
        const glm::dvec3 place_m = ray.origin_m + at_m * ray.direction, from_lamp = place_m - lamp_m;
        const double e = facing_lx(lamp, lamp_m, place_m), d2 = glm::dot(from_lamp, from_lamp);
        if (!(e > 0.0) || !(d2 > 0.0))
            continue;
        if (shot.settings.shadows) {
            ++rays;
            if (!shot.embree.visible(place_m, lamp_m))
                continue;
        }
        // E dt = I / d^2 dt = I / apart d(angle); within a millimetre of the lamp as if that far away.
        const double cd = e * d2, d = std::sqrt(d2);
        sum += lamp.colour.linear_srgb * (weather.extinction_per_m * weather.scattering_albedo * (last - first) / apart_m * cd *
                                          photometry::henyey_greenstein(-glm::dot(from_lamp, ray.direction) / d, weather.asymmetry) *
                                          air_transmittance(weather, d + at_m));
    }
    return sum;
}

glm::dvec3 sample_henyey_greenstein(const glm::dvec3& along, double g, const glm::dvec2& square) {
    double cosine = 1.0 - 2.0 * square.x;
    if (std::abs(g) > 1e-3) {
        const double s = (1.0 - g * g) / (1.0 + g - 2.0 * g * square.x);
        cosine = std::clamp((1.0 + g * g - s * s) / (2.0 * g), -1.0, 1.0);
    }
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), turn = 2.0 * pi * square.y;
    const auto [u, v] = across(along);
    return glm::normalize(along * cosine + (u * std::cos(turn) + v * std::sin(turn)) * sine);
}

} // namespace fernlicht::reference
