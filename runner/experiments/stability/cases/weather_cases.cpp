// Sun, moon, fog and water where they are hardest: at the horizon, at the poles, thin as nothing and thick as a wall.
#include "runner/experiments/stability/trial.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/sky/daylight.h"
#include "scenarios/sky/weather.h"

#include <algorithm>
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

/// Days of four centuries, and dates far from where the fits were made, from pole to pole: figures, unit vectors, and never two lights.
Found every_day(StabilityBench&) {
    Found worst;
    const auto add = [&worst](const SkyClock& clock) {
        Daylight day;
        day.clock = clock;
        const Daylight at = daylight_at(day, 0.0);
        const double sky = at.horizontal_illuminance_lx, sun = at.sun.illuminance_lx, moon = at.moon.illuminance_lx;
        const bool one = sun == 0.0 || moon == 0.0,
                   within = sky > 1e-4 && sky < 60'000.0 && sun >= 0.0 && sun < 110'000.0 && moon >= 0.0 && moon < 0.4;
        const double off = std::abs(glm::length(at.sun.towards()) - 1.0) + std::abs(glm::length(at.moon.towards()) - 1.0);
        worst.add(one && within ? off : infinity, fmt::format("{}-{}, latitude {}", clock.year, clock.month, clock.latitude_deg));
    };
    for (int year = 1800; year < 2200; year += 7)
        for (const double latitude_deg : {-90.0, -66.5, 0.0, 48.0, 90.0})
            for (int k = 0; k < 12; ++k)
                add({year, 1 + k, 1 + 2 * k, 7000 * k, 0.0, latitude_deg, 180.0 - 30.0 * k, static_cast<SkyCover>(k % 3), 0.0});
    for (const int year : {-4712, -2000, 0, 1582, 4000, 9999})
        for (const double latitude_deg : {-90.0, 0.0, 69.0, 90.0})
            for (int month = 1; month <= 12; ++month)
                for (const int hour : {0, 6, 12, 18})
                    add({year, month, 21, 3600 * hour, 0.0, latitude_deg, 0.0, SkyCover::clear, 0.0});
    return worst;
}

/// Hours of half a year round midsummer at which the sun is down at 69 degrees north, and of those round midwinter at which it is up; near
/// the pole the sun's height through a midsummer's day moves by next to nothing.
Found midnight_sun(StabilityBench&) {
    Found worst;
    const auto sun_lx = [](int month, int hour, double latitude_deg) {
        Daylight day;
        day.clock = SkyClock{2026, month, 21, 3600 * hour, 0.0, latitude_deg, 0.0, SkyCover::clear, 0.0};
        return daylight_at(day, 0.0);
    };
    int wrong = 0;
    for (int hour = 0; hour < 24; ++hour) {
        wrong += sun_lx(6, hour, 69.0).sun.illuminance_lx > 0.0 ? 0 : 1;
        wrong += sun_lx(12, hour, 69.0).sun.illuminance_lx > 0.0 ? 1 : 0;
    }
    worst.add(wrong, "hours at 69 degrees north");
    double least = infinity, most = 0.0;
    for (int hour = 0; hour < 24; ++hour) {
        const double lx = sun_lx(6, hour, 90.0).horizontal_illuminance_lx;
        least = std::min(least, lx), most = std::max(most, lx);
    }
    worst.add(most / least > 1.01 ? infinity : 0.0, "a day at the pole");
    return worst;
}

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
    return {
        {"weather", "every-day", "poles, polar night, year ends, years -4712 to 9999", 1e-12, "of 1",
         "directions are made of sines and cosines, each exact to 1e-16; polynomials in time may leave their fits, light not its bounds",
         every_day},
        {"weather", "midnight-sun", "midsummer and midwinter at 69 degrees north; a day at the pole", 0.0, "hours that are wrong",
         "the sun is up all day or none of it; at the pole a day's sky light stays within 1 %", midnight_sun},
        {"weather", "fog-at-its-ends", "ranges of 1 mm and 1e9 m; a lamp in the eye, before and behind it, the own and others'", 0.0,
         "luminances that are no number, or light through a wall of fog", "exp underflows to 0, and rays near a lamp count from 1 mm on",
         fog_at_its_ends},
        {"weather", "street-lamp-on-the-ground", "a lamp of others in the surface that it lights: 0/0 in direction and distance", 0.0,
         "pixels that are not finite", "others' lamps count from 1 mm on", street_lamp_on_the_ground},
        {"weather", "airlight-in-closed-form", "rays from 1 mm to 1 km past a lamp, 1 mm to 1 km long", 1e-5, "relative",
         "midpoints are doubled until the sum moves by 1e-7 twice; their error falls with the square", airlight_of_an_even_lamp},
        {"weather", "grazing-water", "cosines down to 0 on both sides", 47.2, "cd/m2 per lux",
         "facets' largest density 1 / (pi alpha^2) over 2 alpha, where light grazes and the eye more so: 47.16 at alpha 0.15",
         grazing_water}};
}

} // namespace fernlicht
