#include "scenarios/control/beam_modes.h"

#include <cmath>

namespace fernlicht {

BeamMode BeamModes::asked(const SignalTable& table) {
    constexpr double still = 0.6; // of a threshold: what was lit or wet stays so down to there
    const double v = table[signal::ego_speed], lx = table[signal::environment_illuminance], wet = table[signal::environment_wetness];
    const double motorway = table[signal::road_motorway], wipers = table[signal::ego_wipers];
    if (!std::isfinite(v + lx + wet + motorway + wipers))
        return BeamMode::c;
    const auto beyond = [&](BeamMode mode) { return mode_ == mode ? parameters_.hysteresis_mps : 0.0; };
    wet_ = wet >= parameters_.w_wetness * (wet_ ? still : 1.0);
    lit_ = lx >= parameters_.v_lit_lx * (lit_ ? still : 1.0);
    if (wet_ || wiping_s_ >= parameters_.w_wipers_s)
        return BeamMode::w;
    if (v > (motorway > 0.5 ? parameters_.e_motorway_above_mps : parameters_.e_above_mps) - beyond(BeamMode::e))
        return BeamMode::e;
    return v <= (lit_ ? parameters_.v_lit_below_mps : parameters_.v_below_mps) + beyond(BeamMode::v) ? BeamMode::v : BeamMode::c;
}

BeamMode BeamModes::step(const SignalTable& table, double dt_s) {
    wiping_s_ = table[signal::ego_wipers] > 0.5 ? wiping_s_ + dt_s : 0.0;
    const BeamMode wanted = asked(table);
    candidate_s_ = wanted == candidate_ ? candidate_s_ + dt_s : 0.0;
    candidate_ = wanted;
    if (!started_ || candidate_s_ >= parameters_.delay_s - 1.0e-9) // ticks added up
        mode_ = candidate_;
    started_ = true;
    return mode_;
}

} // namespace fernlicht
