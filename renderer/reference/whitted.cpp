#include "renderer/reference/whitted.h"

#include "renderer/reference/path.h"
#include "renderer/reference/scattering.h"

namespace fernlicht::reference {
namespace {

/// `left`: smooth surfaces that may still follow.
glm::dvec3 seen_along(const Shot& shot, const SamplePoint& point, const Ray& ray, int left, std::uint64_t& rays) {
    ++rays;
    const std::optional<SurfaceHit> hit = shot.embree.cast(ray);
    if (!hit)
        return sky_luminance(shot.moment, ray.direction);
    const Surface surface = surface_at(shot.embree.scene(), *hit, -ray.direction);
    if (surface.is_dark())
        return glm::dvec3(0.0);
    glm::dvec3 sum(0.0);
    if (!surface.is_glass()) {
        const double sky_lx = shot.moment.daylight.horizontal_illuminance_lx * 0.5 * (1.0 + hit->normal.z);
        // Lamps' places are those of the pixel's first feelers: pair 1 + i for lamp i.
        sum = surface.response.emission_cdm2 + surface.response.albedo * (sky_lx / pi) + lamps_on(shot, surface, point, 1, rays);
    }
    if (left <= 0)
        return sum;
    const SpecularSplit split = specular_split(surface);
    if (split.mirrored_share > 0.0)
        sum += split.mirrored_share * seen_along(shot, point, leaving(*hit, split.mirrored), left - 1, rays);
    if (split.refracted_share > 0.0)
        sum += split.refracted_share * seen_along(shot, point, leaving(*hit, split.refracted), left - 1, rays);
    return sum;
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
