// Shadow maps against rays: surfaces that shade themselves, and light that leaks.
#include "runner/experiments/stability/trial.h"
#include "runner/play/lux_map.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

using namespace stability;

/// Of the map that the trial's lamp gets: 1024 texels over 60 degrees across, the coarser of its axes.
constexpr double texel_tangent = 2.0 * 0.5773502691896257 / 1022.0;
constexpr double least_raise_m = 0.03; // ShadowSettings::tolerance_m

struct Count {
    int lit = 0, dark = 0; ///< pixels of which rays leave no doubt
    int acne = 0;          ///< drawn dark though lit
    int leaks = 0;         ///< drawn lit though dark
    int unsure = 0;
};

/// A pixel is beyond doubt where rays from all places that the map may take for it agree: from its surface up to twice the height from
/// which shadows are looked up (docs/decisions/0005), and a texel and a half to each side.
Count count(StabilityBench& bench, const Scene& scene, const Moment& moment, const View& view) {
    Renderer renderer(bench.device(), scene, {});
    const Frame frame = renderer.draw(moment, view, {.illuminance = true});
    const Twin twin(scene, false);
    const LitLamp& lamp = moment.lamps.front();
    Count found;
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const TwinPixel free = twin.pixel(moment, view, x + 0.5, y + 0.5);
            if (free.id == 0 || free.illuminance_lx < 1e-4)
                continue;
            const glm::dvec3 lamp_m = lamp.pose.position_m - moment.ego.position_m, to_lamp = lamp_m - free.point_m;
            const double d = glm::length(to_lamp), raise = std::max(least_raise_m, 1.5 * texel_tangent * d),
                         aside = 1.5 * texel_tangent * d;
            const glm::dvec3 across = glm::normalize(glm::cross(to_lamp, glm::dvec3(0.0, 0.0, 1.0))),
                             up = glm::normalize(glm::cross(across, to_lamp));
            const glm::dvec3 offsets[] = {1e-3 * free.normal,
                                          raise * free.normal,
                                          2.0 * raise * free.normal,
                                          raise * free.normal + aside * across,
                                          raise * free.normal - aside * across,
                                          raise * free.normal + aside * up,
                                          raise * free.normal - aside * up};
            int seen = 0;
            for (const glm::dvec3& offset : offsets) {
                const glm::dvec3 from = free.point_m + offset, way = lamp_m - from;
                const auto blocker = twin.cast(moment, {from, glm::normalize(way)}, 1e-4, Twin::Met::casters);
                seen += blocker && blocker->distance_m < glm::length(way) ? 0 : 1;
            }
            const bool drawn_dark = static_cast<double>(frame.illuminance_lx.at(x, y)) < 0.5 * free.illuminance_lx;
            if (seen != 0 && seen != 7) {
                ++found.unsure;
            } else if (seen == 7) {
                ++found.lit;
                found.acne += drawn_dark ? 1 : 0;
            } else {
                ++found.dark;
                found.leaks += drawn_dark ? 0 : 1;
            }
        }
    return found;
}

void judge_count(Found& worst, const Count& found, const std::string& where) {
    const std::string text = fmt::format("{}: {} of {} lit pixels drawn dark, {} of {} dark ones drawn lit, {} in doubt", where, found.acne,
                                         found.lit, found.leaks, found.dark, found.unsure);
    // A scene without shadows, or without light, tries nothing.
    worst.add(found.lit == 0 || found.dark == 0 ? std::nan("") : found.acne + found.leaks, text);
}

/// A road in waves, whose crests the light grazes: crests shade what lies behind them, and must not shade themselves.
Found waves(StabilityBench& bench) {
    Found worst;
    for (const auto& [height_m, length_m] : {std::pair(1.0, 30.0), std::pair(2.0, 60.0), std::pair(4.0, 100.0)}) {
        Scene scene = empty_scene();
        Mesh mesh{"waves", {0.0, 0.0, 0.0}, {}, {}, {}};
        const double k = 2.0 * pi / length_m;
        for (int i = 0; i <= 200; ++i) {
            const double x = -5.0 + i, z = 0.5 * height_m * (std::cos(k * x) - 1.0);
            const glm::vec3 normal(glm::normalize(glm::dvec3(0.5 * height_m * k * std::sin(k * x), 0.0, 1.0)));
            for (const double y : {-4.0, 4.0})
                mesh.vertices.push_back({glm::vec3(glm::dvec3(x, y, z)), normal});
            const auto a = static_cast<std::uint32_t>(2 * i);
            if (i < 200)
                mesh.indices.insert(mesh.indices.end(), {a, a + 2, a + 3, a, a + 3, a + 1});
        }
        mesh.batches = {{0, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
        scene.meshes.push_back(std::move(mesh));
        Moment moment;
        moment.lamps = {lamp(cut_off_table(), {0.0, 0.0, 0.65})};
        judge_count(worst, count(bench, scene, moment, map_of("map", 2.0, 190.0, 3.5, 12, 376)),
                    fmt::format("waves of {} m over {} m", height_m, length_m));
    }
    return worst;
}

/// Boards on a flat road out to 250 m: at the last one light comes in at 0.15 degrees.
Found boards(StabilityBench& bench) {
    Scene scene = empty_scene();
    add_sheet(scene, "road", 0, {-5.0, -10.0, 0.0}, {300.0, 0.0, 0.0}, {0.0, 20.0, 0.0});
    for (const double x : {10.0, 40.0, 100.0, 200.0}) {
        const double left = 0.02 * x + 1.0; // side by side as the lamp sees them
        add_sheet(scene, "board", 1, {x, left, 0.0}, {0.0, -1.0 - 0.01 * x, 0.0}, {0.0, 0.0, 0.6});
    }
    Moment moment;
    moment.lamps = {lamp(cut_off_table(), {0.0, 0.0, 0.65})};
    Found worst;
    judge_count(worst, count(bench, scene, moment, map_of("map", 5.0, 280.0, 6.0, 48, 550)), "road behind boards");
    return worst;
}

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

Found far(StabilityBench& bench) {
    Found worst;
    for (const double x : {50.0, 100.0, 200.0, 315.0}) {
        const WallBehindABoard trial(x);
        judge_count(worst, count(bench, trial.scene, trial.moment, trial.view), fmt::format("wall at {} m", x));
    }
    return worst;
}

/// Farther than the maps reach: all shadows are missing there, and the technique says so.
Found beyond(StabilityBench& bench) {
    constexpr double maps_end_m = 300.0;
    Found worst;
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
                  fmt::format("wall at {} m: {:.3g} lx where it should be dark", x, leak));
    }
    const bool said = technique_named("photometric").ignores.find("farther than 300 m") != std::string_view::npos;
    worst.add(said ? 0.0 : 2.0, "what the technique says that it ignores");
    return worst;
}

} // namespace

std::vector<StabilityCase> shadow_cases() {
    const std::string reason = "pixels in doubt are left out: those where rays from within a texel and the look-up's height do not agree";
    return {
        {"shadow", "waves", "light that grazes crests: a surface that shades itself, light behind crests", 0.0, "pixels drawn wrongly",
         reason, waves},
        {"shadow", "boards", "shadows of boards on a road at down to 0.15 degrees of incidence", 0.0, "pixels drawn wrongly", reason,
         boards},
        {"shadow", "far", "shadows out to 300 m, where a texel is 0.3 m wide", 0.0, "pixels drawn wrongly", reason, far},
        {"shadow", "beyond-the-maps", "a shadow at 500 m and 1000 m: the maps end 300 m from the lamp", 1.0,
         "of the lamp's peak over (300 m)^2",
         "what leaks is the light of one lamp farther away than that: a limit, which `fernlicht techniques` tells under what is ignored",
         beyond},
    };
}

} // namespace fernlicht
