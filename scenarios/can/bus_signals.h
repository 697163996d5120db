// What a bus tells lamp control: frames in, and at each control tick the value, state and age of each mapped signal. The same for a
// recording and for a bus that is listened to, so that a replay is the live run.
#pragma once

#include "scenarios/can/bus_mapping.h"
#include "scenarios/can/bus_sources.h"
#include "scenarios/can/can_frame.h"

#include <limits>
#include <memory>
#include <unordered_map>

namespace fernlicht {

/// Those of the mapping, in its order; `opened` gets the files. Throws InputError.
std::vector<CanDatabase> read_bus_databases(const BusMapping& mapping, FilesRead& opened);

/// A signal at a control tick.
struct BusValue {
    BusState state = BusState::missing;
    double value = std::numeric_limits<double>::quiet_NaN();    ///< what lamp control is handed, in the table's unit; NaN: lost
    double received = std::numeric_limits<double>::quiet_NaN(); ///< what the last frame said, in the table's unit; NaN: none, or no number
    double other = std::numeric_limits<double>::quiet_NaN();    ///< what `also` said
    double age_s = std::numeric_limits<double>::infinity();     ///< since the last frame that held it
    /// When it last became another: of the drive; before it negative; NaN: never seen.
    double changed_s = std::numeric_limits<double>::quiet_NaN();
    bool policy_acted = false;
};

/// What became of an input over all ticks until now.
struct BusRecordOfInput {
    std::uint64_t frames = 0;                      ///< that held it
    std::uint64_t changes = 0;                     ///< of them with another value than the one before; the first is one
    std::array<std::uint64_t, bus_states> ticks{}; ///< by state
    std::array<std::uint64_t, bus_states> acted{}; ///< ticks at which the policy of a state was used
    std::uint64_t unchecked = 0;                   ///< ticks at which it was fresh and its `also` was not
    double oldest_s = 0.0;                         ///< largest age at a tick, where it was there
    double stale_after_s = std::numeric_limits<double>::infinity();
    std::vector<std::pair<double, BusState>> states; ///< from when (tick, s), which; each entry another than the one before
};

class BusSignals {
  public:
    /// `databases` as read_bus_databases reads them. Throws InputError with the mapping's place for a message or signal that none or more
    /// than one of them has, a label that the signal lacks, units that do not fit, `missing: fail` or `stale: fail` without a
    /// time after which it is so.
    BusSignals(const BusMapping& mapping, std::vector<CanDatabase> databases);
    BusSignals(BusSignals&&) = default; // inner pointers go along with a move, not with a copy

    /// In order of time: a frame that is stamped before the one taken last counts as of that one's time. `frame.time_ns`: of the drive,
    /// from its 0 s; may lie before it. Frames of other channels, remote and error frames are left out.
    void take(const CanFrame& frame);

    /// By all frames taken, in the mapping's order. Ticks ascend; frames with a later stamp must not have been taken yet. Throws
    /// InputError where a policy says `fail`: signal, state, since when.
    const std::vector<BusValue>& at(std::int64_t tick_ns);

    const std::vector<BusInput>& inputs() const { return inputs_; }
    const std::vector<BusRecordOfInput>& records() const { return records_; }
    std::uint64_t frames_used() const { return frames_used_; } ///< frames that held a mapped message
    /// Identifiers that inputs read, for filters: id and whether it is extended; ascending, each once.
    std::vector<std::pair<std::uint32_t, bool>> identifiers() const;

  private:
    struct Reading {
        const CanMessage* message = nullptr;
        const CanSignal* signal = nullptr;
        UnitConversion conversion;
        std::vector<std::pair<double, double>> values; ///< physical, table's
        std::uint64_t frames = 0, changes = 0, raw = 0;
        std::int64_t last_ns = 0, changed_ns = 0;
        double value = std::numeric_limits<double>::quiet_NaN();
        bool in_range = false;
    };
    struct Source {
        Reading first;
        std::optional<Reading> second;
        double least = 0.0, greatest = 0.0; ///< of the signal table
        std::int64_t stale_after_ns = 0, also_stale_after_ns = 0;
        std::optional<double> held;
    };
    BusState state_of(std::size_t input, std::int64_t tick_ns) const;
    void apply_policy(std::size_t input, std::int64_t tick_ns, BusValue& value);

    std::vector<CanDatabase> databases_; ///< messages point into it
    std::string channel_, recording_;    ///< the latter for sentences: " (recording bus.log)"
    std::vector<BusInput> inputs_;
    std::vector<Source> sources_;
    std::unordered_map<std::uint64_t, std::vector<std::pair<std::size_t, bool>>> readers_; ///< by identifier: input, its second source
    std::vector<BusValue> values_;
    std::vector<BusRecordOfInput> records_;
    std::uint64_t frames_used_ = 0;
    std::int64_t last_ns_ = std::numeric_limits<std::int64_t>::min();
};

} // namespace fernlicht
