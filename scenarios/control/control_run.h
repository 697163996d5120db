// Lamp control over a whole drive, before its first frame: afterwards each lamp's aim and level are functions of time.
#pragma once

#include "scenarios/control/control_loop.h"

namespace fernlicht {

struct ControlRun {
    std::vector<std::string> lamps;
    std::vector<LampRun> runs; ///< by lamp
    std::array<BeamModeSettings, 4> modes;
    std::vector<bool> has_modes; ///< by lamp
    /// By lamp: from when which file; of lamps whose file is cut into windows. nullptr: as it is.
    std::vector<std::vector<std::pair<double, std::shared_ptr<const LampFile>>>> masks;
    double body_pitch_rad = 0.0, rear_lift_m = 0.0; ///< what the load does to the body
    double period_s = 0.0;
    std::uint64_t ticks = 0;
    /// The signal table at the moments of the drive: the row that held, with the actuators where they are at that very time.
    std::vector<std::string> signals;
    std::vector<std::vector<double>> rows;
    std::vector<double> changed_s, age_s; ///< of the signals at the end: when they last became another, how old they are
    std::vector<std::string> notes;
    std::optional<InputError> unusable; ///< what to tell of a plug-in none of whose commands could be used

    std::size_t lamp(const std::string& name) const; ///< lamps.size(): none of this name
    double swivel_rad(std::size_t lamp, double time_s) const;
    double pitch_rad(std::size_t lamp, double time_s) const;
    double level(std::size_t lamp, double time_s) const;
    const BeamModeSettings& mode(std::size_t lamp, double time_s) const; ///< nothing for a lamp without
    /// Of a lamp that has `own` then; nullptr: that. Pixels are those of the lamp's first file alone.
    std::shared_ptr<const LampFile> file(std::size_t lamp, double time_s, const std::shared_ptr<const LampFile>& own) const;
};

struct ControlSpan {
    double end_s = 0.0;
    double row_step_s = 0.0; ///< moments of the drive
};

/// A control loop that keeps what the moments of a drive need of it, tick by tick.
class ControlRunner {
  public:
    /// Throws as ControlLoop does; `written` and `also` as there. `row_step_s`: from moment to moment.
    ControlRunner(const ControlParameters& parameters, const std::vector<ControlledLamp>& lamps, const ControlledCar& car,
                  double row_step_s, const SolverOptions& options = {}, const std::vector<std::string>& written = {},
                  const std::vector<std::string>& also = {});

    double next_s() const; ///< the time of the next tick: ticks * period
    /// `inputs.time_s` is next_s(). Throws as ControlLoop does.
    void step(const ControlInputs& inputs);
    const SignalTable& signals() const { return loop_.signals(); }
    /// Lamps at a time before the last tick (lamp_at, control_loop.h), for moments of a drive that is still happening.
    ControlRun at(double time_s) const;
    /// All until `end_s`, which is not before the last tick. The runner is used up.
    ControlRun finish(double end_s);

  private:
    void keep_rows(double until_s);

    ControlLoop loop_;
    ControlRun run_;
    double row_step_s_ = 0.0;
};

/// Ticks at k * period from 0 to the end. Throws as ControlLoop does.
ControlRun run_control(const ControlParameters& parameters, const std::vector<ControlledLamp>& lamps, const ControlledCar& car,
                       const std::function<ControlInputs(double time_s)>& inputs, const ControlSpan& span,
                       const SolverOptions& options = {});

} // namespace fernlicht
