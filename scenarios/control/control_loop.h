// Lamp control as it runs in a car: at each tick signals come in, laws decide, actuators follow. The same for a drive played ahead and for
// a live one.
// A swivel that does not do what it is asked: found by what lamp control knows of it, command and position.
#pragma once

#include "scenarios/control/control_camera.h"
#include "scenarios/control/plugin.h"
#include "scenarios/vehicle/actuator.h"

#include <cmath>
#include <deque>
#include <map>

namespace fernlicht {

/// Stuck is an actuator that for `after_s` without a break was more than `off_rad` from what it is asked for (cut to its stops) and moved
/// less than half a degree a second. A healthy one moves whenever it is elsewhere. Once found, it stays found: until the car is started
/// again.
class StuckSwivel {
  public:
    StuckSwivel(const StuckSwivelParameters& parameters, const ActuatorParameters& actuator)
        : parameters_(parameters), min_rad_(actuator.min_rad), max_rad_(actuator.max_rad) {}

    /// `asked_rad`: the command that has reached it, `actual_rad`: where it is, both now, `dt_s` after the last step.
    bool step(double asked_rad, double actual_rad, double dt_s);
    bool found() const { return found_; }
    /// Found, and so far aside that it may glare.
    bool aside() const { return found_ && std::abs(last_rad_) > parameters_.off_rad; }

  private:
    StuckSwivelParameters parameters_;
    double min_rad_, max_rad_, last_rad_ = 0.0, still_s_ = 0.0;
    bool found_ = false;
};

/// A signal that comes from elsewhere, in place of what car, road, laws or actuators would write.
struct WrittenSignal {
    std::size_t place = 0; ///< in the table
    double value = 0.0;    ///< NaN: lost
    double age_s = 0.0;    ///< of the value
};

/// What the loop is told at a tick.
struct ControlInputs {
    double time_s = 0.0;
    double distance_m = 0.0, speed_mps = 0.0, acceleration_mps2 = 0.0, yaw_rate_rad_s = 0.0, steering_rad = 0.0;
    double spring_pitch_rad = 0.0, load_pitch_rad = 0.0;
    double curvature_per_m = 0.0, curvature_25m_per_m = 0.0, curvature_50m_per_m = 0.0, curvature_100m_per_m = 0.0;
    double bearing_ahead_rad = 0.0;
    double illuminance_lx = 0.0, wetness = 0.0;
    Surroundings surroundings;
    std::vector<WrittenSignal> written; ///< from a bus
};

/// What a lamp did until now.
struct LampRun {
    std::optional<ActuatorRun> swivel, pitch;
    std::vector<std::pair<double, double>> measured_swivel, measured_pitch; ///< from when, rad: in place of an actuator of ours
    std::vector<std::pair<double, double>> levels;                          ///< from when, which
    std::vector<std::pair<double, BeamMode>> modes;                         ///< from when, which; of lamps that have them
    std::vector<std::pair<double, std::vector<double>>> segments;           ///< from when, levels of its windows
    std::shared_ptr<LevelTrack> pixels;                                     ///< in place of windows
};

class ControlLoop {
  public:
    /// `written`: names of the signals that inputs will write. A command among them has an actuator follow it, a measured angle is where
    /// the lamp is, of a road user's box all are those that are masked. `also`: names of others that the table has, too
    /// (SignalTable). Throws std::invalid_argument for a lamp or a signal that is not there, InputError for a plug-in that cannot be used.
    ControlLoop(const ControlParameters& parameters, const std::vector<ControlledLamp>& lamps, const ControlledCar& car,
                const SolverOptions& options = {}, const std::vector<std::string>& written = {}, const std::vector<std::string>& also = {});

    /// Moves everything on to `inputs.time_s`, which is not before the last one. Throws InputError when an actuator's solver gives up or a
    /// plug-in fails.
    void step(ControlInputs inputs);
    const SignalTable& signals() const { return table_; }
    /// A lamp at a time before the last tick, from 0 s on: one entry each, and its angles as measured ones in place of actuators.
    LampRun lamp_at(std::size_t lamp, double time_s) const;

    /// Lets the actuators come to `end_s` and hands over what the lamps did, in the order of the lamps. The loop is used up.
    std::vector<LampRun> finish(double end_s);
    /// What was odd: signals out of range, calls of plug-ins; one sentence each.
    std::vector<std::string> notes() const;
    /// Of a plug-in none of whose commands could be used: what to tell; nullopt: there is none.
    std::optional<InputError> unusable() const;

  private:
    struct Driven {
        std::size_t lamp = 0, command = 0, actual = 0; ///< into the lamps; lamp_signal
        ActuatorParameters parameters;
        std::optional<Actuator> actuator;               ///< from the first tick on
        std::deque<std::pair<double, double>> commands; ///< on their way: when they arrive, rad
        std::optional<StuckSwivel> diagnosis;           ///< of a swivel
        double asked_rad = 0.0;                         ///< what it follows
    };
    void read(const ControlInputs& inputs);
    void tell_boxes(const std::vector<OtherUser>& others);
    std::vector<OtherUser> told_boxes();
    void write_over(const ControlInputs& inputs, bool of_laws);
    void take_segments();
    void stamp(const ControlInputs& inputs);
    void fail(double time_s);
    void check();
    void advance(Driven& driven, double until_s);
    void diagnose(double time_s);
    void make_safe();
    void order(double time_s);
    void keep(double time_s);

    ControlParameters parameters_;
    SolverOptions options_;
    SignalTable table_;
    std::vector<std::vector<double>> segments_; ///< by lamp: levels of its windows
    LampController controller_;
    std::optional<ControlCamera> camera_;
    std::vector<ControlPlugin> plugins_;
    std::vector<Driven> driven_;
    std::vector<LampRun> runs_;
    std::vector<std::size_t> mode_lamps_, measured_; ///< lamps; places
    std::vector<double> levels_, switches_;          ///< by lamp: the last that were known
    std::vector<double> before_;                     ///< values of the last tick
    std::vector<std::size_t> scripted_, failing_;    ///< places of their signals, or the lamps that they are about
    std::vector<std::size_t> out_of_range_;          ///< how often, by signal
    std::vector<bool> written_;                      ///< by place, of signals of lists
    std::map<std::size_t, std::size_t> impossible_;  ///< at how many ticks, by the number of a box
    bool boxes_written_ = false;
    double last_s_ = 0.0;
    bool started_ = false;
};

} // namespace fernlicht
