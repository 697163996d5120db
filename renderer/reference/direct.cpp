#include "renderer/reference/shot.h"

#include "scenarios/photometry.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fernlicht::reference {

Shot::Shot(const EmbreeScene& e, const Moment& m, const View& v, const Wanted& w, const ReferenceSettings& s)
    : embree(e), moment(m), view(v), wanted(w), settings(s), camera(camera_of(m, v)), car_m(m.ego.position_m - e.origin_m()) {}

Ray Shot::ray_through(double x_px, double y_px) const {
    const Ray ray = pixel_ray(camera, view, x_px, y_px);
    return {car_m + ray.origin_m, ray.direction};
}

glm::dvec3 Shot::to_eye(const glm::dvec3& point_m) const { return camera.is_map ? -camera.axis : car_m + camera.eye_m - point_m; }

bool ShadowTally::edge() const { return std::ranges::find(seen, std::uint8_t{3}) != seen.end(); }

glm::dvec3 lamp_point_m(const Shot& shot, const LitLamp& lamp, const SamplePoint& point, std::size_t pair) {
    const glm::dvec3 centre = lamp.pose.position_m - shot.embree.origin_m();
    if (shot.settings.lamp_radius_m <= 0.0)
        return centre;
    const glm::dvec2 on_lamp = on_disc(point.pair(pair)) * shot.settings.lamp_radius_m;
    return centre + lamp.pose.left() * on_lamp.x + lamp.pose.up() * on_lamp.y;
}

double facing_lx(const LitLamp& lamp, const glm::dvec3& lamp_m, const glm::dvec3& point_m) {
    if (lamp.intensity_factor == 0.0)
        return 0.0;
    const glm::dvec3 to_lamp = lamp_m - point_m,
                     w = photometry::lamp_space(-to_lamp, -lamp.pose.left(), lamp.pose.up(), lamp.pose.forward());
    if (w.z <= 0.0)
        return 0.0;
    const glm::dvec2 angles = photometry::goniometer_angles(w);
    const double cd = lamp.intensity_factor * intensity_cd(lamp.file->table, degrees(angles.x), degrees(angles.y));
    return photometry::facing_illuminance(cd, to_lamp);
}

namespace {

/// Lanes among `lanes` from whose points the lamp is seen; all of them without shadows.
LaneMask seen_lanes(const Shot& shot, const std::array<glm::dvec3, packet_size>& from_m, const std::array<glm::dvec3, packet_size>& to_m,
                    LaneMask lanes, PacketLight& light) {
    if (!shot.settings.shadows || lanes == 0)
        return lanes;
    light.rays += static_cast<std::uint64_t>(__builtin_popcount(lanes));
    return shot.embree.visible(from_m, to_m, lanes);
}

void tally(ShadowTally& tally, std::size_t lamp, LaneMask asked, LaneMask seen) {
    tally.seen[lamp] |= static_cast<std::uint8_t>((seen != 0 ? 1 : 0) | ((asked & ~seen) != 0 ? 2 : 0));
}

void add_lamp(const Shot& shot, std::size_t index, const std::array<glm::dvec3, packet_size>& lamp_m,
              std::array<glm::dvec3, packet_size>& colour, PacketLight& light, ShadowTally& edges) {
    const LitLamp& lamp = shot.moment.lamps[index];
    std::array<double, packet_size> e_perp{}, cosine{};
    std::array<glm::dvec3, packet_size> from_m{};
    LaneMask asked = 0, behind = 0;
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (!in_mask(light.hit, i))
            continue;
        const SurfaceHit& hit = light.hits[i];
        const glm::dvec3 to_lamp = lamp_m[i] - hit.point_m;
        cosine[i] = photometry::incidence(hit.normal, to_lamp);
        e_perp[i] = cosine[i] > 0.0 ? facing_lx(lamp, lamp_m[i], hit.point_m) : 0.0;
        if (e_perp[i] <= 0.0)
            continue;
        from_m[i] = EmbreeScene::raised(hit);
        asked |= 1U << i;
        if (shot.settings.shadows && glm::dot(hit.facet_normal, to_lamp) <= 0.0)
            behind |= 1U << i; // the flat triangle itself stands in the way
    }
    const LaneMask seen = seen_lanes(shot, from_m, lamp_m, asked & ~behind, light);
    tally(edges, index, asked, seen);
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (!in_mask(seen, i))
            continue;
        const double e = e_perp[i] * cosine[i];
        light.illuminance_lx[i] += e;
        if (!shot.wanted.luminance)
            continue;
        const SurfaceResponse& response = light.responses[i];
        colour[i] += lamp.colour.linear_srgb * (response.albedo * e / pi);
        if (response.retro_rl > 0.0) {
            const glm::dvec3& p = light.hits[i].point_m;
            const double angle = photometry::observation_angle(lamp_m[i] - p, shot.to_eye(p));
            colour[i] +=
                lamp.colour.linear_srgb * photometry::retro_luminance(response.retro_rl, e_perp[i], cosine[i], angle,
                                                                      response.retro_reference_rad, response.retro_inverse_falloff);
        }
    }
}

void add_target(const Shot& shot, std::size_t index, const std::array<glm::dvec3, packet_size>& lamp_m, PacketLight& light,
                ShadowTally& edges) {
    std::array<double, packet_size> e_perp{};
    std::array<glm::dvec3, packet_size> target_m{};
    LaneMask asked = 0;
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (!in_mask(light.hit, i))
            continue;
        target_m[i] = light.hits[i].point_m + glm::dvec3(0.0, 0.0, shot.settings.target_height_m);
        e_perp[i] = facing_lx(shot.moment.lamps[index], lamp_m[i], target_m[i]);
        asked |= e_perp[i] > 0.0 ? 1U << i : 0U;
    }
    const LaneMask seen = seen_lanes(shot, target_m, lamp_m, asked, light);
    tally(edges, shot.moment.lamps.size() + index, asked, seen);
    for (std::size_t i = 0; i < packet_size; ++i)
        light.target_lx[i] += in_mask(seen, i) ? e_perp[i] : 0.0;
}

} // namespace

void light_packet(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const std::array<Ray, packet_size>& rays,
                  LaneMask lanes, bool sky, PacketLight& light, ShadowTally& edges) {
    light.illuminance_lx = light.target_lx = light.luminance_cdm2 = {};
    light.rays = static_cast<std::uint64_t>(__builtin_popcount(lanes));
    light.hit = shot.embree.cast(rays, lanes, shot.camera.is_map, light.hits);
    const double sky_lx = shot.moment.daylight.horizontal_illuminance_lx;
    std::array<glm::dvec3, packet_size> colour{}, lamp_m{};
    if (shot.wanted.luminance)
        for (std::size_t i = 0; i < packet_size; ++i)
            if (in_mask(light.hit, i))
                light.responses[i] = response_at(shot.embree.scene(), light.hits[i]);
    for (std::size_t index = 0; index < shot.moment.lamps.size(); ++index) {
        for (std::size_t i = 0; i < packet_size; ++i)
            if (in_mask(light.hit, i))
                lamp_m[i] = lamp_point_m(shot, shot.moment.lamps[index], points[i], 1 + index);
        if (shot.wanted.illuminance || shot.wanted.luminance)
            add_lamp(shot, index, lamp_m, colour, light, edges);
        if (shot.wanted.target)
            add_target(shot, index, lamp_m, light, edges);
    }
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (!in_mask(light.hit, i)) {
            light.luminance_cdm2[i] = in_mask(lanes, i) ? sky_lx / pi : 0.0;
            continue;
        }
        const double e_sky = sky ? sky_lx * 0.5 * (1.0 + light.hits[i].normal.z) : 0.0;
        light.illuminance_lx[i] += e_sky;
        if (shot.wanted.luminance)
            light.luminance_cdm2[i] = luminance(colour[i] + light.responses[i].albedo * e_sky / pi + light.responses[i].emission_cdm2);
    }
}

} // namespace fernlicht::reference
