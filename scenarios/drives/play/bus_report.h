// What a report says of the signals that a drive took from a bus.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

struct Drive;
struct LampSet;

/// An input over the drive, in degrees where the signal table has radians and km/h where it has m/s.
struct BusSignalReport {
    std::string name, source, also; ///< also: "" without
    std::string unit;               ///< as shown: "km/h"
    double tolerance = 0.0;
    std::uint64_t frames = 0, changes = 0;
    double oldest_s = 0.0;
    std::optional<double> stale_after_s, changed_s; ///< never; never seen
    std::array<std::uint64_t, 5> ticks{}, acted{};  ///< by state: fresh, stale, missing, out_of_range, contradictory
    std::array<std::string, 5> policies;            ///< "" of fresh, and of contradictory without `also`
    std::uint64_t unchecked = 0;
    std::vector<std::pair<double, std::size_t>> states; ///< from when, which
    std::vector<std::optional<double>> value,
        received; ///< at the moments: handed to lamp control, as the last frame said it; nullopt: none
};

struct SignalStamp {
    std::string name, unit;
    double changed_s = 0.0;
    std::optional<double> age_s; ///< nullopt: never came
};

struct BusReport {
    std::string log; ///< "" for a bus that was listened to
    double start_s = 0.0;
    std::uint64_t frames = 0, read = 0, sent = 0;
    double end_s = 0.0;
    std::vector<int> frame; ///< moments
    std::vector<double> time_s;
    std::vector<BusSignalReport> signals;
    std::vector<SignalStamp> all; ///< every signal of the table at the end
    bool empty() const { return signals.empty() && sent == 0; }
};

/// Of the moments first..last; empty without a bus.
BusReport bus_report(const Drive& drive, const LampSet& lamp_set, int first, int last);

/// A sentence for each input that never came, or that was not fresh at more than a twentieth of the control ticks, with what its policies
/// did. None without a bus.
std::vector<std::string> bus_warnings(const Drive& drive);

} // namespace fernlicht
