#include "scenarios/drives/edits/mirrored_control.h"

#include "scenarios/drives/edits/mirrored_drive.h"

#include <algorithm>

namespace fernlicht {
namespace {

bool points_to_a_side(const std::string& signal) {
    for (const std::string_view sideways : {"ego.yaw_rate_rad_s", "ego.steering_rad", "ego.indicator"})
        if (signal == sideways)
            return true;
    return signal.starts_with("road.curvature") || signal.starts_with("road.bearing") || signal == "control.bend_rad" ||
           (signal.starts_with("lamp.") && (signal.ends_with(".swivel_rad") || signal.ends_with(".swivel_command_rad")));
}

/// "lamp.right.level" of "lamp.left.level".
std::string other_signal(const std::string& signal) {
    const std::size_t end = signal.rfind('.');
    if (!signal.starts_with("lamp.") || end < 5)
        return signal;
    return "lamp." + other_side(signal.substr(5, end - 5)) + signal.substr(end);
}

} // namespace

ControlParameters mirrored(ControlParameters control) {
    const auto names = [](std::vector<std::string>& lamps) { std::ranges::transform(lamps, lamps.begin(), other_side); };
    if (control.bend) {
        names(control.bend->lamps);
        ActuatorParameters& actuator = control.bend->actuator;
        std::swap(actuator.least_rad, actuator.greatest_rad);
        change_sign(actuator.least_rad);
        change_sign(actuator.greatest_rad);
    }
    if (control.cornering) {
        names(control.cornering->left);
        names(control.cornering->right);
        std::swap(control.cornering->left, control.cornering->right);
    }
    if (control.modes)
        names(control.modes->lamps);
    if (control.high_beam)
        names(control.high_beam->lamps);
    if (control.glare_free)
        for (SegmentedLamp& lamp : control.glare_free->lamps) {
            lamp.name = other_side(lamp.name);
            std::ranges::reverse(lamp.windows_deg);
            for (auto& [from, to] : lamp.windows_deg)
                std::swap(from, to), change_sign(from), change_sign(to);
        }
    for (PluginParameters& plugin : control.plugins)
        names(plugin.lamps);
    for (ControlFailure& failure : control.failures)
        if (failure.kind != ControlFailure::Kind::lost_signal)
            failure.what = other_side(failure.what);
    for (ScriptedSignal& input : control.inputs) {
        if (points_to_a_side(input.name))
            for (auto& [at_s, value] : input.values)
                change_sign(value);
        input.name = other_signal(input.name);
    }
    return control;
}

BusMapping mirrored(BusMapping mapping) {
    for (BusInput& input : mapping.inputs) {
        if (points_to_a_side(input.name)) {
            input.opposite = !input.opposite;
            change_sign(input.fallback);
        }
        input.name = other_signal(input.name);
    }
    for (BusOutput& output : mapping.outputs) {
        if (points_to_a_side(output.name))
            output.opposite = !output.opposite;
        output.name = other_signal(output.name);
    }
    return mapping;
}

} // namespace fernlicht
