// A live drive: inputs from a bus tick by tick, outputs to it, moments as soon as they are settled.
#pragma once

#include "scenarios/drives/play/control_play.h"
#include "scenarios/drives/play/moment.h"

namespace fernlicht {

/// Steps what simulate_bus() and simulate_control() do at once for a recording: the same frames with the same stamps make the same signals,
/// lamp commands, frames to be sent and moments.
class BusDrive {
  public:
    /// `drive`: staged with `live` set (staged_scene.h), its `can` not to be changed any more; drive and route must outlive it and stay
    /// where they are. `lamp_set`: which is driven. Throws InputError for what the mapping, its databases or the control lack.
    BusDrive(Drive& drive, const Route& route, std::size_t lamp_set = 0);
    BusDrive(const BusDrive&) = delete;
    BusDrive& operator=(const BusDrive&) = delete;

    double period_s() const { return play_.period_s; }
    std::uint64_t ticks() const { return play_.ticks.size(); }                     ///< that were stepped
    std::int64_t next_tick_ns() const { return tick_ns(ticks(), play_.period_s); } ///< of the drive
    /// After the last tick before its end: the time that the drive has, or the route's end.
    bool done() const { return done_; }

    /// As BusSignals::take: frames until the next tick, before it is stepped.
    void take(const CanFrame& frame);
    /// The next tick: reads the bus, moves the car, runs the laws. Returns what is to be sent and was not yet, stamped when it was due,
    /// until the tick included. Throws InputError where a policy says `fail`, a solver gives up or a plug-in fails.
    std::vector<CanFrame> step();
    /// What is due after the last tick until `time_ns`, which lies before the next one: to be sent on time rather than at the next tick.
    std::vector<CanFrame> send_until(std::int64_t time_ns);
    std::int64_t next_output_ns() const { return control_.next_output_ns(); }

    const std::vector<BusValue>& values() const { return play_.ticks.back(); } ///< at the last tick
    const SignalTable& signals() const { return control_.signals(); }
    std::vector<std::pair<std::uint32_t, bool>> identifiers() const { return bus_.identifiers(); } ///< for filters

    /// How many moments of the drive are settled: all before the last tick; after finish() all there are.
    int moments() const;
    /// One of them. A plain value: another thread may draw it.
    Moment moment(int tick);

    /// After the last step, also of a drive that was ended before its time: `drive` then holds what a recording would have made of it (bus,
    /// bus_motion, duration, the lamp set's motion), so that it can be measured and reported on as any other.
    void finish();

  private:
    std::vector<CanFrame> fresh_frames();

    Drive& drive_;
    const Route& route_;
    std::size_t lamp_set_;
    BusPlay play_;
    BusSignals bus_;
    BusMover mover_;
    std::shared_ptr<BusMotion> motion_;
    ControlWorld world_;
    ControlPlay control_;
    std::size_t sent_ = 0; ///< frames handed out
    int on_route_ = 1;     ///< moments that are known to be on the route
    bool done_ = false, finished_ = false;
};

} // namespace fernlicht
