#include "scenarios/studies/axes_on_drive.h"

#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"
#include "scenarios/vehicle/car_model.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <string_view>
#include <utility>

namespace fernlicht {
namespace {

constexpr double max_speed_mps = 150.0; ///< of a drive file

struct NamedAxis {
    std::string_view name;
    double least, greatest;
};

/// In the order of DriveAxis.
constexpr std::array<NamedAxis, 7> named_axes{{{"mount_height_m", 0.05, 10.0},
                                               {"mount_spacing_m", 0.05, 10.0},
                                               {"yaw_deg", -90.0, 90.0},
                                               {"pitch_deg", -45.0, 45.0},
                                               {"roll_deg", -180.0, 180.0},
                                               {"load_kg", -2000.0, 5000.0},
                                               {"speed_factor", 0.0, 10.0}}};

const NamedAxis& named_axis(DriveAxis axis) { return named_axes.at(static_cast<std::size_t>(axis)); }

double axis_number(const std::string& text) {
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

[[noreturn]] void refuse_axis(const Drive& drive, DriveAxis axis, const std::string& found, const std::string& expected) {
    throw InputError({drive.file, 0, 0, std::string(named_axis(axis).name)}, found, expected);
}

void set_spacing(double spacing_m, Drive& drive) {
    std::vector<MountedLamp>& lamps = drive.lamp_sets.front().lamps;
    double left_m = 0.0, right_m = 0.0;
    for (const MountedLamp& lamp : lamps)
        if (!is_high_beam(lamp.name)) {
            left_m = std::max(left_m, lamp.position_m.y);
            right_m = std::min(right_m, lamp.position_m.y);
        }
    if (left_m <= 0.0 || right_m >= 0.0)
        refuse_axis(drive, DriveAxis::mount_spacing_m, "found no low beam on either side of the car", "a left and a right one");
    for (MountedLamp& lamp : lamps) {
        const double before_m = lamp.position_m.y;
        if (before_m == 0.0)
            continue; // in the middle
        lamp.position_m.y += before_m > 0.0 ? 0.5 * spacing_m - left_m : -0.5 * spacing_m - right_m;
        if (lamp.position_m.y * before_m <= 0.0)
            refuse_axis(drive, DriveAxis::mount_spacing_m, fmt::format("found {:g} m, by which '{}' changes sides", spacing_m, lamp.name),
                        "a wider spacing");
    }
}

void turn_all(double angle_rad, double MountedLamp::*angle, std::optional<double> LampChange::*changed, LampSet& lamp_set) {
    for (MountedLamp& lamp : lamp_set.lamps)
        lamp.*angle += angle_rad;
    for (LampChange& change : lamp_set.changes)
        if (change.*changed)
            *(change.*changed) += angle_rad;
}

/// Levelling that acts by the body's pitch alone becomes one that sees the load.
void set_load(double load_kg, LampSet& lamp_set) {
    auto control = std::make_shared<ControlParameters>(lamp_set.control ? *lamp_set.control : ControlParameters{});
    control->load.rear_n = load_kg * gravity_mps2;
    if (!control->levelling)
        control->levelling = std::exchange(lamp_set.levelling, std::nullopt);
    lamp_set.control = std::move(control);
}

void multiply_speed(double factor, Drive& drive) {
    if (drive.storyboard || drive.speed.empty())
        refuse_axis(drive, DriveAxis::speed_factor, "found a speed that a storyboard says", "a drive with speed of its own");
    for (SpeedPoint& point : drive.speed) {
        point.speed_mps *= factor;
        if (point.speed_mps > max_speed_mps)
            refuse_axis(drive, DriveAxis::speed_factor, fmt::format("found {:.4g} km/h", 3.6 * point.speed_mps), "at most 540 km/h");
    }
}

void set_named_axis(DriveAxis axis, double value, Drive& drive) {
    LampSet& lamp_set = drive.lamp_sets.front();
    switch (axis) {
    case DriveAxis::mount_height_m:
        for (MountedLamp& lamp : lamp_set.lamps)
            lamp.position_m.z = value;
        return;
    case DriveAxis::mount_spacing_m:
        return set_spacing(value, drive);
    case DriveAxis::yaw_deg:
        return turn_all(radians(value), &MountedLamp::yaw_rad, &LampChange::yaw_rad, lamp_set);
    case DriveAxis::pitch_deg:
        return turn_all(radians(value), &MountedLamp::pitch_rad, &LampChange::pitch_rad, lamp_set);
    case DriveAxis::roll_deg:
        return turn_all(radians(value), &MountedLamp::roll_rad, &LampChange::roll_rad, lamp_set);
    case DriveAxis::load_kg:
        return set_load(value, lamp_set);
    case DriveAxis::speed_factor:
        return multiply_speed(value, drive);
    }
}

} // namespace

std::vector<std::string> drive_axis_names() {
    std::vector<std::string> names;
    for (const NamedAxis& axis : named_axes)
        names.emplace_back(axis.name);
    return names;
}

std::optional<DriveAxis> drive_axis_named(const std::string& name) {
    const auto found = std::ranges::find(named_axes, name, &NamedAxis::name);
    return found == named_axes.end() ? std::nullopt : std::optional(static_cast<DriveAxis>(found - named_axes.begin()));
}

std::pair<double, double> limits_of(DriveAxis axis) { return {named_axis(axis).least, named_axis(axis).greatest}; }

std::vector<std::pair<std::string, std::string>> values_of_point(const std::vector<StudyAxis>& axes, const StudyPoint& point) {
    std::vector<std::pair<std::string, std::string>> values;
    for (std::size_t i = 0; i < point.size(); ++i)
        if (!point[i].empty() && !drive_axis_named(axes[i].key))
            values.emplace_back(axes[i].key, point[i]);
    return values;
}

void set_named_axes(const std::vector<StudyAxis>& axes, const StudyPoint& point, Drive& drive) {
    for (std::size_t i = 0; i < point.size(); ++i)
        if (const auto axis = drive_axis_named(axes[i].key); axis && !point[i].empty())
            set_named_axis(*axis, axis_number(point[i]), drive);
}

} // namespace fernlicht
