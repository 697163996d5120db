#include "renderer/reference/path.h"

#include "renderer/reference/scattering.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::reference {
namespace {

/// Pairs of coordinates that the second path of a pixel's sample starts at, and those by mirror and glass: beyond those of any before.
constexpr std::size_t retro_pairs = std::size_t{1} << 24, mirrored_pairs = std::size_t{2} << 24, refracted_pairs = std::size_t{3} << 24,
                      air_first_pair = std::size_t{4} << 24, film_pairs = std::size_t{5} << 24, gloss_pairs = std::size_t{6} << 24;
/// Scatterings in the air after which Russian roulette begins, and the share of paths that it lets go on each time.
constexpr int scatterings_kept = 16;
constexpr double kept_scattering = 0.9;

/// Where a path's free flight ends, m: of density s exp(-s t).
double flight_m(const Weather& weather, double choice) { return -std::log(choice) / weather.extinction_per_m; }

/// Turns the path at the place where it is; false where it ends. `scattered`: how often before.
bool turned(const Shot& shot, const glm::dvec3& place_m, const glm::dvec2& square, double roulette, int& scattered, Ray& ray,
            glm::dvec3& weight) {
    if (++scattered >= shot.settings.max_scatterings)
        return false;
    weight *= shot.moment.weather.scattering_albedo;
    if (scattered > scatterings_kept) {
        if (roulette >= kept_scattering)
            return false;
        weight /= kept_scattering;
    }
    ray = {place_m, sample_henyey_greenstein(ray.direction, shot.moment.weather.asymmetry, square)};
    return weight != glm::dvec3(0.0);
}

/// The light of a ray that the air has turned `scattered` times.
glm::dvec3 followed(const Shot& shot, const SamplePoint& point, std::size_t pair, Ray ray, int scattered, std::uint64_t& rays) {
    const std::size_t of_surface = 2 + shot.moment.lamps.size(), pairs_a_bounce = of_surface + air_pairs(shot);
    const Weather& weather = shot.moment.weather;
    const bool in_air = is_in_air(shot);
    glm::dvec3 sum(0.0), weight(1.0);
    bool specular = false;
    for (int bounce = 0; bounce < shot.settings.max_bounces; ++bounce, pair += pairs_a_bounce) {
        ++rays;
        const std::optional<SurfaceHit> hit = shot.embree.cast(ray);
        if (in_air) {
            const double way_m = hit ? glm::length(hit->point_m - ray.origin_m) : air_end_m;
            if (shot.settings.max_scatterings > 0)
                sum += weight * lamps_in_air(shot, ray, way_m, point, pair + of_surface + 2, rays);
            const glm::dvec2 flight = point.pair(pair + of_surface);
            if (const double free_m = flight_m(weather, flight.x); free_m < way_m) {
                if (scattered == 0) // the sky's balance: what is scattered later is in it already
                    sum += weight * sky_luminance_cdm2(shot.moment.daylight);
                if (!turned(shot, ray.origin_m + ray.direction * free_m, point.pair(pair + of_surface + 1), flight.y, scattered, ray,
                            weight))
                    return sum;
                continue;
            }
        }
        if (!hit)
            return scattered == 0 ? sum + weight * sky_luminance(shot.moment, ray.direction) : sum;
        const Surface surface = surface_at(shot, *hit, -ray.direction);
        if (surface.is_dark())
            return sum;
        if (!surface.is_glass())
            sum += weight * (surface.response.emission_cdm2 + lamps_on(shot, surface, point, pair + 2, rays));
        if (!go_on_from(surface, point, pair, ray, weight, specular))
            return sum;
    }
    return sum;
}

/// What the air before a ray's surface sends to the eye of the lamps' light: scattered once by one point a lamp, more often by a path
/// from a place on the ray that light can have come from.
glm::dvec3 air_seen(const Shot& shot, const SamplePoint& point, const Ray& ray, double way_m, std::uint64_t& rays) {
    glm::dvec3 sum(0.0);
    if (shot.settings.max_scatterings < 1)
        return sum;
    const Weather& weather = shot.moment.weather;
    sum = lamps_in_air(shot, ray, way_m, point, air_first_pair + 2, rays);
    const double stopped = 1.0 - air_transmittance(weather, way_m);
    const glm::dvec2 choice = point.pair(air_first_pair);
    Ray on = ray;
    glm::dvec3 weight(stopped);
    int scattered = 0;
    if (stopped > 0.0 && turned(shot, ray.origin_m + ray.direction * flight_m(weather, 1.0 - choice.x * stopped),
                                point.pair(air_first_pair + 1), 0.0, scattered, on, weight))
        sum += weight * followed(shot, point, air_first_pair + air_pairs(shot), on, scattered, rays);
    return sum;
}

/// `left`: smooth surfaces that may still follow.
glm::dvec3 seen_along(const Shot& shot, const SamplePoint& point, const Ray& ray, int left, std::uint64_t& rays) {
    ++rays;
    const std::optional<SurfaceHit> hit = shot.embree.cast(ray);
    if (!hit)
        return through_air(shot, ray, ray.origin_m + ray.direction * air_end_m, sky_luminance(shot.moment, ray.direction));
    const Surface surface = surface_at(shot, *hit, -ray.direction);
    if (surface.is_dark())
        return through_air(shot, ray, hit->point_m, glm::dvec3(0.0));
    glm::dvec3 sum(0.0);
    if (!surface.is_glass()) {
        const double sky_lx = shot.moment.daylight.horizontal_illuminance_lx * 0.5 * (1.0 + hit->normal.z);
        glm::dvec3 of_sky = surface.response.albedo * (sky_lx / pi) +
                            gloss_sky_light(surface.response.facets, hit->normal, surface.out, sky_luminance_cdm2(shot.moment.daylight));
        if (surface.wetness > 0.0)
            of_sky = partly_wet(
                of_sky, wet_sky_light(surface.response.albedo, hit->normal, surface.out, sky_lx, sky_luminance_cdm2(shot.moment.daylight)),
                surface.wetness);
        // Lamps' places are those of the pixel's first feelers: pair 1 + i for lamp i.
        sum = surface.response.emission_cdm2 + of_sky + lamps_on(shot, surface, point, 1, rays);
    }
    if (left <= 0)
        return through_air(shot, ray, hit->point_m, sum);
    const SpecularSplit split = specular_split(surface);
    if (split.mirrored_share > 0.0)
        sum += split.mirrored_share * seen_along(shot, point, leaving(*hit, split.mirrored), left - 1, rays);
    if (split.refracted_share > 0.0)
        sum += split.refracted_share * seen_along(shot, point, leaving(*hit, split.refracted), left - 1, rays);
    return through_air(shot, ray, hit->point_m, sum);
}

} // namespace

void add_bounced_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const Arriving& arriving, PacketLight& light) {
    const std::size_t first_pair = 1 + shot.moment.lamps.size();
    for (const std::size_t i : lanes_of(light.hit)) {
        const SurfaceHit& hit = light.hits[i];
        const glm::dvec3 from_m = EmbreeScene::raised(hit), direction = sample_cosine(hit.normal, points[i].pair(first_pair)),
                         to_eye = glm::normalize(shot.to_eye(hit.point_m));
        const double left = left_on_way_to_eye(shot, hit.point_m), wetness = wetness_at(shot, light.responses[i]);
        if ((shot.outputs.illuminance || shot.outputs.luminance) && glm::dot(direction, hit.facet_normal) > 0.0) {
            const glm::dvec3 radiance = arriving(i, points[i], first_pair + 1, {from_m, direction}, light.rays);
            light.illuminance_lx[i] += pi * luminance(radiance);
            if (shot.outputs.luminance)
                light.luminance_cdm2[i] +=
                    left * luminance(diffuse_reflectance(light.responses[i].albedo, wetness, glm::dot(hit.normal, direction),
                                                         glm::dot(hit.normal, to_eye)) *
                                     radiance);
        }
        if (shot.outputs.luminance && wetness > 0.0) {
            const FacetSample film = sample_film(hit.normal, to_eye, points[i].pair(film_pairs));
            if (film.weight > 0.0 && glm::dot(film.direction, hit.facet_normal) > 0.0)
                light.luminance_cdm2[i] +=
                    left * wetness * film.weight * luminance(arriving(i, points[i], film_pairs + 1, {from_m, film.direction}, light.rays));
        }
        if (const Facets& facets = light.responses[i].facets; shot.outputs.luminance && facets.share > 0.0 && wetness < 1.0) {
            const FacetSample gloss =
                sample_facets(hit.normal, to_eye, points[i].pair(gloss_pairs), facets.roughness, photometry::facet_index);
            if (gloss.weight > 0.0 && glm::dot(gloss.direction, hit.facet_normal) > 0.0)
                light.luminance_cdm2[i] += left * (1.0 - wetness) * facets.share * gloss.weight *
                                           luminance(arriving(i, points[i], gloss_pairs + 1, {from_m, gloss.direction}, light.rays));
        }
        if (!shot.outputs.luminance || light.responses[i].retro_rl <= 0.0)
            continue;
        const Surface surface = surface_at(shot, hit, to_eye);
        if (!surface.lobe.is_there())
            continue;
        const RetroSample sample =
            sample_retro(surface.lobe, surface.out, hit.normal, points[i].pair(retro_pairs), points[i].pair(retro_pairs + 1).x);
        if (sample.weight > 0.0 && glm::dot(sample.direction, hit.facet_normal) > 0.0)
            light.luminance_cdm2[i] +=
                left * (1.0 - wetness + light.responses[i].retro_wet * wetness) * sample.weight *
                luminance(surface.response.retro_tint * arriving(i, points[i], retro_pairs + 2, {from_m, sample.direction}, light.rays));
    }
}

void add_path_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const std::array<Ray, packet_size>& eye_rays,
                    LaneMask lanes, PacketLight& light) {
    const Arriving by_path = [&](std::size_t, const SamplePoint& point, std::size_t pair, const Ray& ray, std::uint64_t& rays) {
        return followed(shot, point, pair, ray, 0, rays);
    };
    add_bounced_light(shot, points, by_path, light);
    add_smooth_light(shot, points, by_path, light);
    if (!is_in_air(shot) || shot.camera.is_map || !shot.outputs.luminance)
        return;
    for (const std::size_t i : lanes_of(lanes)) {
        const double way_m = in_mask(light.hit, i) ? glm::length(light.hits[i].point_m - eye_rays[i].origin_m) : air_end_m;
        light.luminance_cdm2[i] += luminance(air_seen(shot, points[i], eye_rays[i], way_m, light.rays));
    }
}

void add_smooth_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const Arriving& arriving, PacketLight& light) {
    if (!shot.outputs.luminance)
        return;
    const Scene& scene = shot.embree.scene();
    for (const std::size_t i : lanes_of(light.hit)) {
        if (!is_smooth(scene.materials[light.hits[i].material]))
            continue;
        const SurfaceHit& hit = light.hits[i];
        const double left = left_on_way_to_eye(shot, hit.point_m);
        const SpecularSplit split = specular_split(surface_at(shot, hit, glm::normalize(shot.to_eye(hit.point_m))));
        if (split.mirrored_share > 0.0)
            light.luminance_cdm2[i] +=
                left * split.mirrored_share * luminance(arriving(i, points[i], mirrored_pairs, leaving(hit, split.mirrored), light.rays));
        if (split.refracted_share > 0.0)
            light.luminance_cdm2[i] += left * split.refracted_share *
                                       luminance(arriving(i, points[i], refracted_pairs, leaving(hit, split.refracted), light.rays));
    }
}

void add_whitted_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, PacketLight& light) {
    add_smooth_light(
        shot, points,
        [&](std::size_t, const SamplePoint& point, std::size_t, const Ray& ray, std::uint64_t& rays) {
            return seen_along(shot, point, ray, shot.settings.max_smooth - 1, rays);
        },
        light);
}

} // namespace fernlicht::reference
