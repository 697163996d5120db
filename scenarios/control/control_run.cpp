#include "scenarios/control/control_run.h"

#include <algorithm>

namespace fernlicht {

std::size_t ControlRun::lamp(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(lamps, name) - lamps.begin());
}

namespace {

/// The entry of a list by time that holds at `time_s`; nullptr before the first.
template <class Changes> const typename Changes::value_type* held(const Changes& changes, double time_s) {
    const auto next = std::ranges::upper_bound(changes, time_s, {}, [](const auto& change) { return change.first; });
    return next == changes.begin() ? nullptr : &*(next - 1);
}

double angle_rad(const std::optional<ActuatorRun>& actuator, const std::vector<std::pair<double, double>>& measured, double time_s) {
    const auto* const angle = held(measured, time_s);
    return angle ? angle->second : actuator ? actuator->angle_rad(time_s) : 0.0;
}

} // namespace

double ControlRun::swivel_rad(std::size_t lamp, double time_s) const {
    return angle_rad(runs[lamp].swivel, runs[lamp].measured_swivel, time_s);
}

double ControlRun::pitch_rad(std::size_t lamp, double time_s) const {
    return angle_rad(runs[lamp].pitch, runs[lamp].measured_pitch, time_s);
}

double ControlRun::level(std::size_t lamp, double time_s) const {
    const auto* const change = held(runs[lamp].levels, time_s);
    return change ? change->second : 1.0;
}

const BeamModeSettings& ControlRun::mode(std::size_t lamp, double time_s) const {
    static const BeamModeSettings own;
    const auto* const change = held(runs[lamp].modes, time_s);
    return change ? modes[static_cast<std::size_t>(change->second)] : has_modes[lamp] ? modes.front() : own;
}

std::shared_ptr<const LampFile> ControlRun::file(std::size_t lamp, double time_s, const std::shared_ptr<const LampFile>& own) const {
    const auto* const change = masks.empty() ? nullptr : held(masks[lamp], time_s);
    if (change && change->second)
        return change->second;
    if (const auto& of_mode = mode(lamp, time_s).file)
        return of_mode;
    return runs[lamp].pixels && runs[lamp].pixels->lamp() == own ? runs[lamp].pixels->at(time_s) : nullptr;
}

ControlRunner::ControlRunner(const ControlParameters& parameters, const std::vector<ControlledLamp>& lamps, const ControlledCar& car,
                             double row_step_s, const SolverOptions& options, const std::vector<std::string>& written,
                             const std::vector<std::string>& also)
    : loop_(parameters, lamps, car, options, written, also), row_step_s_(row_step_s) {
    run_.period_s = parameters.period_s;
    for (const ControlledLamp& lamp : lamps) {
        run_.lamps.push_back(lamp.name);
        run_.has_modes.push_back(parameters.modes &&
                                 std::ranges::find(parameters.modes->lamps, lamp.name) != parameters.modes->lamps.end());
    }
    if (parameters.modes)
        run_.modes = parameters.modes->settings;
    for (std::size_t place = 0; place < loop_.signals().size(); ++place)
        run_.signals.push_back(loop_.signals().name(place));
}

double ControlRunner::next_s() const { return static_cast<double>(run_.ticks) * run_.period_s; }

/// Moments before a tick have the row of the last one. A moment at the tick but for a rounding has this tick's.
void ControlRunner::keep_rows(double until_s) {
    while (run_.ticks > 0 && static_cast<double>(run_.rows.size()) * row_step_s_ < until_s)
        run_.rows.push_back(loop_.signals().values());
}

void ControlRunner::step(const ControlInputs& inputs) {
    keep_rows(inputs.time_s - 1.0e-9);
    loop_.step(inputs);
    ++run_.ticks;
}

ControlRun ControlRunner::at(double time_s) const {
    ControlRun now;
    now.lamps = run_.lamps;
    now.has_modes = run_.has_modes;
    now.modes = run_.modes;
    now.period_s = run_.period_s;
    for (std::size_t lamp = 0; lamp < run_.lamps.size(); ++lamp)
        now.runs.push_back(loop_.lamp_at(lamp, time_s));
    return now;
}

ControlRun ControlRunner::finish(double end_s) {
    keep_rows(end_s - 1.0e-9);
    run_.notes = loop_.notes();
    run_.unusable = loop_.unusable();
    const SignalTable table = loop_.signals();
    for (std::size_t place = 0; place < table.size(); ++place) {
        run_.changed_s.push_back(table.changed_s(place));
        run_.age_s.push_back(table.age_s(place));
    }
    run_.runs = loop_.finish(end_s);
    for (std::size_t i = 0; i < run_.rows.size(); ++i) {
        const double time_s = static_cast<double>(i) * row_step_s_;
        run_.rows[i][signal::time] = time_s;
        for (std::size_t lamp = 0; lamp < run_.lamps.size(); ++lamp) {
            run_.rows[i][table.place(lamp, lamp_signal::swivel)] = run_.swivel_rad(lamp, time_s);
            run_.rows[i][table.place(lamp, lamp_signal::pitch)] = run_.pitch_rad(lamp, time_s);
        }
    }
    return std::move(run_);
}

ControlRun run_control(const ControlParameters& parameters, const std::vector<ControlledLamp>& lamps, const ControlledCar& car,
                       const std::function<ControlInputs(double time_s)>& inputs, const ControlSpan& span, const SolverOptions& options) {
    ControlRunner runner(parameters, lamps, car, span.row_step_s, options);
    while (runner.next_s() < span.end_s)
        runner.step(inputs(runner.next_s()));
    return runner.finish(span.end_s);
}

} // namespace fernlicht
