// What ties the signals of a bus to those of lamp control (control/signals.h): the drive's key `can` in plain values (docs/can.md).
#pragma once

#include "scenarios/values/errors.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fernlicht {

/// What is wrong with a signal at a time; of several the first holds: missing, stale, out of range, contradictory.
enum class BusState : std::uint8_t { fresh, stale, missing, out_of_range, contradictory };
inline constexpr std::size_t bus_states = 5;

/// What lamp control is handed when a signal is not fresh: its last value that was, the default, nothing (a lost signal); or the drive
/// ends.
enum class BusPolicy : std::uint8_t { hold, fallback, lost, fail };

std::string_view name_of(BusState state);   ///< "fresh", "stale", "missing", "out_of_range", "contradictory"
std::string_view name_of(BusPolicy policy); ///< "hold", "default", "lost", "fail"

/// A signal of a message, by the names of its database: "Cockpit.VehicleSpeed".
struct BusSource {
    std::string message, signal;

    std::string text() const { return message + '.' + signal; }
    bool operator==(const BusSource&) const = default;
};

/// A signal of lamp control that comes from the bus.
struct BusInput {
    std::string name; ///< in the signal table; "lamp.*.switch": of all lamps
    BusSource source;
    std::optional<BusSource> also; ///< a second one that must say the same
    double tolerance = 0.0;        ///< between both, in the table's unit
    /// value = factor * physical + offset; nullopt: by the units of both.
    std::optional<double> factor, offset;
    /// What the bus says (a label of the signal's value table, or a physical value in digits) and its value, in place of factor and units;
    /// what is not listed is out of range. Empty: none.
    std::vector<std::pair<std::string, double>> values;
    bool opposite = false;                        ///< the sign is turned round after all this
    std::optional<double> stale_after_s;          ///< since the last frame; nullopt: three cycles of the message, never if it has none
    std::array<BusPolicy, bus_states> policies{}; ///< by state; that of `fresh` is not used
    std::optional<double> fallback;               ///< `default`, in the table's unit; also what `hold` hands over before there was a value
    InputError::Where where;                      ///< in the drive file; not compared

    BusPolicy policy(BusState state) const { return policies[static_cast<std::size_t>(state)]; }
};

/// A signal of the table that is sent.
struct BusOutput {
    BusSource target;
    bool opposite = false;                              ///< the sign is turned round before all else
    std::string name;                                   ///< in the signal table
    std::optional<double> factor, offset;               ///< physical = factor * value + offset; nullopt: by the units of both
    std::vector<std::pair<std::string, double>> values; ///< as of an input; the one whose value is nearest is sent. Empty: none
    std::optional<double> cycle_s;                      ///< of the message; nullopt: as its database says
    InputError::Where where;
};

struct BusMapping {
    std::vector<std::filesystem::path> databases;
    std::vector<BusInput> inputs;
    std::vector<BusOutput> outputs;
    std::string channel;                      ///< frames of others are not looked at; "": of all
    std::optional<std::filesystem::path> log; ///< a recording (candump) that the drive is played by
    std::optional<std::int64_t> start_ns;     ///< stamp in the log that is the drive's 0 s; nullopt: of its first frame
    bool scripted = false;                    ///< played by the drive's own speed and signals, although nothing else is said
    InputError::Where where;
};

} // namespace fernlicht
