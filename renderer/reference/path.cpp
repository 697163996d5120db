#include "renderer/reference/path.h"

#include "renderer/reference/retro_lobe.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fernlicht::reference {
namespace {

/// Pairs of coordinates that the second path of a pixel's sample starts at: beyond those of any first one.
constexpr std::size_t retro_pairs = std::size_t{1} << 24;

double greatest(const glm::dvec3& rgb) { return std::max({rgb.x, rgb.y, rgb.z}); }

struct Surface {
    SurfaceHit hit;
    SurfaceResponse response;
    RetroLobe lobe;
    double albedo = 0.0; ///< the greatest of three
    glm::dvec3 out;      ///< unit, back along the path
};

Surface surface_at(const Shot& shot, const SurfaceHit& hit, const glm::dvec3& out) {
    Surface surface{hit, response_at(shot.embree.scene(), hit), {}, 0.0, out};
    surface.albedo = greatest(surface.response.albedo);
    surface.lobe = retro_lobe(surface.response, surface.albedo);
    return surface;
}

/// Luminance that the lamps give the surface along the path, over this surface alone.
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
        glm::dvec3 reflected = surface.response.albedo * (cosine / pi);
        if (surface.lobe.is_there())
            reflected += retro_times_cosine(surface.lobe, photometry::observation_angle(to_lamp, surface.out), cosine,
                                            glm::dot(surface.hit.normal, surface.out));
        sum += lamp.colour.linear_srgb * reflected * e_perp;
    }
    return sum;
}

/// Draws where the path goes on from the surface and multiplies its weight; false where it ends.
bool go_on_from(const Surface& surface, const SamplePoint& point, std::size_t pair, Ray& ray, glm::dvec3& weight) {
    const double reflected = surface.albedo + surface.lobe.returned;
    if (reflected <= 0.0)
        return false;
    const glm::dvec2 choice = point.pair(pair), square = point.pair(pair + 1);
    double lobe_choice = choice.x;
    if (lobe_choice * reflected < surface.albedo) {
        lobe_choice *= reflected / surface.albedo;
        ray.direction = sample_cosine(surface.hit.normal, square);
        weight *= surface.response.albedo * (reflected / surface.albedo);
    } else {
        lobe_choice = (lobe_choice * reflected - surface.albedo) / surface.lobe.returned;
        const RetroSample sample = sample_retro(surface.lobe, surface.out, surface.hit.normal, square, choice.y);
        ray.direction = sample.direction;
        weight *= sample.weight * (reflected / surface.lobe.returned);
    }
    const double stay = std::min(1.0, 2.0 * greatest(weight)); // Russian roulette: the choice's rest is uniform again
    if (lobe_choice >= stay)
        return false;
    weight /= stay;
    ray.origin_m = EmbreeScene::raised(surface.hit);
    return glm::dot(ray.direction, surface.hit.facet_normal) > 0.0;
}

} // namespace

glm::dvec3 arriving(const Shot& shot, const SamplePoint& point, std::size_t pair, Ray ray, std::uint64_t& rays) {
    const std::size_t pairs_a_bounce = 2 + shot.moment.lamps.size();
    glm::dvec3 sum(0.0), weight(1.0);
    for (int bounce = 0; bounce < shot.settings.most_bounces; ++bounce, pair += pairs_a_bounce) {
        ++rays;
        const std::optional<SurfaceHit> hit = shot.embree.cast(ray);
        if (!hit)
            return ray.direction.z > 0.0 ? sum + weight * (shot.moment.daylight.horizontal_illuminance_lx / pi) : sum;
        if (hit->from_behind)
            return sum;
        const Surface surface = surface_at(shot, *hit, -ray.direction);
        sum += weight * (surface.response.emission_cdm2 + lamps_on(shot, surface, point, pair + 2, rays));
        if (!go_on_from(surface, point, pair, ray, weight))
            return sum;
    }
    return sum;
}

void add_bounced_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, PacketLight& light) {
    const std::size_t first_pair = 1 + shot.moment.lamps.size();
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (!in_mask(light.hit, i))
            continue;
        const SurfaceHit& hit = light.hits[i];
        const glm::dvec3 from_m = EmbreeScene::raised(hit), direction = sample_cosine(hit.normal, points[i].pair(first_pair));
        if ((shot.wanted.illuminance || shot.wanted.luminance) && glm::dot(direction, hit.facet_normal) > 0.0) {
            const glm::dvec3 radiance = arriving(shot, points[i], first_pair + 1, {from_m, direction}, light.rays);
            light.illuminance_lx[i] += pi * luminance(radiance);
            if (shot.wanted.luminance)
                light.luminance_cdm2[i] += luminance(light.responses[i].albedo * radiance);
        }
        if (!shot.wanted.luminance || light.responses[i].retro_rl <= 0.0)
            continue;
        const RetroLobe lobe = retro_lobe(light.responses[i], greatest(light.responses[i].albedo));
        if (!lobe.is_there())
            continue;
        const RetroSample sample = sample_retro(lobe, glm::normalize(shot.to_eye(hit.point_m)), hit.normal, points[i].pair(retro_pairs),
                                                points[i].pair(retro_pairs + 1).x);
        if (sample.weight > 0.0 && glm::dot(sample.direction, hit.facet_normal) > 0.0)
            light.luminance_cdm2[i] +=
                sample.weight * luminance(arriving(shot, points[i], retro_pairs + 2, {from_m, sample.direction}, light.rays));
    }
}

} // namespace fernlicht::reference
