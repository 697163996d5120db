// Lamp control of a lamp set over a drive: before the first frame, or tick by tick in a live drive.
#pragma once

#include "scenarios/can/bus_outputs.h"
#include "scenarios/drives/play/bus_play.h"
#include "scenarios/drives/play/control_world.h"
#include "scenarios/drives/play/motion.h"

#include <map>

namespace fernlicht {

/// Files of lamps that are cut into windows, for each state of the windows that comes.
class BeamMasks {
  public:
    /// Drive and lamp set must outlive it; without a glare-free beam there is nothing to do.
    BeamMasks(const Drive& drive, const LampSet& lamp_set);

    /// Gives `run` the masks of its segments; the same state is the same file, from call to call. Throws InputError for more than can be
    /// kept.
    void add(ControlRun& run);
    std::vector<std::string> notes() const;

  private:
    const Drive& drive_;
    const LampSet& lamp_set_;
    double bytes_ = 0.0;
    std::size_t states_ = 0;
    std::map<std::pair<std::size_t, std::vector<double>>, std::shared_ptr<const LampFile>> known_;
};

class ControlPlay {
  public:
    /// `lamp_set` has control; all must outlive it. `databases`: of the drive's bus, empty without outputs to one. Throws InputError for
    /// what the control or the mapping names and the lamp set lacks.
    ControlPlay(const Drive& drive, const LampSet& lamp_set, const ControlWorld& world, const std::vector<CanDatabase>& databases = {});

    double next_s() const { return runner_.next_s(); } ///< time of the next tick
    /// The next tick; `values`: what the bus says at it, empty without one. Frames that were due until then are sent.
    void step(const std::vector<BusValue>& values = {});
    /// Sends what is due until then, which lies before the next tick.
    void send_until(std::int64_t time_ns);
    const std::vector<CanFrame>& sent() const { return motion_.sent; } ///< since the beginning
    /// When the next frame is due; the largest number there is without outputs.
    std::int64_t next_output_ns() const;
    const SignalTable& signals() const { return runner_.signals(); }

    /// At a time before the last tick: for moments of a drive that is still happening.
    Motion at(double time_s);
    /// Until the drive's end. Used up then.
    Motion finish();

  private:
    const Drive& drive_;
    const LampSet& lamp_set_;
    const ControlWorld& world_;
    ControlWorld::Resting resting_;
    std::optional<BusWriter> writer_;
    ControlRunner runner_;
    std::optional<BusOutputs> outputs_;
    BeamMasks masks_;
    Motion motion_;
};

/// Runs the control of each lamp set that has one and puts it into the lamp set's motion, with notes: after simulate_bus(), simulate() and
/// place_traffic(). Nothing for a drive without, or one that is live. Throws InputError for what the control names and the lamp set lacks.
void simulate_control(Drive& drive, const Route& route);

} // namespace fernlicht
