// Where the camera stands against the lamps, and how far both stand from the origin of the world.
#include "runner/experiments/stability/trial.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using namespace stability;

/// A road, a retroreflecting board over it and a wall behind the lamp.
Scene street(const glm::dvec3& origin_m) {
    Scene scene = empty_scene();
    add_sheet(scene, "road", 0, origin_m + glm::dvec3(-20.0, -10.0, 0.0), {120.0, 0.0, 0.0}, {0.0, 20.0, 0.0});
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
Found beside_the_lamp(StabilityBench& bench) {
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
    Found worst;
    for (const Place& place : places) {
        Moment moment;
        moment.lamps = {lamp(cut_off_table(), {3.5, 0.0, 0.65}, radians(place.lamp_yaw_deg))};
        const AgainstTwin found = against_twin(renderer, scene, moment, camera(place.eye_m, radians(place.yaw_deg), -0.03, 40.0, 48, 32));
        worst.add(found.error(), fmt::format("{}: {}, {:.1e} relative", place.name, found.where, found.worst_relative));
    }
    return worst;
}

/// The same street at the world's origin and at 1e7 m: the same light.
Found far_from_the_origin(StabilityBench& bench) {
    Found worst;
    for (const double far_m : {0.0, 1.0, 1e3, 1e5, 1e6, 1e7}) {
        const glm::dvec3 origin{far_m, -0.7 * far_m, 1e-3 * far_m};
        const Scene scene = street(origin);
        Renderer renderer(bench.device(), scene, unshadowed());
        Moment moment;
        moment.ego.position_m = origin;
        moment.lamps = {lamp(cut_off_table(), origin + glm::dvec3(3.5, 0.6, 0.65))};
        const AgainstTwin found = against_twin(renderer, scene, moment, camera({1.3, 0.35, 1.2}, 0.0, -0.03, 40.0, 48, 32));
        worst.add(found.error(), fmt::format("{:.0e} m: {}, {:.1e} relative", far_m, found.where, found.worst_relative));
    }
    return worst;
}

} // namespace

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
