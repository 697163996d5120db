// Fog where it is hardest: thin as nothing and thick as a wall; and lamps in the ground.
#include "runner/experiments/stability/trial.h"
#include "scenarios/sky/weather.h"

#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

using namespace stability;

constexpr double infinity = std::numeric_limits<double>::infinity();

Scene road_and_board() {
    Scene scene = empty_scene();
    add_sheet(scene, "road", 0, {-50.0, -50.0, 0.0}, {150.0, 0.0, 0.0}, {0.0, 100.0, 0.0});
    add_sheet(scene, "board", 1, {30.0, 3.0, 0.0}, {0.0, -6.0, 0.0}, {0.0, 0.0, 3.0});
    return scene;
}

View ahead() { return camera({1.3, 0.35, 1.2}, 0.0, -0.02, 30.0, 24, 16); }

/// Ranges from a millimetre to farther than the Earth is round, lamps in the eye, on it and behind it, own ones and others': nothing but
/// luminances, and where the air takes all of it, nothing is left.
Found fog_at_its_ends(StabilityBench& bench) {
    const Scene scene = road_and_board();
    Renderer renderer(bench.device(), scene, unshadowed());
    const glm::dvec3 eye(1.3, 0.35, 1.2);
    Found worst;
    for (const double range_m : {1e-3, 1.0, 1e9})
        for (const bool other : {false, true})
            for (const auto& [at, yaw] : {std::pair(eye, 0.0), std::pair(eye + glm::dvec3(1e-4, 0.0, 0.0), pi),
                                          std::pair(eye - glm::dvec3(5.0, 0.0, 0.0), pi), std::pair(eye + glm::dvec3(9.0, 0.0, 0.0), pi)}) {
                Moment moment;
                moment.weather.extinction_per_m = extinction_of_range_per_m(range_m);
                LitLamp one = lamp(cut_off_table(), at, yaw);
                one.body = other ? -2 : -1;
                (other ? moment.other_lamps : moment.lamps) = {one};
                const Frame frame = renderer.draw(moment, ahead(), {.illuminance = true, .luminance = true});
                double wrong = not_finite(frame) > 0 ? infinity : 0.0;
                for (const float cdm2 : frame.luminance_cdm2.pixels())
                    wrong = cdm2 < 0.0F ? infinity : wrong;
                for (const float lx : frame.illuminance_lx.pixels()) // every surface is more than 0.5 m from eye and lamp: e^-1500
                    wrong = range_m < 0.01 && lx != 0.0F ? infinity : wrong;
                worst.add(wrong, fmt::format("range {} m, {} lamp at {} m", range_m, other ? "other's" : "own", at.x));
            }
    return worst;
}

/// Lamps of others in the surface that they light, a nanometre and a millimetre from it, in clear air and fog: numbers in every pixel.
Found street_lamp_on_the_ground(StabilityBench& bench) {
    const Scene scene = road_and_board();
    Renderer renderer(bench.device(), scene, unshadowed());
    Found worst;
    for (const double above_m : {0.0, 1e-9, 1e-3, -1e-3})
        for (const double extinction : {0.0, 0.03})
            for (const double wetness : {0.0, 1.0}) {
                Moment moment;
                moment.weather = {extinction, 1.0, 0.85, wetness};
                moment.other_lamps = {lamp(constant_table(1350.0), {10.0, 0.35, above_m}, 0.0, -0.5 * pi)};
                moment.other_lamps[0].body = -2;
                const Frame frame = renderer.draw(moment, ahead(), everything);
                worst.add(not_finite(frame) > 0 ? infinity : 0.0, fmt::format("{} m above the road", above_m));
            }
    return worst;
}

} // namespace

std::vector<StabilityCase> weather_cases() {
    return {{"weather", "fog-at-its-ends", "ranges of 1 mm and 1e9 m; a lamp in the eye, before and behind it, the own and others'", 0.0,
             "luminances that are no number, or light through a wall of fog",
             "exp underflows to 0, and rays near a lamp count from 1 mm on", fog_at_its_ends},
            {"weather", "street-lamp-on-the-ground", "a lamp of others in the surface that it lights: 0/0 in direction and distance", 0.0,
             "pixels that are not finite", "others' lamps count from 1 mm on", street_lamp_on_the_ground}};
}

} // namespace fernlicht
