#include "scenarios/control/signals.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace fernlicht {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

// Ranges are generous: what lies beyond them no road and no car does, so that it is a fault of a sensor, a script or a plug-in.
constexpr std::array<SignalKind, std::size_t{signal::count} + std::size_t{lamp_signal::count} + std::size_t{listed_signal::count}> kinds{{
    {"time_s", "s", 0.0, 1.0e6, "drive", "of the drive, from its start"},
    {"ego.distance_m", "m", -1.0e7, 1.0e7, "car", "of the rear axle along the route"},
    {"ego.speed_mps", "m/s", -60.0, 150.0, "car", "along the car; below 0: backwards"},
    {"ego.acceleration_mps2", "m/s2", -50.0, 50.0, "car", "along the car, over the last control period"},
    {"ego.yaw_rate_rad_s", "rad/s", -6.3, 6.3, "car", "to the left positive; without a vehicle: speed times the lane's curvature"},
    {"ego.steering_rad", "rad", -1.6, 1.6, "car", "of the front wheels, to the left positive; without a vehicle: as the lane's bend asks"},
    {"ego.spring_pitch_rad", "rad", -0.5, 0.5, "car",
     "of the body as sensors at the springs see it, nose up positive; without a vehicle: 0"},
    {"ego.load_pitch_rad", "rad", -0.2, 0.2, "drive", "the part of the pitch that the load makes, nose up positive"},
    {"ego.indicator", "1", -1.0, 1.0, "drive", "1 left, -1 right, 0 none"},
    {"ego.wipers", "1", 0.0, 1.0, "drive", "1: they wipe all the time"},
    {"road.curvature_per_m", "1/m", -1.0, 1.0, "road", "of the own lane at the rear axle, left bends positive"},
    {"road.curvature_ahead_25m_per_m", "1/m", -1.0, 1.0, "road", "the same, 25 m ahead"},
    {"road.curvature_ahead_50m_per_m", "1/m", -1.0, 1.0, "road", "50 m ahead"},
    {"road.curvature_ahead_100m_per_m", "1/m", -1.0, 1.0, "road", "100 m ahead"},
    {"road.bearing_ahead_rad", "rad", -3.2, 3.2, "road",
     "of the lane's centre where the car will be after the bend light's preview, seen from the car, left positive"},
    {"road.motorway", "1", 0.0, 1.0, "drive", "1: lanes of both directions lie apart"},
    {"environment.illuminance_lx", "lx", 0.0, 2.0e5, "drive", "horizontal, of sky and street lamps"},
    {"environment.wetness", "1", 0.0, 1.0, "drive", "of the road: 0 dry, 1 under water"},
    {"others.nearest_oncoming_m", "m", 0.0, none, "traffic", "to the nearest with lamps on that faces this car; inf: none"},
    {"others.nearest_preceding_m", "m", 0.0, none, "traffic", "to the nearest ahead with lamps on that drives the same way; inf: none"},
    {"others.count", "1", 0.0, 1.0e6, "traffic", "with lamps on, ahead and within reach of the camera"},
    {"control.bend_rad", "rad", -1.6, 1.6, "laws", "where the bend light's law looks, left positive"},
    {"control.mode", "1", 0.0, 3.0, "laws", "of the passing beam: 0 C, 1 V, 2 E, 3 W"},
    {"control.high_beam", "1", 0.0, 1.0, "laws", "1: on; between: fading"},
    {"lamp.*.swivel_command_rad", "rad", -1.6, 1.6, "laws", "asked of the lamp's actuator, left positive"},
    {"lamp.*.swivel_rad", "rad", -1.6, 1.6, "actuators", "what it has done"},
    {"lamp.*.pitch_command_rad", "rad", -0.3, 0.3, "laws", "asked of the levelling, up positive"},
    {"lamp.*.pitch_rad", "rad", -0.3, 0.3, "actuators", "what it has done"},
    {"lamp.*.level", "1", 0.0, 1.0, "laws", "times the level that the drive gives the lamp"},
    {"lamp.*.segments_lit", "1", 0.0, 4.0e6, "laws", "of a lamp in segments or pixels: the sum of their levels"},
    {"lamp.*.swivel_stuck", "1", 0.0, 1.0, "laws", "1: found to be stuck, by command and position; stays so"},
    {"lamp.*.switch", "1", 0.0, 1.0, "driver", "times the laws' level: what the driver's switch gives the lamp; lost: as it was"},
    {"others[#].left_rad", "rad", -3.2, 3.2, "traffic",
     "left edge of a road user, seen from the camera; left positive, against the car's axis"},
    {"others[#].right_rad", "rad", -3.2, 3.2, "traffic", "right edge; left positive"},
    {"others[#].bottom_rad", "rad", -1.6, 1.6, "traffic", "lower edge; up positive, against the road"},
    {"others[#].top_rad", "rad", -1.6, 1.6, "traffic", "upper edge; up positive"},
    {"others[#].distance_m", "m", 0.0, none, "traffic",
     "from the camera along the car's axis; inf or lost: the lamps see it where the camera does"},
    {"others[#].valid", "1", 0.0, 1.0, "traffic", "1: there is one; lost: all that a glare-free beam has is dark"},
    {"lamp.*.segments[#]", "1", 0.0, 1.0, "laws", "level of a lamp's window or pixel, in their order; lost: as it was"},
}};

} // namespace

std::span<const SignalKind> known_signals() { return kinds; }

std::pair<std::string, std::size_t> listed_name(const std::string& name) {
    const std::size_t open = name.find('['), close = name.find(']', std::min(open, name.size()));
    std::size_t number = 0;
    if (close == std::string::npos || name[open + 1] < '1' || name[open + 1] > '9')
        return {name, 0};
    const auto [end, error] = std::from_chars(name.data() + open + 1, name.data() + close, number);
    if (error != std::errc() || end != name.data() + close)
        return {name, 0};
    return {name.substr(0, open + 1) + '#' + name.substr(close), number};
}

const SignalKind* known_signal(const std::string& given) {
    const std::string name = listed_name(given).first;
    for (const SignalKind& kind : kinds) {
        const std::size_t star = kind.name.find('*');
        if (star == std::string_view::npos ? name == kind.name
                                           : name.size() > kind.name.size() - 1 && name.starts_with(kind.name.substr(0, star)) &&
                                                 name.ends_with(kind.name.substr(star + 1)))
            return &kind;
    }
    return nullptr;
}

std::string of_lamp(std::string_view pattern, std::string_view lamp) {
    const std::size_t star = pattern.find('*');
    return fmt::format("{}{}{}", pattern.substr(0, star), lamp, pattern.substr(star + 1));
}

SignalTable::SignalTable(std::vector<std::string> lamps, const std::vector<std::string>& also)
    : lamps_(std::move(lamps)), values_(std::size_t{signal::count} + lamps_.size() * lamp_signal::count, 0.0) {
    values_[signal::others_nearest_oncoming] = values_[signal::others_nearest_preceding] = none;
    for (std::size_t lamp = 0; lamp < lamps_.size(); ++lamp)
        of(lamp, lamp_signal::level) = of(lamp, lamp_signal::driver_switch) = 1.0;
    constexpr std::size_t first_kind = std::size_t{signal::count} + std::size_t{lamp_signal::count};
    std::set<std::size_t> boxes;
    std::set<std::pair<std::size_t, std::size_t>> segments;
    for (const std::string& wanted : also)
        if (const auto [pattern, number] = listed_name(wanted); number > 0 && pattern.starts_with("others["))
            boxes.insert(number);
        else
            for (std::size_t lamp = 0; number > 0 && lamp < lamps_.size(); ++lamp)
                if (pattern == of_lamp(kinds[first_kind + listed_signal::segment].name, lamps_[lamp]))
                    segments.emplace(lamp, number);
    const auto add = [&](std::size_t which, std::size_t number, double value) {
        std::string name(kinds[first_kind + which].name);
        listed_.emplace_back(first_kind + which, name.replace(name.find('#'), 1, std::to_string(number)));
        values_.push_back(value);
    };
    for (const std::size_t number : boxes) {
        boxes_.push_back({number, values_.size()});
        for (const double usual : {3.14, -3.14, -1.57, 1.57, none, 1.0})
            add((values_.size() - boxes_.back().place), number, usual);
    }
    for (const auto& [lamp, number] : segments) {
        segments_.push_back({number, values_.size(), lamp});
        add(listed_signal::segment, number, 1.0);
        listed_.back().second = of_lamp(listed_.back().second, lamps_[lamp]);
    }
    stamps_.resize(values_.size());
}

const SignalKind& SignalTable::kind(std::size_t place) const {
    if (is_listed(place))
        return kinds[listed_[place - this->place(lamps_.size(), 0)].first];
    return kinds[place < signal::count ? place : std::size_t{signal::count} + lamp_signal_at(place).second];
}

std::string SignalTable::name(std::size_t place) const {
    if (is_listed(place))
        return listed_[place - this->place(lamps_.size(), 0)].second;
    const std::string_view pattern = kind(place).name;
    if (place < signal::count)
        return std::string(pattern);
    return of_lamp(pattern, lamps_[lamp_signal_at(place).first]);
}

std::size_t SignalTable::find(const std::string& wanted) const {
    std::vector<std::string> names;
    for (std::size_t place = 0; place < size(); ++place) {
        names.push_back(name(place));
        if (names.back() == wanted)
            return place;
    }
    const std::string near = nearest_name(wanted, names);
    throw std::invalid_argument(near.empty() ? "a signal that 'fernlicht signals' lists" : fmt::format("'{}', the nearest signal", near));
}

} // namespace fernlicht
