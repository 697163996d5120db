#include "scenarios/control/lamp_controller.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

LampController::LampController(const ControlParameters& parameters, std::vector<ControlledLamp> lamps, const ControlledCar& car)
    : parameters_(parameters), lamps_(std::move(lamps)) {
    if (parameters_.bend) {
        bend_.emplace(*parameters_.bend, car);
        swivelling_ = places(parameters_.bend->lamps);
    }
    if (parameters_.cornering) {
        cornering_.emplace(*parameters_.cornering);
        left_corner_ = places(parameters_.cornering->left);
        right_corner_ = places(parameters_.cornering->right);
    }
    if (parameters_.modes) {
        modes_.emplace(*parameters_.modes);
        mode_lamps_ = places(parameters_.modes->lamps);
    }
    if (parameters_.high_beam) {
        high_beam_.emplace(*parameters_.high_beam, !parameters_.glare_free);
        high_lamps_ = places(parameters_.high_beam->lamps);
    }
    if (parameters_.glare_free)
        for (const SegmentedLamp& segmented : parameters_.glare_free->lamps) {
            const std::size_t lamp = places({segmented.name}).front();
            windows_.emplace_back(lamp, LampWindows(lamps_[lamp].windows, *parameters_.glare_free));
        }
}

std::vector<std::size_t> LampController::places(const std::vector<std::string>& names) const {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < lamps_.size(); ++i)
        if (std::ranges::find(names, lamps_[i].name) != names.end())
            places.push_back(i);
    return places;
}

void LampController::step(SignalTable& table, std::vector<std::vector<double>>& segments, const Surroundings& surroundings, double dt_s) {
    for (std::size_t lamp = 0; lamp < lamps_.size(); ++lamp)
        table.of(lamp, lamp_signal::level) = 1.0;
    if (bend_)
        bend(table, dt_s);
    if (parameters_.levelling)
        level(table, dt_s);
    if (cornering_) {
        const CorneringLight::Levels levels = cornering_->step(table, dt_s);
        for (const std::size_t lamp : left_corner_)
            table.of(lamp, lamp_signal::level) = levels.left;
        for (const std::size_t lamp : right_corner_)
            table.of(lamp, lamp_signal::level) = levels.right;
    }
    if (modes_) {
        const auto mode = static_cast<std::size_t>(modes_->step(table, dt_s));
        table[signal::control_mode] = static_cast<double>(mode);
        for (const std::size_t lamp : mode_lamps_)
            table.of(lamp, lamp_signal::level) = parameters_.modes->settings[mode].level;
    }
    if (high_beam_) {
        const double level = table[signal::control_high_beam] = high_beam_->step(table, dt_s);
        for (const std::size_t lamp : high_lamps_)
            table.of(lamp, lamp_signal::level) = level;
    }
    glare_free(table, segments, surroundings, dt_s);
}

void LampController::bend(SignalTable& table, double dt_s) {
    const double bend_rad = table[signal::control_bend] = bend_->step(table, dt_s);
    for (const std::size_t lamp : swivelling_)
        table.of(lamp, lamp_signal::swivel_command) = bend_of_lamp_rad(*parameters_.bend, bend_rad, lamps_[lamp].position_m.y);
}

void LampController::level(SignalTable& table, double dt_s) {
    const double pitch_rad = table[signal::ego_spring_pitch] + table[signal::ego_load_pitch];
    const bool lost = !std::isfinite(pitch_rad), slow = parameters_.levelling->control == LevellingControl::slow;
    const double seen_rad = slow && !lost ? mean_pitch_.step(pitch_rad, dt_s) : pitch_rad;
    for (std::size_t lamp = 0; lamp < lamps_.size(); ++lamp)
        table.of(lamp, lamp_signal::pitch_command) = lost ? parameters_.safe_pitch_rad : -seen_rad;
}

void LampController::glare_free(SignalTable& table, std::vector<std::vector<double>>& segments, const Surroundings& surroundings,
                                double dt_s) {
    const double body_rad = table[signal::ego_spring_pitch] + table[signal::ego_load_pitch];
    const double v = table[signal::ego_speed], yaw_rate = table[signal::ego_yaw_rate];
    const OwnMotion own{std::isfinite(v) ? v : 0.0, std::isfinite(yaw_rate) ? yaw_rate : 0.0};
    for (auto& [lamp, windows] : windows_) {
        const LampPlace place{lamps_[lamp].position_m, lamps_[lamp].yaw_rad + table.of(lamp, lamp_signal::swivel),
                              lamps_[lamp].pitch_rad + table.of(lamp, lamp_signal::pitch) + (std::isfinite(body_rad) ? body_rad : 0.0),
                              lamps_[lamp].roll_rad};
        segments[lamp] = windows.step(surroundings.others, *parameters_.high_beam, place, own, dt_s);
    }
}

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
