#include "metrics/glare/wet_road.h"

#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"
#include "scenarios/roads/mesh/mesh_materials.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <span>

namespace fernlicht {
namespace {

constexpr int across_streak = 6;            // points of a patch
constexpr std::size_t checked_together = 6; // neighbouring patches whose middle one tells whether they lie on the pavement
static_assert(streak_patches % checked_together == 0);

/// What mirrors: GGX facets over a share of the road.
struct FacetFilm {
    double share, roughness, index;
};
FacetFilm film_of(const Weather& weather, Pavement pavement, double roughness) {
    if (weather.wetness > 0.0)
        return {weather.wetness, roughness, photometry::water_index};
    const Facets facets = facets_of(pavement_material(pavement));
    return {facets.share, facets.roughness, photometry::facet_index};
}

double height_m(const RoadPlane& plane, const glm::dvec3& point_m) { return glm::dot(point_m - plane.point_m, plane.up); }

/// Between the feet of lamp and point, in the plane: x from the lamp's foot to the point's, y to the left.
struct Streak {
    glm::dvec3 foot_m{0.0}, along{0.0}, left{0.0};
    double length_m = 0.0, lamp_up_m = 0.0, point_up_m = 0.0;
    bool lit = false;
};

Streak streak_of(const RoadPlane& plane, const glm::dvec3& lamp_m, const glm::dvec3& point_m) {
    Streak streak;
    streak.lamp_up_m = height_m(plane, lamp_m);
    streak.point_up_m = height_m(plane, point_m);
    streak.foot_m = lamp_m - streak.lamp_up_m * plane.up;
    const glm::dvec3 way = point_m - streak.point_up_m * plane.up - streak.foot_m;
    streak.length_m = glm::length(way);
    streak.lit = streak.lamp_up_m > 0.0 && streak.point_up_m > 0.0 && streak.length_m > 1e-3;
    if (streak.lit) {
        streak.along = way / streak.length_m;
        streak.left = glm::cross(plane.up, streak.along);
    }
    return streak;
}

/// One patch: facets that are turned by about `tilt` along the streak mirror the lamp there, and those turned to the side beside it. Both
/// slopes are tangents of even angles, as GGX spreads them; at grazing angles that makes the integrand smooth, and it is the same integral
/// at all others.
SeenLamp patch_of(const LitLamp& lamp, const Weather& weather, const RoadPlane& plane, const Streak& streak, const glm::dvec3& point_m,
                  const FacetFilm& film, std::size_t k) {
    constexpr double step = pi / static_cast<double>(streak_patches), side_step = pi / across_streak;
    const double a = step * (static_cast<double>(k) + 0.5) - 0.5 * pi, tilt = film.roughness * std::tan(a);
    const double h1 = streak.lamp_up_m, h2 = streak.point_up_m, b = 2.0 * tilt * streak.length_m + h1 + h2;
    const double x = 2.0 * h1 * streak.length_m / (b + std::sqrt(b * b - 8.0 * tilt * h1 * streak.length_m)), z = streak.length_m - x;
    SeenLamp patch{lamp.name, streak.foot_m + x * streak.along, 0.0, 0.0};
    patch.distance_m = glm::distance(patch.position_m, point_m);
    if (!(x > 0.0 && z > 0.0))
        return patch;
    const double dx = 2.0 / (h1 / (x * x) + h2 / (z * z)) * film.roughness / (std::cos(a) * std::cos(a)) * step;
    const double root = std::hypot(film.roughness, tilt), metres = (h1 / x + h2 / z) / (1.0 / x + 1.0 / z) * root;
    for (int i = 0; i < across_streak; ++i) {
        const double c = side_step * (i + 0.5) - 0.5 * pi;
        const glm::dvec3 at_m = patch.position_m + metres * std::tan(c) * streak.left;
        const glm::dvec3 to_lamp = lamp.pose.position_m - at_m, to_point = point_m - at_m;
        const double from_m = glm::length(to_lamp), to_m = glm::length(to_point), cd = intensity_towards_cd(lamp, at_m);
        if (!(cd > 0.0))
            continue;
        const double luminance = photometry::facing_illuminance(cd, to_lamp) *
                                 photometry::facet_mirrored(plane.up, to_lamp / from_m, to_point / to_m, film.roughness, film.index);
        patch.facing_lx += luminance * (h2 / to_m) / (to_m * to_m) * dx * metres / (std::cos(c) * std::cos(c)) * side_step *
                           air_transmittance(weather, from_m + to_m);
    }
    patch.facing_lx *= film.share;
    return patch;
}

/// Whether a point near that place of the route lies on its pavement.
bool on_pavement(const Route& route, double near_m, const glm::dvec3& point_m) {
    double along_m = std::clamp(near_m, 0.0, route.length_m());
    Pose centre = route.pose(along_m);
    for (int i = 0; i < 2; ++i) { // Newton's steps onto the route
        along_m = std::clamp(along_m + glm::dot(point_m - centre.position_m, centre.forward()), 0.0, route.length_m());
        centre = route.pose(along_m);
    }
    const CrossSection section = route.cross_section(along_m);
    const double left_m = glm::dot(point_m - centre.position_m, centre.left());
    return left_m <= section.paved_left_m && left_m >= section.paved_right_m;
}

} // namespace

RoadPlane road_plane(const Pose& from, const Pose& to) {
    const glm::dvec3 way = to.position_m - from.position_m;
    const double length_m = glm::length(way);
    if (!(length_m > 1e-6))
        return {from.position_m, from.up(), 0.0};
    const glm::dvec3 along = way / length_m, mean = from.up() + to.up();
    const auto slope = [&](const Pose& pose) { return std::asin(std::clamp(glm::dot(pose.up(), along), -1.0, 1.0)); };
    return {from.position_m, glm::normalize(mean - glm::dot(mean, along) * along), std::abs(slope(from) - slope(to))};
}

bool mirrors(const Weather& weather, Pavement pavement) { return film_of(weather, pavement, wet_roughness).share > 0.0; }

std::string why_no_mirror(const Weather& weather, const RoadPlane& plane) {
    return weather.wetness > 0.0 && plane.bend_rad > max_mirror_bend_rad
               ? fmt::format("a wet road that bends up or down by more than {:g} degrees: how it mirrors is not modelled",
                             degrees(max_mirror_bend_rad))
               : "";
}

std::vector<SeenLamp> lamps_in_road(const std::vector<LitLamp>& lamps, const Weather& weather, const RoadPlane& plane,
                                    const glm::dvec3& point_m, Pavement pavement, double roughness) {
    std::vector<SeenLamp> patches;
    const FacetFilm film = film_of(weather, pavement, roughness);
    if (!(film.share > 0.0))
        return patches;
    for (const LitLamp& lamp : lamps) {
        const Streak streak = streak_of(plane, lamp.pose.position_m, point_m);
        for (std::size_t k = 0; k < streak_patches; ++k)
            patches.push_back(streak.lit && lamp.intensity_factor > 0.0
                                  ? patch_of(lamp, weather, plane, streak, point_m, film, k)
                                  : SeenLamp{lamp.name, lamp.pose.position_m, 0.0, glm::distance(lamp.pose.position_m, point_m)});
    }
    return patches;
}

RoadLight light_by_road(const Moment& moment, const Route& route, double to_m, const glm::dvec3& point_m, Pavement pavement) {
    if (!mirrors(moment.weather, pavement))
        return {};
    const Pose centre = route.pose(to_m);
    const RoadPlane plane = road_plane(moment.ego, route.pose(to_m, glm::dot(point_m - centre.position_m, centre.left())));
    RoadLight light{{}, why_no_mirror(moment.weather, plane)};
    if (!light.unknown.empty())
        return light;
    light.patches = lamps_in_road(moment.lamps, moment.weather, plane, point_m, pavement);
    const double way_m = glm::distance(moment.ego.position_m, point_m);
    for (std::size_t i = 0; i < light.patches.size(); i += checked_together) {
        const std::span<SeenLamp> patches(&light.patches[i], checked_together);
        const SeenLamp& middle = patches[checked_together / 2];
        if (std::ranges::any_of(patches, [](const SeenLamp& patch) { return patch.facing_lx > 0.0; }) &&
            !on_pavement(route, std::lerp(to_m, moment.distance_m, std::min(middle.distance_m / way_m, 1.0)), middle.position_m))
            for (SeenLamp& patch : patches)
                patch.facing_lx = 0.0;
    }
    return light;
}

RoadLight light_over_road(const Moment& moment, const Route& route, double to_m, const glm::dvec3& point_m, Pavement pavement) {
    RoadLight light = light_by_road(moment, route, to_m, point_m, pavement);
    if (light.patches.empty())
        return light;
    const RoadBetween road(route, moment.distance_m, to_m);
    for (std::size_t i = 0; i < light.patches.size(); i += streak_patches)
        if (road.hides(moment.lamps[i / streak_patches].pose.position_m, point_m))
            for (std::size_t k = 0; k < streak_patches; ++k)
                light.patches[i + k].facing_lx = 0.0;
    return light;
}

TrafficByRoad traffic_by_road(const Moment& moment, const glm::dvec3& eye_m, const glm::dvec3& gaze, const std::vector<BodyBox>& boxes,
                              Pavement pavement) {
    TrafficByRoad light;
    if (!mirrors(moment.weather, pavement))
        return light;
    for (const LitLamp& lamp : moment.other_lamps) {
        const bool on_body = lamp.body >= 0 && static_cast<std::size_t>(lamp.body) < moment.bodies.size();
        const RoadPlane plane = road_plane(moment.ego, on_body ? moment.bodies[static_cast<std::size_t>(lamp.body)].pose : moment.ego);
        bool some = false;
        for (const SeenLamp& patch : lamps_in_road({lamp}, moment.weather, plane, eye_m, pavement)) {
            const GlareSource source = glare_source(patch, eye_m, gaze);
            bool hidden = !(source.eye_lx > 0.0);
            for (std::size_t i = 0; i < moment.bodies.size() && i < boxes.size() && !hidden; ++i)
                hidden = moment.bodies[i].visible && static_cast<int>(i) != lamp.body &&
                         box_hides(boxes[i], moment.bodies[i].pose, eye_m, patch.position_m);
            some = some || !hidden;
            if (!hidden)
                light.sources.push_back(source);
        }
        if (some && light.unknown.empty())
            light.unknown = why_no_mirror(moment.weather, plane);
    }
    return light;
}

} // namespace fernlicht
