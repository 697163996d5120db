#include "scenarios/drives/mirrored_control.h"

#include "scenarios/drives/mirrored_drive.h"

#include <algorithm>

namespace fernlicht {

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
    for (ScriptedSignal& input : control.inputs)
        for (const std::string_view sideways : {"ego.yaw_rate_rad_s", "ego.steering_rad", "ego.indicator"})
            if (input.name == sideways)
                for (auto& [at_s, value] : input.values)
                    change_sign(value);
    return control;
}

} // namespace fernlicht
