#include "renderer/reference/path.h"

#include "renderer/reference/scattering.h"

#include <glm/geometric.hpp>

namespace fernlicht::reference {
namespace {

/// Pairs of coordinates that the second path of a pixel's sample starts at, and those by mirror and glass: beyond those of any before.
constexpr std::size_t retro_pairs = std::size_t{1} << 24, mirrored_pairs = std::size_t{2} << 24, refracted_pairs = std::size_t{3} << 24;

} // namespace

glm::dvec3 arriving_by_path(const Shot& shot, const SamplePoint& point, std::size_t pair, Ray ray, std::uint64_t& rays) {
    const std::size_t pairs_a_bounce = 2 + shot.moment.lamps.size();
    glm::dvec3 sum(0.0), weight(1.0);
    bool specular = false;
    for (int bounce = 0; bounce < shot.settings.most_bounces; ++bounce, pair += pairs_a_bounce) {
        ++rays;
        const std::optional<SurfaceHit> hit = shot.embree.cast(ray);
        if (!hit)
            return sum + weight * sky_luminance(shot.moment, ray.direction);
        const Surface surface = surface_at(shot.embree.scene(), *hit, -ray.direction);
        if (surface.is_dark())
            return sum;
        if (!surface.is_glass())
            sum += weight * (surface.response.emission_cdm2 + lamps_on(shot, surface, point, pair + 2, rays));
        if (!go_on_from(surface, point, pair, ray, weight, specular))
            return sum;
    }
    return sum;
}

void add_bounced_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const Arriving& arriving, PacketLight& light) {
    const std::size_t first_pair = 1 + shot.moment.lamps.size();
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (!in_mask(light.hit, i))
            continue;
        const SurfaceHit& hit = light.hits[i];
        const glm::dvec3 from_m = EmbreeScene::raised(hit), direction = sample_cosine(hit.normal, points[i].pair(first_pair));
        if ((shot.wanted.illuminance || shot.wanted.luminance) && glm::dot(direction, hit.facet_normal) > 0.0) {
            const glm::dvec3 radiance = arriving(i, points[i], first_pair + 1, {from_m, direction}, light.rays);
            light.illuminance_lx[i] += pi * luminance(radiance);
            if (shot.wanted.luminance)
                light.luminance_cdm2[i] += luminance(light.responses[i].albedo * radiance);
        }
        if (!shot.wanted.luminance || light.responses[i].retro_rl <= 0.0)
            continue;
        const Surface surface = surface_at(shot.embree.scene(), hit, glm::normalize(shot.to_eye(hit.point_m)));
        if (!surface.lobe.is_there())
            continue;
        const RetroSample sample =
            sample_retro(surface.lobe, surface.out, hit.normal, points[i].pair(retro_pairs), points[i].pair(retro_pairs + 1).x);
        if (sample.weight > 0.0 && glm::dot(sample.direction, hit.facet_normal) > 0.0)
            light.luminance_cdm2[i] +=
                sample.weight * luminance(arriving(i, points[i], retro_pairs + 2, {from_m, sample.direction}, light.rays));
    }
}

void add_path_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, PacketLight& light) {
    const Arriving by_path = [&](std::size_t, const SamplePoint& point, std::size_t pair, const Ray& ray, std::uint64_t& rays) {
        return arriving_by_path(shot, point, pair, ray, rays);
    };
    add_bounced_light(shot, points, by_path, light);
    add_smooth_light(shot, points, by_path, light);
}

void add_smooth_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const Arriving& arriving, PacketLight& light) {
    if (!shot.wanted.luminance)
        return;
    const Scene& scene = shot.embree.scene();
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (!in_mask(light.hit, i) || !is_smooth(scene.materials[light.hits[i].material]))
            continue;
        const SurfaceHit& hit = light.hits[i];
        const SpecularSplit split = specular_split(surface_at(scene, hit, glm::normalize(shot.to_eye(hit.point_m))));
        if (split.mirrored_share > 0.0)
            light.luminance_cdm2[i] +=
                split.mirrored_share * luminance(arriving(i, points[i], mirrored_pairs, leaving(hit, split.mirrored), light.rays));
        if (split.refracted_share > 0.0)
            light.luminance_cdm2[i] +=
                split.refracted_share * luminance(arriving(i, points[i], refracted_pairs, leaving(hit, split.refracted), light.rays));
    }
}

} // namespace fernlicht::reference
