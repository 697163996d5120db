// Shadow maps against rays, where they end and beyond.
#include "runner/experiments/stability/shadow_trial.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

using namespace stability;

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

Found far(StabilityBench& bench) {
    Found worst;
    for (const double x : {50.0, 100.0, 200.0, 315.0}) {
        const WallBehindABoard trial(x);
        ShadowTrial drawn(bench, trial.scene, shadows_by(ShadowMethod::map));
        judge_tally(worst, drawn.tally(trial.moment, trial.view, map_shadow_tolerance(1.02 * texel_tangent)),
                    fmt::format("wall at {} m", x));
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
    return {
        {"shadow", "far", "shadows out to 300 m, where a texel is 0.3 m wide", 0.0, "pixels drawn wrongly",
         "pixels in doubt are left out: those where rays from within a texel and the look-up's height do not agree", far},
        {"shadow", "beyond-the-maps", "a shadow at 500 m and 1000 m: the maps end 300 m from the lamp", 1.0,
         "of the lamp's peak over (300 m)^2",
         "what leaks is the light of one lamp farther away than that: a limit, which `fernlicht techniques` tells under what is ignored",
         beyond},
    };
}

} // namespace fernlicht
