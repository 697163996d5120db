// All laws of a lamp set, moved on tick by tick: signals in, commands out, in one table.
#pragma once

#include "scenarios/control/control_parameters.h"
#include "scenarios/control/laws.h"
#include "scenarios/control/signals.h"
#include "scenarios/lamps/level_track.h"

#include <glm/vec3.hpp>

namespace fernlicht {

/// Classes of the passing beam. Wet first, then fast, then town, else C:
/// W: wetness at least `w_wetness` (until below 60 % of it), or wipers on for `w_wipers_s` without a break.
/// E: faster than `e_above_mps`, or than `e_motorway_above_mps` on a motorway.
/// V: at most `v_below_mps`, or at most `v_lit_below_mps` where the road has at least `v_lit_lx` (until below 60 % of it).
/// A speed that let a class in keeps it for `hysteresis_mps` more. A class comes when it was asked for during `delay_s`; the first at once.
/// A lost signal asks for C.
class BeamModes {
  public:
    explicit BeamModes(const ModeParameters& parameters) : parameters_(parameters) {}
    BeamMode step(const SignalTable& table, double dt_s);

  private:
    BeamMode asked(const SignalTable& table);

    ModeParameters parameters_;
    BeamMode mode_ = BeamMode::c, candidate_ = BeamMode::c;
    double candidate_s_ = 0.0, wiping_s_ = 0.0;
    bool wet_ = false, lit_ = false, started_ = false;
};

struct ControlledLamp {
    std::string name;
    glm::dvec3 position_m{0.0};              ///< in the car's frame
    double yaw_rad = 0.0;                    ///< its aim, left positive
    std::vector<AngleBox> windows = {};      ///< of its segments or pixels
    double pitch_rad = 0.0;                  ///< its aim, up positive
    double roll_rad = 0.0;                   ///< its aim, left side up
    std::shared_ptr<LevelTrack> pixels = {}; ///< what its pixels do, one window each; nullptr: it has none
};

class LampController {
  public:
    /// Names of lamps in `parameters` must be among `lamps`.
    LampController(const ControlParameters& parameters, std::vector<ControlledLamp> lamps, const ControlledCar& car);

    /// Reads what car, road, drive, traffic and actuators wrote into `table` and writes the laws' signals: the state `dt_s` after the last
    /// step. The first step starts all filters at its input. `segments`: levels of each lamp's windows.
    void step(SignalTable& table, std::vector<std::vector<double>>& segments, const Surroundings& surroundings, double dt_s);

  private:
    void bend(SignalTable& table, double dt_s);
    void level(SignalTable& table, double dt_s);
    void glare_free(SignalTable& table, std::vector<std::vector<double>>& segments, const Surroundings& surroundings, double dt_s);
    std::vector<std::size_t> places(const std::vector<std::string>& names) const;

    ControlParameters parameters_;
    std::vector<ControlledLamp> lamps_;
    std::optional<BendLight> bend_;
    std::optional<CorneringLight> cornering_;
    std::optional<BeamModes> modes_;
    std::optional<HighBeam> high_beam_;
    std::vector<std::pair<std::size_t, LampWindows>> windows_;                                   ///< lamp
    std::vector<std::size_t> swivelling_, left_corner_, right_corner_, mode_lamps_, high_lamps_; ///< into lamps_
    FirstOrder mean_pitch_{10.0}; ///< static levelling: slower than any swing of the body, quicker than loading
};

} // namespace fernlicht
