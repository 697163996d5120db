#include "renderer/reference/whitted.h"

#include "renderer/reference/air.h"
#include "renderer/reference/path.h"
#include "renderer/reference/scattering.h"
#include "scenarios/light/wet_light.h"

namespace fernlicht::reference {
namespace {

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
        glm::dvec3 of_sky = surface.response.albedo * (sky_lx / pi);
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

void add_whitted_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, PacketLight& light) {
    add_smooth_light(
        shot, points,
        [&](std::size_t, const SamplePoint& point, std::size_t, const Ray& ray, std::uint64_t& rays) {
            return seen_along(shot, point, ray, shot.settings.most_smooth - 1, rays);
        },
        light);
}

} // namespace fernlicht::reference
