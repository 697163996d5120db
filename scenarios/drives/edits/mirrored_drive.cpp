#include "scenarios/drives/edits/mirrored_drive.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <utility>

namespace fernlicht {
namespace {

bool is_letter_at(const std::string& text, std::size_t at) {
    return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0;
}

void mirror(View& view) {
    change_sign(view.position_m.y);
    change_sign(view.yaw_rad);
    change_sign(view.roll_rad);
    std::swap(view.map_left_m, view.map_right_m);
}

/// Stops of a swivel.
void mirror(ActuatorParameters& actuator) {
    std::swap(actuator.min_rad, actuator.max_rad);
    change_sign(actuator.min_rad);
    change_sign(actuator.max_rad);
}

void mirror(std::optional<Tolerance>& sideways) {
    if (!sideways)
        return;
    change_sign(sideways->mean);
    std::swap(sideways->from, sideways->to);
    for (std::optional<double>* end : {&sideways->from, &sideways->to})
        if (*end)
            change_sign(**end);
}

void mirror(SeeingParameters& seeing) {
    if (seeing.tolerances) {
        mirror(seeing.tolerances->yaw_deg);
        mirror(seeing.tolerances->roll_deg);
        for (Limit& limit : seeing.tolerances->limits)
            limit.reading = other_side(limit.reading);
    }
    if (seeing.sensors)
        for (Sensor& sensor : seeing.sensors->points) {
            sensor.name = other_side(sensor.name);
            sensor.across = sensor.across == Across::right_edge  ? Across::left_edge
                            : sensor.across == Across::left_edge ? Across::right_edge
                                                                 : sensor.across;
        }
    if (!seeing.glare)
        return;
    for (GlareObserver& observer : seeing.glare->oncoming)
        observer.name = other_side(observer.name);
    if (seeing.glare->adaptation_lamp)
        seeing.glare->adaptation_lamp->mirrored = !seeing.glare->adaptation_lamp->mirrored;
    if (!seeing.glare->mirrors)
        return;
    change_sign(seeing.glare->mirrors->eye_m.y);
    for (Mirror& glass : seeing.glare->mirrors->mirrors) {
        glass.name = other_side(glass.name);
        change_sign(glass.position_m.y);
    }
}

/// The same file with its table mirrored; each once.
std::shared_ptr<const LampFile> other_lamp(Drive& drive, const std::shared_ptr<const LampFile>& file) {
    for (const LampSource& source : drive.lamp_sources) {
        if (source.file != file)
            continue;
        LampSource other = source;
        other.options.mirrored = !source.options.mirrored;
        for (const LampSource& known : drive.lamp_sources)
            if (known.path == other.path && known.options == other.options)
                return known.file;
        LampFile turned = *file;
        mirror(turned);
        other.file = std::make_shared<const LampFile>(std::move(turned));
        drive.lamp_sources.push_back(other);
        return other.file;
    }
    return file;
}

void mirror(std::vector<MountedLamp>& lamps, std::vector<LampChange>& changes, Drive& drive) {
    for (MountedLamp& lamp : lamps) {
        lamp.name = other_side(lamp.name);
        change_sign(lamp.position_m.y);
        change_sign(lamp.yaw_rad);
        change_sign(lamp.roll_rad);
        change_sign(lamp.mount.yaw_rad);
        change_sign(lamp.mount.roll_rad);
        change_sign(lamp.aligned.yaw_rad);
        change_sign(lamp.aligned.roll_rad);
        if (lamp.levels)
            throw InputError({drive.file, 0, 0, fmt::format("lamps.{}.levels", other_side(lamp.name))},
                             "levels over time in a drive that is mirrored", "levels for the other side, in a drive of their own");
        lamp.file = other_lamp(drive, lamp.file);
    }
    for (LampChange& change : changes) {
        change.lamp = other_side(change.lamp);
        change_sign(change.yaw_rad);
        change_sign(change.roll_rad);
        if (change.aligned) {
            change_sign(change.aligned->yaw_rad);
            change_sign(change.aligned->roll_rad);
        }
        if (change.file)
            change.file = other_lamp(drive, change.file);
    }
}

void mirror(LampSet& lamp_set, Drive& drive) {
    mirror(lamp_set.lamps, lamp_set.changes, drive);
    if (lamp_set.control)
        lamp_set.control = std::make_shared<const ControlParameters>(mirrored(*lamp_set.control));
    if (lamp_set.swivel)
        mirror(lamp_set.swivel->actuator);
}

} // namespace

std::string other_side(const std::string& name) {
    std::string out;
    for (std::size_t at = 0; at < name.size();) {
        const bool begins = at == 0 || !is_letter_at(name, at - 1);
        const bool left = begins && name.compare(at, 4, "left") == 0 && !is_letter_at(name, at + 4);
        const bool right = begins && name.compare(at, 5, "right") == 0 && !is_letter_at(name, at + 5);
        if (left || right) {
            out += left ? "right" : "left";
            at += left ? 4 : 5;
        } else {
            out += name[at++];
        }
    }
    return out;
}

void mirror_traffic(Drive& drive, bool lamps) {
    drive.mirrored_road = !drive.mirrored_road;
    for (View& view : drive.views)
        mirror(view);
    for (Probe& probe : drive.probes) {
        probe.name = other_side(probe.name);
        change_sign(probe.left_m);
    }
    mirror(drive.seeing);
    if (drive.can)
        drive.can = std::make_shared<const BusMapping>(mirrored(*drive.can));
    for (PlacedModel& placed : drive.scenery) { // the model itself keeps its sides
        change_sign(placed.position_m.y);
        change_sign(placed.yaw_rad);
        change_sign(placed.roll_rad);
    }
    for (StreetLampRow& row : drive.street_lamps)
        change_sign(row.beside_m);
    if (lamps)
        for (LampSet& lamp_set : drive.lamp_sets)
            mirror(lamp_set, drive);
    for (TrafficRow& row : drive.traffic_rows)
        mirror(row.lamps, row.changes, drive);
    for (Limit& limit : drive.limits)
        limit.reading = other_side(limit.reading);
}

namespace {

bool points_to_a_side(const std::string& signal) {
    for (const std::string_view sideways : {"ego.yaw_rate_rad_s", "ego.steering_rad", "ego.indicator"})
        if (signal == sideways)
            return true;
    return signal.starts_with("others[")
               ? signal.ends_with(".left_rad") || signal.ends_with(".right_rad")
               : signal.starts_with("road.curvature") || signal.starts_with("road.bearing") || signal == "control.bend_rad" ||
                     (signal.starts_with("lamp.") && (signal.ends_with(".swivel_rad") || signal.ends_with(".swivel_command_rad")));
}

/// "lamp.right.level" of "lamp.left.level", "others[1].right_rad" of "others[1].left_rad".
std::string other_signal(const std::string& signal) {
    if (signal.starts_with("others["))
        return other_side(signal);
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
        mirror(control.bend->actuator);
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
    const auto check = [](const auto& mapped) {
        for (const auto& signal : mapped)
            if (signal.name.find(".segments[") != std::string::npos)
                throw InputError(signal.where, fmt::format("{} in a drive that is mirrored", signal.name),
                                 "levels of windows for the other side, in a drive of their own");
    };
    check(mapping.inputs);
    check(mapping.outputs);
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
