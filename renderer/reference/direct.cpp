#include "renderer/reference/pixel_estimate.h"
#include "renderer/reference/scattering.h"

#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::reference {

Shot::Shot(const EmbreeScene& e, const Moment& m, const View& v, const FrameOutputs& w, const ReferenceSettings& s)
    : embree(e), moment(m), view(v), outputs(w), settings(s), camera(camera_of(m, v)), car_m(m.ego.position_m - e.origin_m()) {}

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

using Points = std::array<glm::dvec3, packet_size>;

/// Lanes among `lanes` from whose points the lamp is seen; all of them without shadows.
LaneMask seen_lanes(const Shot& shot, const Points& from_m, const Points& to_m, LaneMask lanes, PacketLight& light) {
    if (!shot.settings.shadows || lanes == 0)
        return lanes;
    light.rays += static_cast<std::uint64_t>(__builtin_popcount(lanes));
    return shot.embree.visible(from_m, to_m, lanes);
}

void tally(ShadowTally& tally, std::size_t lamp, LaneMask asked, LaneMask seen) {
    tally.seen[lamp] |= static_cast<std::uint8_t>((seen != 0 ? 1 : 0) | ((asked & ~seen) != 0 ? 2 : 0));
}

/// I / d^2 in each lane of `asked`, as facing_lx; returns the lanes where it is above 0.
LaneMask facing_lanes(const LitLamp& lamp, const Weather& weather, const Points& lamp_m, const Points& point_m, LaneMask asked,
                      Lanes& e_perp_lx) {
    Points in_lamp;
    Lanes across{}, up{}, ahead{}, level{}, h_rad, v_rad;
    for (const std::size_t i : lanes_of(asked)) {
        in_lamp[i] = photometry::lamp_space(point_m[i] - lamp_m[i], -lamp.pose.left(), lamp.pose.up(), lamp.pose.forward());
        across[i] = in_lamp[i].x, up[i] = in_lamp[i].y, ahead[i] = in_lamp[i].z;
        level[i] = std::sqrt(in_lamp[i].x * in_lamp[i].x + in_lamp[i].z * in_lamp[i].z);
    }
    angles(across, ahead, h_rad); // photometry.glsl: goniometer_angles
    angles(up, level, v_rad);
    LaneMask lit = 0;
    for (const std::size_t i : lanes_of(asked)) {
        if (ahead[i] <= 0.0)
            continue;
        const double cd = lamp.intensity_factor * intensity_cd(lamp.file->table, degrees(h_rad[i]), degrees(v_rad[i]));
        e_perp_lx[i] = photometry::facing_illuminance(cd, in_lamp[i]) * air_transmittance(weather, glm::length(in_lamp[i]));
        lit |= e_perp_lx[i] > 0.0 ? 1U << i : 0U;
    }
    return lit;
}

/// Angles at the surfaces between lamp and eye, where they retroreflect (photometry.glsl: observation_angle).
void observation_lanes(const Shot& shot, const PacketLight& light, const Points& lamp_m, LaneMask seen, Lanes& angle_rad) {
    Lanes sine{}, cosine{};
    for (const std::size_t i : lanes_of(seen))
        if (light.responses[i].retro_rl > 0.0) {
            const glm::dvec3 &p = light.hits[i].point_m, to_lamp = lamp_m[i] - p, to_eye = shot.to_eye(p);
            sine[i] = glm::length(glm::cross(to_lamp, to_eye));
            cosine[i] = glm::dot(to_lamp, to_eye);
        }
    angles(sine, cosine, angle_rad);
}

void add_luminance(const Shot& shot, const LitLamp& lamp, const Points& lamp_m, const Lanes& e_perp, const Lanes& cosine, LaneMask seen,
                   const PacketLight& light, Points& colour) {
    Lanes angle_rad;
    observation_lanes(shot, light, lamp_m, seen, angle_rad);
    for (const std::size_t i : lanes_of(seen)) {
        const SurfaceResponse& response = light.responses[i];
        glm::dvec3 returned = response.albedo * (e_perp[i] * cosine[i] / pi), beads(0.0);
        if (response.retro_rl > 0.0)
            beads = response.retro_tint * photometry::retro_luminance(response.retro_rl, e_perp[i], cosine[i], angle_rad[i],
                                                                      response.retro_reference_rad, response.retro_inverse_falloff);
        returned += beads;
        const glm::dvec3 &p = light.hits[i].point_m, &n = light.hits[i].normal;
        const double wet = wetness_at(shot, response);
        if (response.facets.share > 0.0)
            returned += gloss_light(response.facets, n, glm::normalize(lamp_m[i] - p), glm::normalize(shot.to_eye(p)), e_perp[i]);
        if (wet > 0.0)
            returned = partly_wet(returned,
                                  wet_light(response.albedo, n, glm::normalize(lamp_m[i] - p), glm::normalize(shot.to_eye(p)), e_perp[i]) +
                                      response.retro_wet * beads,
                                  wet);
        colour[i] += lamp.colour.linear_srgb * returned;
    }
}

void add_lamp(const Shot& shot, std::size_t index, const Points& lamp_m, Points& colour, PacketLight& light, ShadowTally& edges) {
    const LitLamp& lamp = shot.moment.lamps[index];
    Lanes e_perp{}, cosine{};
    Points point_m;
    LaneMask facing = 0, behind = 0;
    for (const std::size_t i : lanes_of(light.hit)) {
        const SurfaceHit& hit = light.hits[i];
        const glm::dvec3 to_lamp = lamp_m[i] - hit.point_m;
        point_m[i] = hit.point_m;
        cosine[i] = photometry::incidence(hit.normal, to_lamp);
        facing |= cosine[i] > 0.0 ? 1U << i : 0U;
        if (shot.settings.shadows && glm::dot(hit.facet_normal, to_lamp) <= 0.0)
            behind |= 1U << i; // the flat triangle itself stands in the way
    }
    const LaneMask asked = facing_lanes(lamp, shot.moment.weather, lamp_m, point_m, facing, e_perp);
    for (const std::size_t i : lanes_of(asked))
        point_m[i] = EmbreeScene::raised(light.hits[i]);
    const LaneMask seen = seen_lanes(shot, point_m, lamp_m, asked & ~behind, light);
    tally(edges, index, asked, seen);
    for (const std::size_t i : lanes_of(seen))
        light.illuminance_lx[i] += e_perp[i] * cosine[i];
    if (shot.outputs.luminance && seen != 0)
        add_luminance(shot, lamp, lamp_m, e_perp, cosine, seen, light, colour);
}

/// Parallel light; its shadows have no edge that a lamp's radius would soften, so that they are not tallied.
void add_sun(const Shot& shot, const DirectLight& sun, Points& colour, PacketLight& light) {
    const glm::dvec3 towards = sun.towards();
    Lanes e{};
    Points from_m, to_m;
    LaneMask facing = 0;
    for (const std::size_t i : lanes_of(light.hit)) {
        const SurfaceHit& hit = light.hits[i];
        e[i] = photometry::directional_illuminance(sun.illuminance_lx, hit.normal, towards);
        from_m[i] = EmbreeScene::raised(hit);
        to_m[i] = from_m[i] + towards * sun_distance_m;
        if (e[i] > 0.0 && (!shot.settings.shadows || glm::dot(hit.facet_normal, towards) > 0.0))
            facing |= 1U << i;
    }
    const LaneMask seen = seen_lanes(shot, from_m, to_m, facing, light);
    for (const std::size_t i : lanes_of(seen)) {
        light.illuminance_lx[i] += e[i];
        if (!shot.outputs.luminance)
            continue;
        const SurfaceResponse& response = light.responses[i];
        glm::dvec3 returned = response.albedo * (e[i] / pi);
        if (response.facets.share > 0.0)
            returned += gloss_light(response.facets, light.hits[i].normal, towards, glm::normalize(shot.to_eye(light.hits[i].point_m)),
                                    sun.illuminance_lx);
        if (const double wet = wetness_at(shot, response); wet > 0.0)
            returned = partly_wet(returned,
                                  wet_light(response.albedo, light.hits[i].normal, towards,
                                            glm::normalize(shot.to_eye(light.hits[i].point_m)), sun.illuminance_lx),
                                  wet);
        colour[i] += returned;
    }
}

void add_target(const Shot& shot, std::size_t index, const Points& lamp_m, PacketLight& light, ShadowTally& edges) {
    Lanes e_perp{};
    Points target_m;
    for (const std::size_t i : lanes_of(light.hit))
        target_m[i] = light.hits[i].point_m + glm::dvec3(0.0, 0.0, shot.settings.target_height_m);
    const LaneMask asked = facing_lanes(shot.moment.lamps[index], shot.moment.weather, lamp_m, target_m, light.hit, e_perp);
    const LaneMask seen = seen_lanes(shot, target_m, lamp_m, asked, light);
    tally(edges, shot.moment.lamps.size() + index, asked, seen);
    for (const std::size_t i : lanes_of(seen))
        light.target_lx[i] += e_perp[i];
}

} // namespace

void light_packet(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const std::array<Ray, packet_size>& rays,
                  LaneMask lanes, bool sky, PacketLight& light, ShadowTally& edges) {
    light.illuminance_lx = light.target_lx = light.luminance_cdm2 = {};
    light.rays = static_cast<std::uint64_t>(__builtin_popcount(lanes));
    light.hit = shot.embree.cast(rays, lanes, shot.camera.is_map, light.hits);
    const double sky_lx = shot.moment.daylight.horizontal_illuminance_lx;
    Points colour{}, lamp_m{};
    if (shot.outputs.luminance)
        for (const std::size_t i : lanes_of(light.hit))
            light.responses[i] = response_at(shot.embree.scene(), light.hits[i]);
    for (std::size_t index = 0; index < shot.moment.lamps.size(); ++index) {
        for (const std::size_t i : lanes_of(light.hit))
            lamp_m[i] = lamp_point_m(shot, shot.moment.lamps[index], points[i], 1 + index);
        if (shot.outputs.illuminance || shot.outputs.luminance)
            add_lamp(shot, index, lamp_m, colour, light, edges);
        if (shot.outputs.target && shot.moment.lamps[index].body == -1) // targets are about the own lamps
            add_target(shot, index, lamp_m, light, edges);
    }
    if (const DirectLight* direct = shot.moment.daylight.direct())
        add_sun(shot, *direct, colour, light);
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (!in_mask(light.hit, i)) {
            light.luminance_cdm2[i] = in_mask(lanes, i) ? sky_lx / pi : 0.0;
            if (in_mask(lanes, i) && shot.outputs.luminance && is_in_air(shot) && !shot.camera.is_map &&
                shot.settings.integrator != Integrator::path) // paths add it themselves
                light.luminance_cdm2[i] += luminance(airlight(shot, rays[i].origin_m, rays[i].origin_m + rays[i].direction * air_end_m));
            continue;
        }
        const double e_sky = sky ? sky_lx * 0.5 * (1.0 + light.hits[i].normal.z) : 0.0;
        light.illuminance_lx[i] += e_sky;
        if (!shot.outputs.luminance)
            continue;
        const SurfaceResponse& response = light.responses[i];
        glm::dvec3 of_sky = response.albedo * e_sky / pi;
        if (sky && response.facets.share > 0.0)
            of_sky +=
                gloss_sky_light(response.facets, light.hits[i].normal, glm::normalize(shot.to_eye(light.hits[i].point_m)), sky_lx / pi);
        if (const double wet = wetness_at(shot, response); wet > 0.0 && sky)
            of_sky = partly_wet(of_sky,
                                wet_sky_light(response.albedo, light.hits[i].normal, glm::normalize(shot.to_eye(light.hits[i].point_m)),
                                              e_sky, sky_lx / pi),
                                wet);
        light.luminance_cdm2[i] = luminance(through_air(shot, rays[i], light.hits[i].point_m, colour[i] + of_sky + response.emission_cdm2));
    }
}

} // namespace fernlicht::reference
