// The table that inputs, laws, plug-ins and outputs of lamp control share: values by name and unit, one row per control tick.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fernlicht {

struct SignalKind {
    std::string_view name; ///< "ego.speed_mps"; "lamp.*.swivel_rad" stands for one signal of each lamp, its name in place of the star
    std::string_view unit;
    double least = 0.0, greatest = 0.0; ///< beyond them a value is taken for wrong
    std::string_view writer;            ///< "car", "road", "drive", "driver", "traffic", "laws", "actuators"
    std::string_view meaning;
};

/// Places of the signals that are there once.
namespace signal {
enum : std::size_t {
    time,
    ego_distance,
    ego_speed,
    ego_acceleration,
    ego_yaw_rate,
    ego_steering,
    ego_spring_pitch,
    ego_load_pitch,
    ego_indicator,
    ego_wipers,
    road_curvature,
    road_curvature_25m,
    road_curvature_50m,
    road_curvature_100m,
    road_bearing_ahead,
    road_motorway,
    environment_illuminance,
    environment_wetness,
    others_nearest_oncoming,
    others_nearest_preceding,
    others_count,
    control_bend,
    control_mode,
    control_high_beam,
    count
};
}

/// Places of a lamp's signals.
namespace lamp_signal {
enum : std::size_t { swivel_command, swivel, pitch_command, pitch, level, segments_lit, swivel_stuck, driver_switch, count };
}

/// Of what a list has by number, from 1: where another road user is seen, and of a lamp's windows. "others[#].left_rad" stands for
/// others[1].left_rad and so on.
namespace listed_signal {
enum : std::size_t { left, right, bottom, top, distance, valid, box_count, segment = box_count, count };
}

/// Those that are there once, by their places; then those of each lamp, by theirs; then those of lists.
std::span<const SignalKind> known_signals();
/// Of the signal of this name, with a lamp's name in place of the star or the star itself, and a number for #; nullptr: none has it.
const SignalKind* known_signal(const std::string& name);
/// "others[#].left_rad" and 3 of "others[3].left_rad"; the name itself and 0 of one without a number.
std::pair<std::string, std::size_t> listed_name(const std::string& name);

/// "lamp.left.level" of "lamp.*.level".
std::string of_lamp(std::string_view pattern, std::string_view lamp);

/// A value that is not a number says that the signal is lost; infinity is a distance to nothing.
class SignalTable {
  public:
    /// `also`: names of signals of lists that it has, too; of a road user all of one. What is not written of it says nothing against it:
    /// it takes up everything, infinitely far.
    explicit SignalTable(std::vector<std::string> lamps = {}, const std::vector<std::string>& also = {});

    const std::vector<std::string>& lamps() const { return lamps_; }
    double& operator[](std::size_t place) { return values_[place]; }
    double operator[](std::size_t place) const { return values_[place]; }
    std::size_t place(std::size_t lamp, std::size_t of_lamp) const {
        return std::size_t{signal::count} + lamp * lamp_signal::count + of_lamp;
    }
    /// Lamp and its signal that a place beyond those that are there once is of.
    static std::pair<std::size_t, std::size_t> lamp_signal_at(std::size_t place) {
        return {(place - signal::count) / lamp_signal::count, (place - signal::count) % lamp_signal::count};
    }
    struct Listed {
        std::size_t number = 0, place = 0; ///< of the first of its signals
        std::size_t lamp = 0;              ///< of a window
    };
    const std::vector<Listed>& boxes() const { return boxes_; }       ///< by number
    const std::vector<Listed>& segments() const { return segments_; } ///< by lamp and number
    bool is_listed(std::size_t place) const { return place >= this->place(lamps_.size(), 0); }
    double& of(std::size_t lamp, std::size_t of_lamp) { return values_[place(lamp, of_lamp)]; }
    double of(std::size_t lamp, std::size_t of_lamp) const { return values_[place(lamp, of_lamp)]; }

    /// When the signal last became another, in the table's time; 0: never since the start.
    double changed_s(std::size_t place) const { return stamps_[place].changed_s; }
    /// How old its value is: of signals from a bus since the frame that brought it, infinite where none did; of all others 0.
    double age_s(std::size_t place) const { return stamps_[place].age_s; }
    void stamp(std::size_t place, double changed_s, double age_s) { stamps_[place] = {changed_s, age_s}; }

    std::size_t size() const { return values_.size(); }
    const std::vector<double>& values() const { return values_; }
    std::string name(std::size_t place) const;
    const SignalKind& kind(std::size_t place) const;
    /// Throws std::invalid_argument, whose text names the nearest, for a name that no signal of these lamps has.
    std::size_t find(const std::string& name) const;

  private:
    std::vector<std::string> lamps_;
    std::vector<Listed> boxes_, segments_;
    std::vector<std::pair<std::size_t, std::string>> listed_; ///< listed_signal, name; by place
    struct Stamp {
        double changed_s = 0.0, age_s = 0.0;
    };
    std::vector<double> values_;
    std::vector<Stamp> stamps_;
};

} // namespace fernlicht
