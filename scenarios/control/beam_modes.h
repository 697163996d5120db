// Classes C, V, E and W of the passing beam, chosen by speed, light and wetness.
#pragma once

#include "scenarios/control/control_parameters.h"
#include "scenarios/control/signals.h"

namespace fernlicht {

/// Wet first, then fast, then town, else C:
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

} // namespace fernlicht
