// Where lamps stand and shine: distance, grazing incidence, on a surface, unequal lamps in one frame. Where the camera stands against them,
// and how far both stand from the origin of the world.
#include "runner/experiments/stability/trial.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

using namespace stability;

/// A wall of 1 m at the car, a lamp before it at each distance. The car stands at the wall: what is far is the lamp.
void distance(StabilityBench& bench, Found& worst) {
    Scene scene = scene_of_sheet("wall", 0, {0.0, 0.5, -0.5}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}); // faces -x
    Renderer renderer(bench.device(), scene, unshadowed());
    Moment moment = moment_of(lamp(constant_table(1000.0), {}));
    for (double d = 1e-3; d < 1.01e4; d *= std::pow(10.0, 0.25)) {
        moment.lamps[0].pose.position_m.x = -d;
        const AgainstTwin found = against_twin(renderer, scene, moment, camera({-1.0, 0.05, 0.05}, 0.0, 0.0, 30.0, 32, 24));
        worst.add(found.error(), fmt::format("{:.3g} m, {}: {:.1e} relative", d, found.where, found.worst_relative), found.compared);
    }
}

/// A sheet 20 m ahead, turned so that light grazes it more and more, in attitudes that make every component of the normal round.
void grazing(StabilityBench& bench, Found& worst) {
    for (const double graze_deg : {90.0, 45.0, 10.0, 1.0, 0.1, 0.01, 0.001})
        for (const double roll_deg : {0.0, 17.3, 63.1}) {
            const glm::dmat3 axes = axes_from_angles(0.0, 0.0, radians(roll_deg));
            const double a = radians(graze_deg);
            // Along the light and a little across it; the normal leans towards the lamp by the angle.
            const glm::dvec3 along = axes * glm::dvec3(std::cos(a), 0.0, std::sin(a)), across = axes * glm::dvec3(0.0, 1.0, 0.0);
            Scene scene = scene_of_sheet("sheet", 0, glm::dvec3(20.0, 0.0, 0.0) - 0.5 * along - 0.05 * across, along, 0.1 * across);
            Renderer renderer(bench.device(), scene, unshadowed());
            Moment moment = moment_of(lamp(constant_table(1000.0), {0.0, 0.0, 0.0}));
            // Seen from above the sheet, so that pixels show its surface well.
            const glm::dvec3 normal = glm::normalize(glm::cross(along, across));
            const glm::dvec3 eye = glm::dvec3(20.0, 0.0, 0.0) + 2.0 * normal;
            const double yaw = std::atan2(-normal.y, -normal.x), pitch = std::asin(-normal.z);
            const AgainstTwin found = against_twin(renderer, scene, moment, camera(eye, yaw, pitch, 20.0, 24, 24));
            worst.add(found.error(), fmt::format("{} degrees, rolled by {}: {:.1e} relative", graze_deg, roll_deg, found.worst_relative),
                      found.compared);
        }
}

/// A lamp in the middle of a sheet, exactly where a pixel's centre looks, and within rounding errors of it.
void lamp_on_a_surface(StabilityBench& bench, Found& worst) {
    Scene scene = scene_of_sheet("wall", 0, {2.0, 1.0, -1.0}, {0.0, -2.0, 0.0}, {0.0, 0.0, 2.0});
    Renderer renderer(bench.device(), scene, unshadowed());
    for (const double before_m : {0.0, 1e-300, 1e-45, 1e-30, 1e-12, 1e-7, 1e-6})
        for (const double yaw : {0.0, pi}) {
            Moment moment = moment_of(lamp(constant_table(1000.0), {2.0 - before_m, 0.0, 0.0}, yaw));
            const Frame frame = renderer.draw(moment, camera({0.0, 0.0, 0.0}, 0.0, 0.0, 40.0, 33, 33), everything);
            worst.add(static_cast<double>(not_finite(frame)),
                      fmt::format("{:.0e} m before the wall, yaw {:.0f} degrees", before_m, degrees(yaw)), pixels_in(frame));
            const glm::dvec3 place{2.0, 0.0, 0.0};
            const bool finite = std::isfinite(target_illuminance_lx(moment, moment.lamps[0].pose.position_m)) &&
                                std::isfinite(surface_illuminance_lx(moment, moment.lamps[0].pose.position_m, {-1.0, 0.0, 0.0})) &&
                                (before_m < 1e-100 || std::isfinite(target_illuminance_lx(moment, place)));
            worst.add(finite ? 0.0 : 1.0, fmt::format("in double, {:.0e} m before the wall", before_m));
        }
}

/// One lamp lights a wall with 1e5 lx, another the wall beside it with 1 lx, in one frame.
void unequal_lamps(StabilityBench& bench, Found& worst) {
    Scene scene = scene_of_sheet("bright wall", 0, {10.0, 3.0, -1.0}, {0.0, -2.9, 0.0}, {0.0, 0.0, 2.0});
    add_sheet(scene, "dim wall", 0, {10.0, -0.1, -1.0}, {0.0, -2.9, 0.0}, {0.0, 0.0, 2.0});
    add_sheet(scene, "board", 1, {9.0, 0.1, 1.2}, {0.0, -0.2, 0.0}, {0.0, 0.0, 0.2});
    Moment moment;
    CandelaTable left = constant_table(1e7), right = constant_table(100.0);
    left.h_deg = {-85.0, 0.0}; // each lamp only its own side
    right.h_deg = {0.0, 85.0};
    moment.lamps = {lamp(left, {0.0, 0.0, 0.0}), lamp(right, {0.0, 0.0, 0.0})};
    Renderer renderer(bench.device(), scene, unshadowed());
    const AgainstTwin found = against_twin(renderer, scene, moment, camera({0.0, 0.0, 0.3}, 0.0, 0.0, 30.0, 64, 32));
    worst.add(found.error(), fmt::format("{}: {:.1e} relative over {} pixels", found.where, found.worst_relative, found.compared),
              found.compared);
}

/// A road, a retroreflecting board over it and a wall behind the lamp.
Scene street(const glm::dvec3& origin_m) {
    Scene scene = scene_of_sheet("road", 0, origin_m + glm::dvec3(-20.0, -10.0, 0.0), {120.0, 0.0, 0.0}, {0.0, 20.0, 0.0});
    add_sheet(scene, "board", 1, origin_m + glm::dvec3(30.0, 1.0, 0.5), {0.0, -2.0, 0.0}, {0.0, 0.0, 1.5});
    add_sheet(scene, "back wall", 1, origin_m + glm::dvec3(-10.0, -5.0, 0.0), {0.0, 10.0, 0.0}, {0.0, 0.0, 5.0});
    return scene;
}

struct Place {
    const char* name;
    glm::dvec3 eye_m;
    double yaw_deg, lamp_yaw_deg;
};

/// The lamp stands at (3.5, 0, 0.65); an eye on it is at the retroreflection's pole, observation angle 0.
void beside_the_lamp(StabilityBench& bench, Found& worst) {
    static const Place places[] = {{"in the beam, looking along it", {8.0, 0.0, 0.65}, 0.0, 0.0},
                                   {"in the beam, looking into the lamp", {12.0, 0.0, 0.65}, 180.0, 0.0},
                                   {"behind the lamp", {1.0, 0.0, 0.65}, 0.0, 0.0},
                                   {"on the lamp", {3.5, 0.0, 0.65}, 0.0, 0.0},
                                   {"on the lamp, looking back", {3.5, 0.0, 0.65}, 180.0, 0.0},
                                   {"a micrometre beside the lamp", {3.5, 1e-6, 0.65}, 0.0, 0.0},
                                   {"the lamp aimed at the camera", {12.0, 0.0, 1.2}, 180.0, 3.7},
                                   {"the lamp aimed at the camera behind it", {0.0, 0.0, 0.65}, 0.0, 180.0}};
    const Scene scene = street({});
    Renderer renderer(bench.device(), scene, unshadowed());
    for (const Place& place : places) {
        Moment moment = moment_of(lamp(cut_off_table(), {3.5, 0.0, 0.65}, radians(place.lamp_yaw_deg)));
        const AgainstTwin found = against_twin(renderer, scene, moment, camera(place.eye_m, radians(place.yaw_deg), -0.03, 40.0, 48, 32));
        worst.add(found.error(), fmt::format("{}: {}, {:.1e} relative", place.name, found.where, found.worst_relative), found.compared);
    }
}

/// The same street at the world's origin and at 1e7 m: the same light.
void far_from_the_origin(StabilityBench& bench, Found& worst) {
    for (const double far_m : {0.0, 1.0, 1e3, 1e5, 1e6, 1e7}) {
        const glm::dvec3 origin{far_m, -0.7 * far_m, 1e-3 * far_m};
        const Scene scene = street(origin);
        Renderer renderer(bench.device(), scene, unshadowed());
        Moment moment;
        moment.ego.position_m = origin;
        moment.lamps = {lamp(cut_off_table(), origin + glm::dvec3(3.5, 0.6, 0.65))};
        const AgainstTwin found = against_twin(renderer, scene, moment, camera({1.3, 0.35, 1.2}, 0.0, -0.03, 40.0, 48, 32));
        worst.add(found.error(), fmt::format("{:.0e} m: {}, {:.1e} relative", far_m, found.where, found.worst_relative), found.compared);
    }
}

} // namespace

std::vector<StabilityCase> lamp_cases() {
    const std::string of_bound = "of the pixel's rounding bound";
    return {
        {"lamp", "distance", "1 / d^2 from 1 mm to 10 km: overflow near the lamp, positions that round far from it", 1.0, of_bound,
         "24 roundings of light and 16 of the largest coordinate, seen in 1/d^2, cosine and beam", distance},
        {"lamp", "grazing", "incidence from 90 to 0.001 degrees: the cosine is a difference of nearly equal products", 1.0, of_bound,
         "the rounding of a position or of a dot product, over a cosine of down to 1.7e-5", grazing},
        {"lamp", "on-a-surface", "a lamp in a surface: 0/0 in direction, distance and cosine", 0.0, "pixels that are not finite",
         "at d = 0 there is no direction and so no light; everywhere else 1e-7 m keeps 1/d^2 below 1e14", lamp_on_a_surface},
        {"lamp", "unequal", "1e5 lx beside 1 lx in one frame: one lamp's error must not show in the other's light", 1.0, of_bound,
         "each lamp is added by itself; a dark lamp adds exactly 0", unequal_lamps},
    };
}

std::vector<StabilityCase> camera_cases() {
    const std::string of_bound = "of the pixel's rounding bound";
    return {
        {"camera", "beside-the-lamp",
         "an eye in the beam, behind the lamp, on it, or looked at by it: poles of the angle between light and eye", 1.0, of_bound,
         "the eye changes no illuminance; the angle comes from atan(|a x b|, a . b), which is well-conditioned at 0", beside_the_lamp},
        {"camera", "far-from-the-origin", "world coordinates up to 1e7 m, where a float steps by a metre", 1.0, of_bound,
         "the GPU sees positions relative to the car, subtracted in double (1.9e-9 m at 1e7 m)", far_from_the_origin},
    };
}

} // namespace fernlicht
