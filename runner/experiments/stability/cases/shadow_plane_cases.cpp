// Shadows on a plane and polygons under cars, and what all shadow methods have in common: light that grazes, places far from the origin.
#include "runner/experiments/stability/shadow_trial.h"
#include "runner/experiments/stability/stability_case.h"

#include "scenarios/drives/play/camera.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

using namespace stability;

CandelaTable level_beam() { return even_table(30.0, 10.0); }
constexpr double beam_texel = 1.3e-3; // of 1024 x 512 texels

ShadowTolerance planar_shadow_tolerance() {
    ShadowTolerance tolerance;
    tolerance.ground_alone = true;
    return tolerance;
}

/// Everything turned about the lamp's foot by a slope ahead, and moved.
struct OnAPlane {
    Scene scene = empty_scene();
    Moment moment;
    glm::dmat3 axes;

    OnAPlane(double lamp_height_m, double slope, const glm::dvec3& moved_m) : axes(axes_from_angles(0.0, std::atan(slope), 0.0)) {
        moment.ego = {moved_m, glm::dmat3(1.0)};
        add_sheet(scene, "road", 0, moved_m + axes * glm::dvec3(-20.0, -50.0, 0.0), axes * glm::dvec3(150.0, 0.0, 0.0),
                  axes * glm::dvec3(0.0, 100.0, 0.0));
        moment.lamps = {lamp(level_beam(), moved_m + axes * glm::dvec3(0.0, 0.0, lamp_height_m))};
        moment.lamps.front().pose.axes = axes;
    }
    void add(const glm::dvec3& at, const glm::dvec3& half) {
        Triangles turned = box(half);
        for (std::array<glm::dvec3, 3>& t : turned)
            for (glm::dvec3& corner : t)
                corner = axes * corner;
        add_triangles(scene, fmt::format("body {}", scene.meshes.size()), 1, moment.ego.position_m + axes * at, turned);
    }
};

void on_a_plane(StabilityBench& bench, Found& worst) {
    for (const auto& [name, height_m, slope, moved_m] :
         {std::tuple("lamp 2 mm above the plane", 0.002, 0.0, glm::dvec3(0.0)),
          std::tuple("lamp 5 cm above the plane", 0.05, 0.0, glm::dvec3(0.0)), std::tuple("level", 0.65, 0.0, glm::dvec3(0.0)),
          std::tuple("slope of 6 %", 0.65, 0.06, glm::dvec3(0.0)), std::tuple("slope of -15 %", 0.65, -0.15, glm::dvec3(0.0)),
          std::tuple("slope of 6 %, 5000 km away", 0.65, 0.06, glm::dvec3(500123.4, 5400567.8, 812.5))}) {
        OnAPlane trial(height_m, slope, moved_m);
        trial.add({8.0, 1.0, 0.3}, {0.1, 0.3, 0.3});                        // stands on it
        trial.add({12.0, -2.0, 0.1}, {0.2, 0.3, 0.4});                      // goes through it
        trial.add({20.0, 0.5, 0.5 * height_m}, {0.1, 0.4, 0.5 * height_m}); // as high as the lamp, to the bit
        trial.add({25.0, 3.0, 2.0}, {0.1, 0.5, 0.2});                       // above the lamp
        trial.add({30.0, -3.0, 0.8}, {0.1, 0.5, 0.4});                      // around its height
        ShadowTrial drawn(bench, trial.scene, shadows_by(ShadowMethod::planar));
        ShadowTally all;
        for (const glm::dvec3& eye : {glm::dvec3(-1.5, 0.3, 1.25), glm::dvec3(10.0, 1.2, 0.15), glm::dvec3(60.0, -8.0, 12.0)})
            all.add(drawn.tally(
                trial.moment,
                camera(trial.axes * eye, eye.x > 50.0 ? 2.9 : 0.0, eye.x > 50.0 ? -0.25 : std::atan(slope) - 0.05, 40.0, 64, 48),
                planar_shadow_tolerance()));
        judge_tally(worst, all, name);
    }
}

/// Polygons under a car: the ground within its outline.
void under_cars(StabilityBench& bench, Found& worst) {
    const glm::dvec3 half(2.2, 0.9, 0.7);
    for (const glm::dvec3& moved_m : {glm::dvec3(0.0), glm::dvec3(500123.4, 5400567.8, 312.5)}) {
        Scene scene = scene_of_sheet("road", 0, moved_m + glm::dvec3(-20.0, -50.0, 0.0), {150.0, 0.0, 0.0}, {0.0, 100.0, 0.0});
        add_triangles(scene, "car", 1, {0.0, 0.0, 0.8}, box(half));
        scene.meshes.back().body = 0;
        RendererSettings settings;
        settings.shadows = shadows_by(ShadowMethod::under_car);
        Renderer renderer(bench.device(), scene, settings);
        Moment moment;
        moment.ego.position_m = moved_m;
        moment.lamps = {lamp(level_beam(), moved_m + glm::dvec3(0.0, 0.0, 0.65))};
        for (const auto& [name, pose] :
             {std::pair("askew", Pose{moved_m + glm::dvec3(12.0, 1.0, 0.0), axes_from_angles(2.2, 0.0, 0.0)}),
              std::pair("pitched and rolled", Pose{moved_m + glm::dvec3(15.0, -2.0, 0.05), axes_from_angles(0.4, 0.04, -0.03)}),
              std::pair("on its side", Pose{moved_m + glm::dvec3(15.0, 0.0, 0.9), axes_from_angles(0.4, 0.0, 0.5 * pi)}),
              std::pair("on its nose", Pose{moved_m + glm::dvec3(15.0, 0.0, 2.0), axes_from_angles(0.4, 0.5 * pi, 0.0)})}) {
            moment.bodies = {{"car", pose, true, 0.0, false}};
            int wrong = 0, dark = 0, lit = 0;
            for (const View& view : {camera({-1.5, 0.3, 1.25}, 0.0, -0.06, 40.0, 64, 48),
                                     camera(pose.position_m - moved_m + glm::dvec3(0.0, 0.0, 0.2), 0.5, -0.3, 90.0, 64, 48)}) {
                const Frame frame = renderer.draw(moment, view, {.illuminance = true, .ids = true});
                const Twin twin(scene, false);
                for (int y = 0; y < view.height_px; ++y)
                    for (int x = 0; x < view.width_px; ++x) {
                        const TwinPixel here = twin.pixel(moment, view, x + 0.5, y + 0.5);
                        if (here.id != 1 || frame.ids.at(x, y) != 1 || here.illuminance_lx < 1e-3)
                            continue;
                        const glm::dvec3 in_car = to_local(pose, moved_m + here.point_m);
                        // So far inside or outside of what is dark: the outline, 0.3 m up and down (ground_shadows.cpp).
                        const double beyond =
                            std::max({std::abs(in_car.x) - half.x, std::abs(in_car.y) - half.y, std::abs(in_car.z) - 0.3});
                        if (std::abs(beyond) < 1e-3)
                            continue;
                        ++(beyond < 0.0 ? dark : lit);
                        const bool drawn_dark = static_cast<double>(frame.illuminance_lx.at(x, y)) < 0.5 * here.illuminance_lx;
                        wrong += drawn_dark == (beyond < 0.0) ? 0 : 1;
                    }
            }
            worst.add(dark + lit == 0 ? std::nan("") : wrong,
                      fmt::format("{}, moved by {} m: {} of {} pixels", name, moved_m.x, wrong, dark + lit), dark + lit);
        }
    }
}

struct ShadowWay {
    ShadowMethod method;
    ShadowTolerance tolerance;
};

std::vector<ShadowWay> shadow_ways() {
    ShadowTolerance soft = map_shadow_tolerance(beam_texel);
    soft.lamp_radius_m = ShadowSettings{}.lamp_radius_m;
    return {{ShadowMethod::planar, planar_shadow_tolerance()},
            {ShadowMethod::volumes, volume_shadow_tolerance()},
            {ShadowMethod::map, map_shadow_tolerance(beam_texel)},
            {ShadowMethod::one_map, map_shadow_tolerance(beam_texel)},
            {ShadowMethod::perspective_map, map_shadow_tolerance(2.0 * beam_texel)},
            {ShadowMethod::light_space_map, map_shadow_tolerance(2.0 * beam_texel)},
            {ShadowMethod::soft_map, soft}};
}

/// Some boxes on a road, drawn by each method at a place.
void by_all_methods(StabilityBench& bench, Found& worst, double lamp_height_m, double box_height_m, const glm::dvec3& moved_m,
                    const View& view) {
    Scene scene = scene_of_sheet("road", 0, moved_m + glm::dvec3(-10.0, -50.0, 0.0), {300.0, 0.0, 0.0}, {0.0, 100.0, 0.0});
    for (int i = 0; i < 5; ++i)
        add_triangles(scene, fmt::format("box {}", i), 1,
                      moved_m + glm::dvec3(8.0 + 24.0 * i, 0.3 * i * (i % 2 == 0 ? 1.0 : -1.0), 0.5 * box_height_m),
                      box({0.2, 0.3 + 0.3 * i, 0.5 * box_height_m}));
    Moment moment;
    moment.ego.position_m = moved_m;
    moment.lamps = {lamp(level_beam(), moved_m + glm::dvec3(0.0, 0.0, lamp_height_m))};
    for (const ShadowWay& one : shadow_ways()) {
        ShadowTrial trial(bench, scene, shadows_by(one.method));
        judge_tally(worst, trial.tally(moment, view, one.tolerance), std::string(name(one.method)));
    }
}

void grazing_by_all(StabilityBench& bench, Found& worst) {
    by_all_methods(bench, worst, 0.2, 0.6, {}, camera({-1.5, 1.3, 6.0}, -0.02, -0.04, 8.0, 48, 64));
}

void far_by_all(StabilityBench& bench, Found& worst) {
    for (const glm::dvec3& moved_m : {glm::dvec3(-100000.0, 0.0, 0.0), glm::dvec3(500123.456, 5400567.891, 812.345)}) {
        Found found;
        by_all_methods(bench, found, 0.65, 0.8, moved_m, camera({-1.5, 0.3, 1.25}, 0.0, -0.04, 25.0, 64, 48));
        worst.trials += found.trials - 1;
        worst.add(found.error, fmt::format("{} m, {} m: {}", moved_m.x, moved_m.y, found.where), found.judged);
    }
}

} // namespace

std::vector<StabilityCase> shadow_plane_cases() {
    const std::string pixels = "pixels rendered wrongly";
    return {
        {"planar", "casters", "a lamp barely above the plane, casters as high as it, through the plane and above it; slopes, far places",
         0.0, pixels, "what is as high as the lamp is cut off in homogeneous coordinates, before any division", on_a_plane},
        {"under-car", "poses", "cars askew, on their side and on their nose, the eye within what is dark", 0.0, pixels,
         "in doubt is 1 mm beside the outline", under_cars},
        {"shadow", "grazing", "light at 0.05 degrees behind boxes, by every method", 0.0, pixels, "pixels in doubt as above",
         grazing_by_all},
        {"shadow", "far-from-origin", "100 km and 5400 km from the origin, as road data have it, by every method", 0.0, pixels,
         "places are relative to the car before they are floats", far_by_all},
    };
}

} // namespace fernlicht
