// What lamp control sends: signals of its table, encoded as messages, each at its cycle.
#pragma once

#include "scenarios/can/bus_mapping.h"
#include "scenarios/can/bus_sources.h"
#include "scenarios/can/can_frame.h"
#include "scenarios/control/signals.h"

#include <map>

namespace fernlicht {

class BusOutputs {
  public:
    /// Throws InputError with the mapping's place for a message or signal that none or more than one of `databases` has, units that do not
    /// fit, a message without a cycle, a signal of `table` that is not there.
    BusOutputs(const BusMapping& mapping, std::vector<CanDatabase> databases, const SignalTable& table);
    BusOutputs(BusOutputs&&) = default; // inner pointers go along with a move, not with a copy

    /// What the table says from now on. Values beyond a signal's limits or bits are cut to them; one that is no number leaves what was sent
    /// before (its start value at first). Both are counted.
    void set(const SignalTable& table);
    /// Frames due until `until_ns`, that time included, stamped when they are due (0, cycle, 2 cycles ...; of the drive, in ns), in order
    /// of time, then of the mapping. A multiplexed message is one frame for each value of its multiplexor that the mapping names signals
    /// of.
    std::vector<CanFrame> due(std::int64_t until_ns);
    /// When the next is due; the largest number there is without outputs.
    std::int64_t next_ns() const;

    /// What was cut or was no number, one sentence for each signal.
    std::vector<std::string> notes() const;

  private:
    struct Value {
        std::size_t place = 0; ///< in the table
        std::string signal, name;
        std::vector<std::pair<double, double>> values; ///< physical, table's
        UnitConversion conversion;
        double least = 0.0, greatest = 0.0; ///< physical
        double now = 0.0;                   ///< physical
        bool opposite = false, lost = false, beyond = false;
        std::uint64_t cut = 0, no_number = 0;
    };
    struct Page {                            ///< what one frame carries
        std::map<std::string, double> fixed; ///< multiplexors
        std::vector<Value> values;
    };
    struct Sent {
        const CanMessage* message = nullptr;
        std::int64_t cycle_ns = 0, next_ns = 0;
        std::vector<Page> pages;
    };
    CanFrame frame(const Sent& sent, Page& page) const;

    std::vector<CanDatabase> databases_;
    std::string channel_;
    std::vector<Sent> messages_;
};

} // namespace fernlicht
