#include "scenarios/drives/edits/mirrored_drive.h"

#include "scenarios/drives/edits/mirrored_control.h"

#include <cctype>
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

void mirror(SeeingParameters& seeing) {
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
        turned.table = mirrored(file->table);
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
        lamp.file = other_lamp(drive, lamp.file);
    }
    for (LampChange& change : changes) {
        change.lamp = other_side(change.lamp);
        change_sign(change.yaw_rad);
        change_sign(change.roll_rad);
        if (change.file)
            change.file = other_lamp(drive, change.file);
    }
}

void mirror(Variant& variant, Drive& drive) {
    mirror(variant.lamps, variant.changes, drive);
    if (variant.control)
        variant.control = std::make_shared<const ControlParameters>(mirrored(*variant.control));
    if (!variant.swivel)
        return;
    ActuatorParameters& actuator = variant.swivel->actuator;
    std::swap(actuator.least_rad, actuator.greatest_rad);
    change_sign(actuator.least_rad);
    change_sign(actuator.greatest_rad);
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
        for (Variant& variant : drive.variants)
            mirror(variant, drive);
    for (TrafficRow& row : drive.traffic_rows)
        mirror(row.lamps, row.changes, drive);
    for (Limit& limit : drive.limits)
        limit.reading = other_side(limit.reading);
}

} // namespace fernlicht
