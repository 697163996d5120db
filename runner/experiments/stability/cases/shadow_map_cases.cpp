// Methods that draw maps against rays: where maps end and beyond; texels, lamps and eyes in hard places.
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

/// Of the beam: of a map of 1024 x 512 texels the coarser axis is across.
constexpr double half_width_deg = 30.0, half_height_deg = 10.0;

double texel_of(int width, int height) {
    return std::max(2.0 * std::tan(radians(half_width_deg)) / (width - 2),
                    2.0 * 1.75 * std::tan(radians(half_height_deg)) / (height - 2)); // the window is so much higher
}

/// Posts, a board and a wall on a level road, from 6 m on.
Scene row_of_posts(double low_m = 0.0) {
    Scene scene = scene_of_sheet("road", 0, {-50.0, -100.0, 0.0}, {400.0, 0.0, 0.0}, {0.0, 200.0, 0.0});
    for (int i = 0; i < 6; ++i)
        add_triangles(scene, fmt::format("post {}", i), 1, {6.0 + 9.0 * i, (i % 2 == 0 ? 0.9 : -1.4) * (1.0 + 0.5 * i), low_m + 0.6},
                      box({0.1, 0.1 + 0.05 * i, 0.6}, 0.3 * i));
    add_triangles(scene, "board", 1, {35.0, 2.5, 1.8}, box({0.03, 1.0, 0.5}));
    add_triangles(scene, "wall", 1, {70.0, 0.0, 3.0}, box({0.2, 20.0, 3.0}));
    return scene;
}

Moment lit_by(const std::vector<glm::dvec3>& lamps, double yaw_rad = 0.0) {
    Moment moment;
    static const LitLamp one = lamp(even_table(half_width_deg, half_height_deg), {}); // one table: shaders are compiled for each
    for (const glm::dvec3& at : lamps) {
        moment.lamps.push_back(one);
        moment.lamps.back().pose = {at, axes_from_angles(yaw_rad, 0.0, 0.0)};
    }
    return moment;
}

constexpr glm::dvec3 own_lamp_m(0.0, 0.0, 0.65);

View driver_of_posts() { return camera({-1.5, 0.3, 1.25}, 0.0, -0.03, 30.0, 64, 48); }

/// Warped maps may have texels up to twice as wide as the plain map's, which lie askew: their diagonals count.
ShadowTolerance warped_shadow_tolerance() {
    ShadowTolerance tolerance = map_shadow_tolerance(2.0 * texel_of(1024, 512));
    tolerance.aside_share *= std::sqrt(2.0);
    return tolerance;
}

struct HardEye {
    std::string name;
    View view;
};

StabilityCase::Measure warps_from(const std::vector<HardEye>& eyes) {
    return [eyes](StabilityBench& bench, Found& worst) {
        const Scene scene = row_of_posts();
        for (const ShadowMethod method : {ShadowMethod::perspective_map, ShadowMethod::light_space_map}) {
            ShadowTrial trial(bench, scene, shadows_by(method));
            for (const HardEye& eye : eyes)
                judge_tally(worst, trial.tally(lit_by({own_lamp_m}), eye.view, warped_shadow_tolerance()),
                            fmt::format("{}, {}", name(method), eye.name), Tried::either);
        }
    };
}

void warp_search(StabilityBench& bench, Found& worst) {
    const Scene scene = row_of_posts();
    for (const ShadowMethod method : {ShadowMethod::perspective_map, ShadowMethod::light_space_map}) {
        ShadowTrial trial(bench, scene, shadows_by(method));
        Chance chance(StabilityBench::seed);
        ShadowTally all;
        for (int i = 0; i < (bench.thorough ? 200 : 20); ++i) {
            const glm::dvec3 lamp{chance.between(-3.0, 3.0), chance.between(-1.0, 1.0), chance.between(0.2, 2.0)};
            const Moment moment = lit_by({lamp}, chance.between(-0.3, 0.3));
            const glm::dvec3 eye{chance.between(-15.0, 60.0), chance.between(-15.0, 15.0), chance.between(0.2, 8.0)};
            const double yaw = chance.between(-pi, pi), pitch = chance.between(-0.4, 0.1), fov_deg = std::exp(chance.between(0.0, 4.9));
            const View view = camera(eye, yaw, pitch, fov_deg, 40, 30);
            all.add(trial.tally(moment, view, warped_shadow_tolerance()));
        }
        judge_tally(worst, all, std::string(name(method)));
    }
}

void texels_of_maps(StabilityBench& bench, Found& worst) {
    Scene scene = scene_of_sheet("road", 0, {-50.0, -100.0, 0.0}, {400.0, 0.0, 0.0}, {0.0, 200.0, 0.0});
    add_triangles(scene, "board", 1, {20.0, -3.0, 3.0}, box({0.05, 4.0, 3.0}));
    add_triangles(scene, "wall", 1, {40.0, 0.0, 3.0}, box({0.2, 20.0, 3.0}));
    for (const ShadowMethod method : {ShadowMethod::map, ShadowMethod::one_map, ShadowMethod::light_space_map, ShadowMethod::soft_map})
        for (const auto& [width, height] : {std::pair(16, 16), std::pair(8192, 16), std::pair(16, 8192), std::pair(8192, 4096)}) {
            ShadowSettings settings = shadows_by(method);
            settings.width = width;
            settings.height = height;
            settings.lamp_places = 2;
            if (method == ShadowMethod::soft_map && height == 4096)
                continue; // as the others, and much memory
            ShadowTrial trial(bench, scene, settings);
            ShadowTolerance tolerance =
                map_shadow_tolerance((method == ShadowMethod::light_space_map ? 2.0 : 1.0) * 1.02 * texel_of(width, height));
            tolerance.lamp_radius_m = method == ShadowMethod::soft_map ? settings.lamp_radius_m : 0.0;
            const ShadowTally tally = trial.tally(lit_by({own_lamp_m}), driver_of_posts(), tolerance);
            // Of 16 texels little is beyond doubt.
            worst.add(tally.lit + tally.dark == 0 && height > 16 && width > 16 ? std::nan("") : tally.wrong(),
                      fmt::format("{}, {} x {} texels: {}", name(method), width, height, tally.text()), tally.lit + tally.dark);
        }
}

/// One map for lamps side by side: shadows fall as from midway.
void lamps_apart(StabilityBench& bench, Found& worst) {
    const Scene scene = row_of_posts();
    ShadowTrial trial(bench, scene, shadows_by(ShadowMethod::one_map));
    for (const double apart_m : {0.01, 1.2, 3.0, 10.0})
        for (const double yaw_rad : {0.0, 0.3}) {
            const glm::dvec3 aside(0.0, 0.5 * apart_m, 0.0);
            const Moment moment = lit_by({own_lamp_m + aside, own_lamp_m - aside}, yaw_rad);
            ShadowTolerance tolerance = map_shadow_tolerance((1.0 + 0.5 * apart_m / 3.0 / std::tan(radians(half_width_deg))) *
                                                             texel_of(1024, 512)); // as wide as both beams from 3 m on
            judge_tally(worst,
                        trial.tally(moment, camera({2.0, 0.3, 1.5}, yaw_rad, -0.03, 30.0, 64, 48), tolerance, {own_lamp_m, own_lamp_m}),
                        fmt::format("lamps {} m apart, turned by {} rad", apart_m, yaw_rad));
        }
}

void soft_radii(StabilityBench& bench, Found& worst) {
    for (const auto& [radius_m, caster_m] : {std::pair(0.001, 0.3), std::pair(0.001, 20.0), std::pair(0.5, 20.0)}) {
        Scene scene = row_of_posts();
        add_triangles(scene, "plate", 1, own_lamp_m + glm::dvec3(caster_m, 0.0, 0.0), box({0.02, 0.3 * caster_m, 0.1 * caster_m}));
        ShadowSettings settings = shadows_by(ShadowMethod::soft_map);
        settings.lamp_radius_m = radius_m;
        ShadowTrial trial(bench, scene, settings);
        ShadowTolerance tolerance = map_shadow_tolerance(1.02 * texel_of(1024, 512));
        tolerance.lamp_radius_m = radius_m;
        judge_tally(worst, trial.tally(lit_by({own_lamp_m}), camera({2.5, 0.3, 1.5}, 0.0, -0.03, 30.0, 32, 24), tolerance),
                    fmt::format("radius {} m, a plate {} m before the lamp", radius_m, caster_m), Tried::either);
    }
}

/// A plate within the radius of the lamp's face leaves half light everywhere: shares against rays to 256 places on the disc.
void soft_near(StabilityBench& bench, Found& worst) {
    constexpr double radius_m = 0.5;
    constexpr int rays = 256;
    for (const double caster_m : {0.1, 0.3, 0.5}) {
        Scene scene = scene_of_sheet("wall", 1, {12.0, 5.0, -4.0}, {0.0, -10.0, 0.0}, {0.0, 0.0, 8.0});
        add_triangles(scene, "plate", 1, {caster_m, 0.1, 0.0}, box({0.01, 0.2, 0.2}));
        const Moment moment = lit_by({{0.0, 0.0, 0.0}});
        const View view = camera({3.0, 0.0, 0.0}, 0.0, 0.0, 25.0, 24, 18);
        RendererSettings settings;
        settings.shadows = shadows_by(ShadowMethod::soft_map);
        settings.shadows.lamp_radius_m = radius_m;
        Renderer drawn(bench.device(), scene, settings), free(bench.device(), scene, unshadowed());
        const Frame with = drawn.draw(moment, view, {.illuminance = true}), without = free.draw(moment, view, {.illuminance = true});
        const Twin twin(scene, false);
        double squares = 0.0;
        int pixels = 0;
        for (int y = 0; y < view.height_px; ++y)
            for (int x = 0; x < view.width_px; ++x) {
                const TwinPixel here = twin.pixel(moment, view, x + 0.5, y + 0.5);
                if (here.id == 0 || here.illuminance_lx < 1e-3)
                    continue;
                int seen = 0;
                for (int k = 0; k < rays; ++k) {
                    const double r = radius_m * std::sqrt((k + 0.5) / rays), angle = k * pi * (3.0 - std::sqrt(5.0));
                    const glm::dvec3 from = here.point_m + 1e-3 * here.normal,
                                     way = glm::dvec3(0.0, r * std::cos(angle), r * std::sin(angle)) - from;
                    const auto blocker = twin.cast(moment, {from, glm::normalize(way)}, 1e-4, Twin::Met::casters);
                    seen += blocker && blocker->distance_m < glm::length(way) ? 0 : 1;
                }
                const double share =
                    static_cast<double>(with.illuminance_lx.at(x, y)) / static_cast<double>(without.illuminance_lx.at(x, y));
                squares += std::pow(share - static_cast<double>(seen) / rays, 2.0);
                ++pixels;
            }
        worst.add(pixels == 0 ? std::nan("") : std::sqrt(squares / pixels),
                  fmt::format("a plate {} m before the lamp, {} pixels", caster_m, pixels), pixels);
    }
}

/// Of the map that the trial's lamp gets: 1024 texels over 60 degrees across, the coarser of its axes.
constexpr double texel_tangent = 2.0 * 0.5773502691896257 / 1022.0;

struct WallBehindABoard {
    Scene scene = empty_scene();
    Moment moment;
    View view;

    explicit WallBehindABoard(double x) {
        const double half = 0.02 * x;
        add_sheet(scene, "wall", 0, {x, half, -half}, {0.0, -2.0 * half, 0.0}, {0.0, 0.0, 2.0 * half});
        add_sheet(scene, "board", 1, {x - 20.0, 0.4 * half, -0.4 * half}, {0.0, -0.8 * half, 0.0}, {0.0, 0.0, 0.8 * half});
        moment.lamps = {lamp(cut_off_table(), {0.0, 0.0, 0.0}, 0.0, radians(2.0))};
        view = camera({x - 15.0, 0.0, 0.0}, 0.0, 0.0, 2.0 * degrees(std::atan(half / 15.0)), 64, 64);
    }
};

void far(StabilityBench& bench, Found& worst) {
    for (const double x : {50.0, 100.0, 200.0, 315.0}) {
        const WallBehindABoard trial(x);
        ShadowTrial drawn(bench, trial.scene, shadows_by(ShadowMethod::map));
        judge_tally(worst, drawn.tally(trial.moment, trial.view, map_shadow_tolerance(1.02 * texel_tangent)),
                    fmt::format("wall at {} m", x));
    }
}

/// Farther than the maps reach: all shadows are missing there, and the technique says so.
void beyond(StabilityBench& bench, Found& worst) {
    constexpr double maps_end_m = 300.0;
    for (const double x : {330.0, 500.0, 1000.0}) {
        const WallBehindABoard trial(x);
        Renderer renderer(bench.device(), trial.scene, {});
        const Frame frame = renderer.draw(trial.moment, trial.view, {.illuminance = true});
        const Twin shaded(trial.scene, true);
        double leak = 0.0;
        int dark = 0;
        for (int y = 0; y < trial.view.height_px; ++y)
            for (int px = 0; px < trial.view.width_px; ++px) {
                if (shaded.pixel(trial.moment, trial.view, px + 0.5, y + 0.5).illuminance_lx > 0.0)
                    continue;
                ++dark;
                leak = std::max(leak, static_cast<double>(frame.illuminance_lx.at(px, y)));
            }
        const double peak_cd = peak_of(trial.moment.lamps.front().file->table).cd;
        worst.add(dark == 0 ? std::nan("") : leak / (peak_cd / (maps_end_m * maps_end_m)),
                  fmt::format("wall at {} m: {:.3g} lx where it should be dark", x, leak), dark);
    }
    const bool said = technique_named("photometric").ignores.find("farther than 300 m") != std::string_view::npos;
    worst.add(said ? 0.0 : 2.0, "what the technique says that it ignores");
}

} // namespace

std::vector<StabilityCase> shadow_cases() {
    return {
        {"shadow", "far", "shadows out to 300 m, where a texel is 0.3 m wide", 0.0, "pixels rendered wrongly",
         "pixels in doubt are left out: those where rays from within a texel and the look-up's height do not agree", far},
        {"shadow", "beyond-the-maps", "a shadow at 500 m and 1000 m: the maps end 300 m from the lamp", 1.0,
         "of the lamp's peak over (300 m)^2",
         "what leaks is the light of one lamp farther away than that: a limit, which `fernlicht techniques` tells under what is ignored",
         beyond},
    };
}

std::vector<StabilityCase> shadow_map_cases() {
    const std::string pixels = "pixels rendered wrongly";
    const std::string in_doubt = "in doubt are pixels where rays from within a texel and the look-up's height do not agree";
    return {
        {"warp", "eyes", "the lamp in the eye, behind, before and beside it; along the light and against it", 0.0, pixels,
         in_doubt + "; texels are up to twice as wide as the plain map's",
         warps_from({{"eye on the lamp", camera(own_lamp_m, 0.0, -0.05, 40.0, 64, 48)},
                     {"eye 1 mm above the lamp", camera(own_lamp_m + glm::dvec3(0.0, 0.0, 1e-3), 0.0, -0.05, 40.0, 64, 48)},
                     {"lamp 5 m behind the eye", camera({5.0, 0.0, 0.66}, 0.0, -0.03, 40.0, 64, 48)},
                     {"lamp 5 m before the eye", camera({-5.0, 0.0, 0.65}, 0.0, 0.0, 40.0, 64, 48)},
                     {"lamp in the eye's plane", camera({0.0, 3.0, 0.65}, -0.05, -0.05, 40.0, 64, 48)},
                     {"against the light", camera({50.0, 0.0, 1.5}, pi, -0.04, 40.0, 64, 48)},
                     {"against the light, in its line", camera({50.0, 0.0, 0.65}, pi, 0.0, 40.0, 64, 48)},
                     {"across the light", camera({25.0, -20.0, 1.5}, 0.5 * pi, -0.05, 40.0, 64, 48)},
                     {"straight down", camera({20.0, 0.0, 15.0}, 0.0, -0.5 * pi, 60.0, 64, 48)},
                     {"from behind a post", camera({-8.0, 1.2, 1.0}, -0.05, -0.05, 40.0, 64, 48)}})},
        {"warp", "fields-of-view", "fields of view of 0.2 to 165 degrees, pictures 64 times as wide as high", 0.0, pixels,
         in_doubt + "; texels are up to twice as wide as the plain map's",
         warps_from({{"0.2 degrees", camera({-1.5, 0.3, 1.25}, 0.02, -0.012, 0.2, 64, 48)},
                     {"2 degrees", camera({-1.5, 0.3, 1.25}, 0.01, -0.02, 2.0, 64, 48)},
                     {"120 degrees", camera({-1.5, 0.3, 1.25}, 0.0, 0.0, 120.0, 64, 48)},
                     {"165 degrees", camera({-1.5, 0.3, 1.25}, 0.0, 0.0, 165.0, 96, 72)},
                     {"256 x 4 pixels", camera({-1.5, 0.3, 1.25}, 0.0, -0.04, 2.0, 256, 4)},
                     {"4 x 256 pixels", camera({-1.5, 0.3, 1.25}, 0.04, -0.05, 30.0, 4, 256)}})},
        {"warp", "search", "lamps and eyes anywhere", 0.0, pixels, in_doubt + "; texels are up to twice as wide as the plain map's",
         warp_search},
        {"shadow", "texels", "maps of 16 x 16 to 8192 x 4096 texels, 512 times as wide as high", 0.0, pixels,
         in_doubt + "; of 16 texels little is beyond doubt", texels_of_maps},
        {"one-map", "lamps-apart", "lamps 1 cm to 10 m apart", 0.0, pixels,
         "held against the reference from midway: a limit, which docs/shadows.md tells; " + in_doubt, lamps_apart},
        {"soft", "radii", "lamps of 1 mm and of 0.5 m", 0.0, pixels, in_doubt + ", and where places on the disc do not", soft_radii},
        {"soft", "near-casters", "a lamp of 0.5 m, a caster nearer than that", 0.0625, "of the lamp's share, r.m.s.",
         "of 16 places each stands for a sixteenth of the light", soft_near},
    };
}

} // namespace fernlicht
