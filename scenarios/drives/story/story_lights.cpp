#include "scenarios/drives/story/story_lights.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double ramp_step_s = 0.02;

struct Ramp {
    std::vector<LampChange>& out;
    const std::string& lamp;
    double level; ///< now

    void to(double target, double from_s, double lasts_s, double until_s) {
        const int steps = std::clamp(static_cast<int>(std::ceil(lasts_s / ramp_step_s)), 1, 1000);
        const double from = level;
        for (int i = 1; i <= steps; ++i) {
            const double share = static_cast<double>(i) / steps, time = from_s + (lasts_s > 0.0 ? share * lasts_s : 0.0);
            if (time >= until_s)
                return;
            level = std::lerp(from, target, share);
            out.push_back({time, lamp, level, {}, {}, {}, {}, {}, {}});
        }
    }
};

} // namespace

bool is_light(const std::string& light, LampFunction function) {
    using F = LampFunction;
    const auto one_of = [function](std::initializer_list<F> functions) {
        return std::ranges::find(functions, function) != functions.end();
    };
    if (light == "lowBeam")
        return one_of({F::low, F::tail, F::position}); // wired together (UN R48, 5.11)
    if (light == "highBeam")
        return one_of({F::high});
    if (light == "daytimeRunningLights")
        return one_of({F::daytime});
    if (light == "fogLights")
        return one_of({F::fog, F::rear_fog});
    if (light == "fogLightsFront")
        return one_of({F::fog});
    if (light == "fogLightsRear")
        return one_of({F::rear_fog});
    if (light == "brakeLights")
        return one_of({F::brake});
    if (light == "reversingLights")
        return one_of({F::reverse});
    if (light == "indicatorLeft")
        return one_of({F::indicator_left});
    if (light == "indicatorRight")
        return one_of({F::indicator_right});
    return light == "warningLights" && one_of({F::indicator_left, F::indicator_right});
}

std::vector<LampChange> light_changes(const std::vector<osc::LightChange>& lights, const std::vector<TrafficLamp>& lamps, double end_s) {
    std::vector<LampChange> out;
    for (const TrafficLamp& mounted : lamps) {
        const double lit = mounted.lamp.level > 0.0 ? mounted.lamp.level : 1.0;
        Ramp ramp{out, mounted.lamp.name, mounted.lamp.level};
        for (std::size_t i = 0; i < lights.size(); ++i) {
            if (!is_light(lights[i].action.light, mounted.function))
                continue;
            double until_s = end_s;
            for (std::size_t k = i + 1; k < lights.size(); ++k)
                if (is_light(lights[k].action.light, mounted.function)) {
                    until_s = std::min(until_s, lights[k].time_s);
                    break;
                }
            const osc::LightStateAction& to = lights[i].action;
            if (to.mode != osc::LightMode::flashing) {
                ramp.to(to.mode == osc::LightMode::on ? lit : 0.0, lights[i].time_s, to.transition_s, until_s);
                continue;
            }
            for (double time_s = lights[i].time_s; time_s < until_s; time_s += to.flash_on_s + to.flash_off_s) { // of 10 ms at least
                ramp.to(lit, time_s, 0.0, until_s);
                ramp.to(0.0, time_s + to.flash_on_s, 0.0, until_s);
            }
        }
    }
    std::ranges::stable_sort(out, {}, &LampChange::time_s);
    return out;
}

} // namespace fernlicht
