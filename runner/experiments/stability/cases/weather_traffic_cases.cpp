// Fog where it is hardest: thin as nothing and thick as a wall; lamps in the ground; lamps of other road users where they are hardest to
// draw.
#include "runner/experiments/stability/trial.h"
#include "scenarios/sky/weather.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using namespace stability;

Scene road_and_board() {
    Scene scene = scene_of_sheet("road", 0, {-50.0, -50.0, 0.0}, {150.0, 0.0, 0.0}, {0.0, 100.0, 0.0});
    add_sheet(scene, "board", 1, {30.0, 3.0, 0.0}, {0.0, -6.0, 0.0}, {0.0, 0.0, 3.0});
    return scene;
}

View ahead() { return camera({1.3, 0.35, 1.2}, 0.0, -0.02, 30.0, 24, 16); }

/// Ranges from a millimetre to farther than the Earth is round, lamps in the eye, on it and behind it, own ones and others': nothing but
/// luminances, and where the air takes all of it, nothing is left.
void fog_at_its_ends(StabilityBench& bench, Found& worst) {
    const Scene scene = road_and_board();
    Renderer renderer(bench.device(), scene, unshadowed());
    const glm::dvec3 eye(1.3, 0.35, 1.2);
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
                double wrong = not_finite(frame) > 0 ? unbounded : 0.0;
                for (const float cdm2 : frame.luminance_cdm2.pixels())
                    wrong = cdm2 < 0.0F ? unbounded : wrong;
                for (const float lx : frame.illuminance_lx.pixels()) // every surface is more than 0.5 m from eye and lamp: e^-1500
                    wrong = range_m < 0.01 && lx != 0.0F ? unbounded : wrong;
                worst.add(wrong, fmt::format("range {} m, {} lamp at {} m", range_m, other ? "other's" : "own", at.x), pixels_in(frame));
            }
}

/// Lamps of others in the surface that they light, a nanometre and a millimetre from it, in clear air and fog: numbers in every pixel.
void street_lamp_on_the_ground(StabilityBench& bench, Found& worst) {
    const Scene scene = road_and_board();
    Renderer renderer(bench.device(), scene, unshadowed());
    for (const double above_m : {0.0, 1e-9, 1e-3, -1e-3})
        for (const double extinction : {0.0, 0.03})
            for (const double wetness : {0.0, 1.0}) {
                Moment moment;
                moment.weather = {extinction, 1.0, 0.85, wetness};
                moment.other_lamps = {lamp(constant_table(1350.0), {10.0, 0.35, above_m}, 0.0, -0.5 * pi)};
                moment.other_lamps[0].body = -2;
                const Frame frame = renderer.draw(moment, ahead(), everything);
                worst.add(not_finite(frame) > 0 ? unbounded : 0.0, fmt::format("{} m above the road", above_m), pixels_in(frame));
            }
}

/// A road, a board that returns light, and a wall that does not: what is lit by fragment and what by vertex.
Scene lit_by_others() {
    Scene scene = scene_of_sheet("road", 0, {-50.0, -50.0, 0.0}, {250.0, 0.0, 0.0}, {0.0, 100.0, 0.0});
    add_sheet(scene, "board", 1, {30.0, 3.0, 0.0}, {0.0, -6.0, 0.0}, {0.0, 0.0, 3.0});
    Material wall;
    wall.name = "wall";
    scene.materials.push_back(wall);
    add_sheet(scene, "wall", static_cast<std::uint32_t>(scene.materials.size() - 1), {60.0, 12.0, 0.0}, {0.0, -24.0, 0.0}, {0.0, 0.0, 5.0});
    return scene;
}

View eyes() { return camera({1.3, 0.35, 1.2}, 0.0, -0.05, 40.0, 48, 32); }

/// A pair that shines back along the road.
void add_pair(Moment& moment, const glm::dvec3& middle_m, double factor, double yaw_rad, double apart_m) {
    static const LitLamp shape = lamp(cut_off_table(), {});
    const int body = static_cast<int>(moment.other_lamps.size());
    for (const double side : {0.5, -0.5}) {
        LitLamp one = lamp({}, middle_m + glm::dvec3(0.0, side * apart_m, 0.0), yaw_rad, -0.01);
        one.file = shape.file;
        one.intensity_factor = factor;
        one.body = body;
        one.face_m = {0.16, 0.12};
        moment.other_lamps.push_back(std::move(one));
    }
}

struct TrafficPlace {
    const char* name;
    glm::dvec3 at_m;
    double factor = 1.0, yaw_rad = pi, apart_m = 1.2;
};

/// Where lamps are hardest to draw. The camera's eye is at (1.3, 0.35, 1.2).
const TrafficPlace hard_places[] = {
    {"0.1 m from the eye", {1.4, 0.35, 1.2}},
    {"in the eye", {1.3, 0.35, 1.2}},
    {"1 um from the road", {20.0, 0.0, 1e-6}},
    {"on the road, its beam along it", {20.0, 0.0, 0.0}},
    {"below the road", {20.0, 0.0, -1.0}},
    {"in the board", {30.0, 0.0, 1.0}},
    {"1 mm before the wall", {59.999, 0.0, 1.0}, 1.0, 0.0},
    {"both lamps in one place", {40.0, 0.0, 0.65}, 1.0, pi, 0.0},
    {"lamps 1000 km apart", {40.0, 0.0, 0.65}, 1.0, pi, 1e6},
    {"50 km away", {5e4, 0.0, 0.65}},
    {"1e9 m away", {1e9, 0.0, 0.65}},
    {"off", {40.0, 0.0, 0.65}, 0.0},
    {"of 1e-38 of its light", {40.0, 0.0, 0.65}, 1e-38},
    {"of 1e8 times its light", {40.0, 0.0, 0.65}, 1e8},
    {"behind, looking away", {-10.0, 0.0, 0.65}},
    {"behind, looking ahead", {-10.0, 0.0, 0.65}, 1.0, 0.0},
};

/// Every picture is made of numbers, with levels and without, and pruning changes no byte.
void hardest_places_of_others(StabilityBench& bench, Found& worst) {
    const Scene scene = lit_by_others();
    RendererSettings unpruned = unshadowed(), fine = unshadowed();
    unpruned.technique = "photometric-unpruned";
    fine.traffic_levels = false;
    Renderer coarse(bench.device(), scene, unshadowed()), whole(bench.device(), scene, unpruned), each(bench.device(), scene, fine);
    for (const TrafficPlace& place : hard_places)
        for (const double min_lx : {1e-9, 0.05, 100.0}) {
            Moment moment;
            moment.min_traffic_lx = min_lx;
            add_pair(moment, place.at_m, place.factor, place.yaw_rad, place.apart_m);
            const Frame a = coarse.draw(moment, eyes(), everything), b = whole.draw(moment, eyes(), everything),
                        c = each.draw(moment, eyes(), everything);
            double wrong = static_cast<double>(not_finite(a) + not_finite(b) + not_finite(c));
            for (std::size_t i = 0; i < a.illuminance_lx.size(); ++i)
                wrong += a.illuminance_lx.pixels()[i] != b.illuminance_lx.pixels()[i] ? 1.0 : 0.0;
            worst.add(wrong, fmt::format("{}, least {} lx", place.name, min_lx), 3 * pixels_in(a));
        }
}

/// 2000 cars: numbers everywhere, and no more light than all of them bring facing the receiver.
void two_thousand_cars(StabilityBench& bench, Found& worst) {
    const Scene scene = lit_by_others();
    Renderer renderer(bench.device(), scene, unshadowed());
    for (const double every_m : {0.0, 0.5, 20.0}) {
        Moment moment;
        double most = 0.0;
        for (int i = 0; i < 2000; ++i)
            add_pair(moment, {20.0 + every_m * i, -2.0, 0.65}, 1.0, pi, 1.2);
        const Frame frame = renderer.draw(moment, eyes(), everything);
        for (const float lx : frame.illuminance_lx.pixels())
            most = std::max(most, static_cast<double>(lx));
        worst.add(not_finite(frame) > 0 || !(most > 1.0) || most > 2000.0 * 2.0 * 20'000.0 / (0.5 * 0.5) ? unbounded : 0.0,
                  fmt::format("each {} m", every_m), pixels_in(frame));
    }
}

} // namespace

std::vector<StabilityCase> weather_cases() {
    return {{"weather", "fog-at-its-ends",
             "ranges of 1 mm and 1e9 m; lamps in the eye, before and behind it, of the own car and of other vehicles", 0.0,
             "luminances that are no number, or light through a wall of fog",
             "exp underflows to 0, and rays near a lamp count from 1 mm on", fog_at_its_ends},
            {"weather", "street-lamp-on-the-ground", "a street lamp in the surface that it lights: 0/0 in direction and distance", 0.0,
             "pixels that are not finite", "other lamps count from 1 mm on", street_lamp_on_the_ground}};
}

std::vector<StabilityCase> traffic_cases() {
    return {{"traffic", "hardest-places",
             "lamps in the eye, in bodies, on and below the road, coincident, 1e9 m away, off and far too bright", 0.0,
             "values that are not finite or that pruning changes", "distances and ramps are clamped; what is pruned adds exactly 0",
             hardest_places_of_others},
            {"traffic", "two-thousand-cars", "lists of 4000 lamps, all in one place or in a row of 40 km", 0.0,
             "pictures with values that are not finite or impossible", "sums of floats of one sign", two_thousand_cars}};
}

} // namespace fernlicht
