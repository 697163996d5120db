// Shadow volumes against rays: bodies of all kinds, lamps and cameras in all places.
#include "runner/experiments/stability/shadow_trial.h"
#include "runner/experiments/stability/stability_case.h"
#include "runner/play/lux_map.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

using namespace stability;

glm::dvec3 within_cube(Chance& chance, double half) {
    return {chance.between(-half, half), chance.between(-half, half), chance.between(-half, half)};
}

/// Closed, open, inside out, with a side missing, doubled, or triangles of any sort, about 0.
Triangles any_body(Chance& chance, double size_m) {
    // Braces and variables: arguments would be drawn in the compiler's order.
    const glm::dvec3 half = size_m * glm::dvec3{chance.between(0.02, 1.0), chance.between(0.02, 1.0), chance.between(0.02, 1.0)};
    Triangles body = box(half, chance.between(0.0, 2.0 * pi));
    switch (chance.below(7)) {
    case 0:
        return turned_round(body);
    case 1: // a side missing
        body.erase(body.begin(), body.begin() + 2);
        return body;
    case 2: // triangles missing and turned round
        body.erase(body.begin() + chance.below(12));
        {
            const auto one = static_cast<std::size_t>(chance.below(11)), other = static_cast<std::size_t>(chance.below(11));
            std::swap(body[one][0], body[other][1]);
        }
        return body;
    case 3: // a sheet, once or from both sides
        body.resize(2);
        if (chance.below(2) == 0)
            for (const std::array<glm::dvec3, 3>& t : turned_round(body))
                body.push_back(t);
        return body;
    case 4: { // triangles that share corners as chance has it
        std::array<glm::dvec3, 5> corners;
        for (glm::dvec3& corner : corners)
            corner = within_cube(chance, size_m);
        body.clear();
        const auto corner = [&] { return corners[static_cast<std::size_t>(chance.below(5))]; };
        for (int i = 0; i < 8; ++i)
            body.push_back({corner(), corner(), corner()});
        return body;
    }
    default:
        return body;
    }
}

Scene crowd_of_bodies(Chance& chance, int bodies, std::vector<glm::dvec3>& places) {
    Scene scene = scene_of_sheet("road", 0, {-50.0, -100.0, 0.0}, {200.0, 0.0, 0.0}, {0.0, 200.0, 0.0});
    for (int i = 0; i < bodies; ++i) {
        const double size_m = std::exp(chance.between(std::log(0.05), std::log(4.0)));
        places.push_back({chance.between(2.0, 40.0), chance.between(-8.0, 8.0), chance.between(0.1, 1.0) * (size_m + 1.0)});
        add_triangles(scene, fmt::format("body {}", i), 1, places.back(), any_body(chance, size_m));
    }
    return scene;
}

void shadow_crowds(StabilityBench& bench, Found& worst) {
    Chance chance(StabilityBench::seed);
    for (int i = 0; i < (bench.thorough ? 60 : 6); ++i) {
        std::vector<glm::dvec3> places;
        const Scene scene = crowd_of_bodies(chance, 10, places);
        ShadowTrial trial(bench, scene, shadows_by(ShadowMethod::volumes));
        Moment moment = moment_of(lamp(even_table(40.0, 40.0), {}));
        ShadowTally all;
        for (int k = 0; k < 8; ++k) {
            const bool within = chance.below(3) == 0; // a body, or its shadow
            const auto any_place = [&] { return places[static_cast<std::size_t>(chance.below(10))]; };
            const auto near = [&](double half) {
                const glm::dvec3 place = any_place();
                return place + within_cube(chance, half);
            };
            const glm::dvec3 at =
                within ? near(0.02) : glm::dvec3{chance.between(-5.0, 20.0), chance.between(-5.0, 5.0), chance.between(0.05, 3.0)};
            const double lamp_yaw = chance.between(-0.5, 0.5), lamp_pitch = chance.between(-0.3, 0.3);
            moment.lamps.front().pose = {at, axes_from_angles(lamp_yaw, lamp_pitch, 0.0)};
            glm::dvec3 eye = chance.below(3) == 0
                                 ? near(0.3)
                                 : glm::dvec3{chance.between(-10.0, 30.0), chance.between(-10.0, 10.0), chance.between(0.2, 6.0)};
            eye.z = std::max(eye.z, 0.2); // so that the near plane cuts no hole into the road: what is below it, it hides from rays alone
            const double yaw = chance.between(-0.7, 0.7), pitch = chance.between(-0.5, 0.1), fov_deg = chance.between(20.0, 110.0);
            all.add(trial.tally(moment, camera(eye, yaw, pitch, fov_deg, 48, 36), volume_shadow_tolerance()));
        }
        judge_tally(worst, all, fmt::format("crowd {}", i));
    }
}

/// A road 200 m long, and one body on it.
Scene street_with(const glm::dvec3& at, const Triangles& body) {
    Scene scene = scene_of_sheet("road", 0, {-50.0, -100.0, 0.0}, {200.0, 0.0, 0.0}, {0.0, 200.0, 0.0});
    add_triangles(scene, "body", 1, at, body);
    return scene;
}

Moment lit_from(const glm::dvec3& lamp_m) {
    static const LitLamp one = lamp(even_table(40.0, 40.0), {}); // one table: shaders are compiled for each
    Moment moment = moment_of(one);
    moment.lamps.front().pose.position_m = lamp_m;
    return moment;
}

/// Lamp and camera to the bit in planes of triangles and of hulls.
void in_planes(StabilityBench& bench, Found& worst) {
    const Scene scene = street_with({8.0, 0.0, 1.0}, box({0.5, 0.5, 0.5}));
    ShadowTrial trial(bench, scene, shadows_by(ShadowMethod::volumes));
    for (const glm::dvec3& at : {glm::dvec3(0.0, 0.5, 1.0), glm::dvec3(0.0, 0.5, 1.5), glm::dvec3(0.0, 0.0, 1.5), glm::dvec3(0.0, 0.0, 0.5),
                                 glm::dvec3(-8.0, 1.0, 2.0), glm::dvec3(7.5, 0.0, 1.0), glm::dvec3(6.5, 0.5, 1.5)}) {
        ShadowTally all;
        for (const glm::dvec3& corner : {glm::dvec3(7.5, 0.5, 1.5), glm::dvec3(7.5, -0.5, 0.5), glm::dvec3(8.5, 0.5, 1.5)})
            for (const double share : {1.0, 1.25, 3.0}) { // before, at and behind the corner, on the edge of its hull
                const glm::dvec3 eye = at + share * (corner - at);
                if (eye.z <= 0.05)
                    continue;
                for (const double yaw : {0.0, 0.5 * pi, pi})
                    all.add(trial.tally(lit_from(at), camera(eye, yaw, -0.2, 75.0, 32, 24), volume_shadow_tolerance()));
            }
        judge_tally(worst, all, fmt::format("lamp at {} {} {}", at.x, at.y, at.z), Tried::either);
    }
}

/// What is near the eye and near the lamp: casters that reach through the near plane, around the eye, and next to the lamp.
void near_planes(StabilityBench& bench, Found& worst) {
    for (const double distance_m : {1e-3, 0.01, 0.05, 0.1, 0.10001, 0.3}) {
        ShadowTally all;
        for (const bool around_lamp : {false, true}) {
            const glm::dvec3 eye(6.0, 0.0, 1.2), lamp_m(0.0, 0.0, 0.65), before = around_lamp ? lamp_m : eye;
            // A plate from one side, so that half of what is seen is in its shadow.
            const double half = 0.6 * distance_m;
            const Scene scene = street_with(before + glm::dvec3(distance_m, 0.9 * half, 0.0), box({0.1 * distance_m, half, half}));
            ShadowTrial trial(bench, scene, shadows_by(ShadowMethod::volumes));
            for (const double yaw : {0.0, 0.4, pi})
                all.add(trial.tally(lit_from(lamp_m), camera(eye, yaw, -0.2, 60.0, 48, 36), volume_shadow_tolerance()));
        }
        judge_tally(worst, all, fmt::format("{} m before eye and lamp", distance_m));
    }
}

/// Fronts must not shade themselves, however their depth is rounded: walls along the light, seen from near, far and aside.
void long_walls(StabilityBench& bench, Found& worst) {
    Scene scene = scene_of_sheet("road", 0, {-50.0, -100.0, 0.0}, {400.0, 0.0, 0.0}, {0.0, 200.0, 0.0});
    add_triangles(scene, "wall", 1, {140.0, -3.0, 1.0}, box({138.0, 0.2, 1.0}, 0.004));
    for (int i = 1; i < 12; ++i)
        add_triangles(scene, fmt::format("post {}", i), 1, {20.0 * i, -1.5, 0.5}, box({0.1, 0.1, 0.5}));
    ShadowTrial trial(bench, scene, shadows_by(ShadowMethod::volumes));
    for (const double beside_m : {0.0, -1.8, -2.1}) {
        ShadowTally all;
        for (const View& view :
             {camera({0.0, 0.5, 1.3}, -0.03, -0.02, 20.0, 64, 48), camera({-40.0, 40.0, 20.0}, -0.5, -0.2, 30.0, 64, 48),
              camera({250.0, 60.0, 8.0}, -2.2, -0.1, 40.0, 64, 48), camera({130.0, 95.0, 3.0}, -1.57, -0.03, 100.0, 64, 24),
              camera({280.0, 0.0, 2.0}, pi, -0.01, 5.0, 64, 24)})
            all.add(trial.tally(lit_from({2.5, beside_m, 0.65}), view, volume_shadow_tolerance()));
        judge_tally(worst, all, fmt::format("lamp {} m beside", beside_m));
    }
}

/// From above hulls have no infinity to end at.
void volumes_from_above(StabilityBench& bench, Found& worst) {
    for (const double distance_m : {0.02, 0.5, 5.0, 50.0, 140.0}) {
        const double size_m = 0.05 * std::max(distance_m, 0.05);
        const Scene scene =
            street_with({distance_m, 0.0, std::max(0.65 - 0.05 * distance_m, size_m)}, box({0.2 * size_m, size_m, size_m}, 0.2));
        ShadowTrial trial(bench, scene, shadows_by(ShadowMethod::volumes));
        const View view = map_of("map", 0.0, 149.0, 8.0, 33, 150);
        judge_tally(worst, trial.tally(lit_from({0.0, 0.0, 0.65}), view, volume_shadow_tolerance()),
                    fmt::format("caster {} m away", distance_m));
    }
}

} // namespace

std::vector<StabilityCase> shadow_volume_cases() {
    const std::string pixels = "pixels rendered wrongly";
    return {
        {"volumes", "crowds", "bodies closed, open, inside out, torn and tangled; lamp and camera in any of them and in their shadows", 0.0,
         pixels, "hulls are exact: in doubt are only pixels at edges and those within twice the gap behind a caster", shadow_crowds},
        {"volumes", "in-planes", "the lamp to the bit in planes of triangles, the eye on edges of hulls", 0.0, pixels,
         "any choice of what casts gives a closed hull, and a hull seen edge-on covers nothing", in_planes},
        {"volumes", "near-planes", "casters 1 mm to 0.3 m before the eye and before the lamp, across the near plane at 0.1 m", 0.0, pixels,
         "hulls are counted behind surfaces, so that what the near plane cuts off does not count", near_planes},
        {"volumes", "long-walls", "fronts along the light that shade themselves, seen from up to 280 m", 0.0, pixels,
         "a hull begins 1 mm and 1e-4 of the distance behind its front, above the rounding of a float's depth", long_walls},
        {"volumes", "from-above", "hulls in maps, where they end at 100 000 times the caster's distance", 0.0, pixels,
         "a caster 2 cm away has its shadow to 2 km", volumes_from_above},
    };
}

} // namespace fernlicht
