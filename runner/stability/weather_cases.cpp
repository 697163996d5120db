// Sun, moon, fog and water where they are hardest: at the horizon, at the poles, thin as nothing and thick as a wall.
#include "runner/stability/trial.h"
#include "scenarios/fog_light.h"
#include "scenarios/sky/daylight.h"
#include "scenarios/wet_light.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
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

/// Parallel light from everywhere, the horizon and below included, against the twin.
Found sun_everywhere(StabilityBench& bench) {
    const Scene scene = road_and_board();
    Renderer renderer(bench.device(), scene, unshadowed());
    Found worst;
    for (const double elevation_deg : {90.0, 89.999, 30.0, 0.01, 0.0, -0.01, -30.0})
        for (const double azimuth_deg : {0.0, 90.0, 359.999})
            for (const double lx : {1e-6, 0.2, 150'000.0}) {
                Moment moment;
                moment.daylight.sun = {radians(azimuth_deg), radians(elevation_deg), lx};
                const AgainstTwin found = against_twin(renderer, scene, moment, ahead());
                worst.add(found.error(), fmt::format("{} lx at {} degrees, azimuth {}; {}", lx, elevation_deg, azimuth_deg, found.where));
            }
    return worst;
}

/// Every day of two centuries from pole to pole: figures, unit vectors, and never two lights.
Found every_day(StabilityBench&) {
    Found worst;
    for (int year = 1800; year < 2200; year += 7)
        for (const double latitude_deg : {-90.0, -66.5, 0.0, 48.0, 90.0})
            for (int k = 0; k < 12; ++k) {
                Daylight day;
                day.clock =
                    SkyClock{year, 1 + k, 1 + 2 * k, 7000 * k, 0.0, latitude_deg, 180.0 - 30.0 * k, static_cast<SkyCover>(k % 3), 0.0};
                const Daylight at = daylight_at(day, 0.0);
                const bool one = at.sun.illuminance_lx == 0.0 || at.moon.illuminance_lx == 0.0;
                const double sky = at.horizontal_illuminance_lx;
                const bool within = sky > 1e-4 && sky < 60'000.0 && at.sun.illuminance_lx >= 0.0 && at.sun.illuminance_lx < 110'000.0 &&
                                    at.moon.illuminance_lx >= 0.0 && at.moon.illuminance_lx < 0.4;
                const double off = std::abs(glm::length(at.sun.towards()) - 1.0) + std::abs(glm::length(at.moon.towards()) - 1.0);
                worst.add(one && within ? off : infinity, fmt::format("{}-{}, latitude {}", year, 1 + k, latitude_deg));
            }
    return worst;
}

/// Nothing of the air is seen where there is none, and all that is drawn is a number from 1e-9 to 10 per metre, from within a lamp too.
Found fog_of_all_densities(StabilityBench& bench) {
    const Scene scene = road_and_board();
    RendererSettings settings = unshadowed();
    Renderer renderer(bench.device(), scene, settings);
    Found worst;
    for (const double extinction : {1e-9, 1e-4, 0.03, 1.0, 10.0})
        for (const double g : {0.0, 0.9})
            for (const glm::dvec3& at : {glm::dvec3(3.4, 0.6, 0.65), glm::dvec3(1.3, 0.35, 1.2), glm::dvec3(25.0, 0.35, 1.2)}) {
                Moment moment;
                moment.weather = {extinction, 1.0, g, 0.0};
                moment.lamps = {lamp(cut_off_table(), at)};
                const Frame frame = renderer.draw(moment, ahead(), {.luminance = true});
                Moment unlit = moment;
                unlit.lamps.clear();
                const Frame air_alone = renderer.draw(unlit, ahead(), {.luminance = true});
                double negative = not_finite(frame) > 0 ? infinity : 0.0;
                for (std::size_t i = 0; i < frame.luminance_cdm2.size(); ++i)
                    negative =
                        frame.luminance_cdm2.pixels()[i] < 0.0F || air_alone.luminance_cdm2.pixels()[i] != 0.0F ? infinity : negative;
                worst.add(negative, fmt::format("{} per metre, g {}, lamp {} m ahead", extinction, g, at.x));
            }
    return worst;
}

/// The sum of midpoints in double against closed form, from thin air past a lamp at 1 mm to 1 km.
Found airlight_of_an_even_lamp(StabilityBench&) {
    Found worst;
    const LitLamp even = lamp(constant_table(1000.0), {});
    for (const double apart_m : {1e-3, 0.1, 10.0, 1000.0})
        for (const double way_m : {1e-3, 1.0, 1000.0}) {
            const double from = 2.0 * apart_m, angle = std::atan((from + way_m) / apart_m) - std::atan(from / apart_m);
            const double truth = 1e-12 * 1000.0 * angle / (4.0 * pi * apart_m);
            const double found = airlight_cdm2(even, {1e-12, 1.0, 0.0, 0.0}, {from, apart_m, 0.0}, {from + way_m, apart_m, 0.0}, 1e-7);
            worst.add(std::abs(found / truth - 1.0), fmt::format("{} m apart, {} m long", apart_m, way_m));
        }
    return worst;
}

/// Water seen and lit at grazing angles, in double: finite, and no more than a mirror of its slope can give.
Found grazing_water(StabilityBench&) {
    Found worst;
    const glm::dvec3 up(0.0, 0.0, 1.0);
    for (const double in : {1.0, 0.01, 1e-6, 1e-12, 0.0})
        for (const double out : {1.0, 0.01, 1e-6, 1e-12, 0.0}) {
            const glm::dvec3 to_light(std::sqrt(1.0 - in * in), 0.0, in), to_eye(-std::sqrt(1.0 - out * out), 0.0, out);
            const double l = wet_light(glm::dvec3(0.5), up, to_light, to_eye, 1.0).x;
            worst.add(std::isfinite(l) && l >= 0.0 ? l : infinity, fmt::format("cosines {} and {}", in, out));
        }
    return worst;
}

} // namespace

std::vector<StabilityCase> weather_cases() {
    return {{"weather", "sun-everywhere", "light at and below the horizon, at the zenith, faint as nothing and brightest", 1.0,
             "of the bound", "float arithmetic over the twin's bound of each pixel", sun_everywhere},
            {"weather", "every-day", "poles, polar night, year ends, dates far from the fits", 1e-12, "of 1",
             "directions are made of sines and cosines, each exact to 1e-16", every_day},
            {"weather", "fog-of-all-densities", "extinction 1e-9 to 10 per metre; the eye within the lamp; a lamp ahead", 0.0,
             "luminances that are no number or negative", "none may be, and without lamps and sky the air is black", fog_of_all_densities},
            {"weather", "airlight-in-closed-form", "rays from 1 mm to 1 km past a lamp, 1 mm to 1 km long", 1e-5, "relative",
             "midpoints are doubled until the sum moves by 1e-7 twice; their error falls with the square", airlight_of_an_even_lamp},
            {"weather", "grazing-water", "cosines down to 0 on both sides", 47.2, "cd/m2 per lux",
             "facets' largest density 1 / (pi alpha^2) over 2 alpha, where light grazes and the eye more so: 47.16 at alpha 0.15",
             grazing_water}};
}

} // namespace fernlicht
