#include "scenarios/control/control_run.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

std::size_t ControlRun::lamp(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(lamps, name) - lamps.begin());
}

double ControlRun::swivel_rad(std::size_t lamp, double time_s) const {
    return runs[lamp].swivel ? runs[lamp].swivel->angle_rad(time_s) : 0.0;
}

double ControlRun::pitch_rad(std::size_t lamp, double time_s) const { return runs[lamp].pitch ? runs[lamp].pitch->angle_rad(time_s) : 0.0; }

namespace {

/// The entry of a list by time that holds at `time_s`; nullptr before the first.
template <class Changes> const typename Changes::value_type* held(const Changes& changes, double time_s) {
    const auto next = std::ranges::upper_bound(changes, time_s, {}, [](const auto& change) { return change.first; });
    return next == changes.begin() ? nullptr : &*(next - 1);
}

} // namespace

double ControlRun::level(std::size_t lamp, double time_s) const {
    const auto* const change = held(runs[lamp].levels, time_s);
    return change ? change->second : 1.0;
}

const BeamModeSettings& ControlRun::mode(std::size_t lamp, double time_s) const {
    static const BeamModeSettings own;
    const auto* const change = held(runs[lamp].modes, time_s);
    return change ? modes[static_cast<std::size_t>(change->second)] : has_modes[lamp] ? modes.front() : own;
}

std::shared_ptr<const LampFile> ControlRun::file(std::size_t lamp, double time_s) const {
    const auto* const change = masks.empty() ? nullptr : held(masks[lamp], time_s);
    return change && change->second ? change->second : mode(lamp, time_s).file;
}

ControlRun run_control(const ControlParameters& parameters, const std::vector<ControlledLamp>& lamps, const ControlledCar& car,
                       const std::function<ControlInputs(double time_s)>& inputs, const ControlSpan& span, const SolverOptions& options) {
    ControlLoop loop(parameters, lamps, car, options);
    ControlRun run;
    run.period_s = parameters.period_s;
    for (const ControlledLamp& lamp : lamps) {
        run.lamps.push_back(lamp.name);
        run.has_modes.push_back(parameters.modes && std::ranges::find(parameters.modes->lamps, lamp.name) != parameters.modes->lamps.end());
    }
    if (parameters.modes)
        run.modes = parameters.modes->settings;
    for (std::size_t place = 0; place < loop.signals().size(); ++place)
        run.signals.push_back(loop.signals().name(place));
    std::size_t row = 0;
    const auto moment_s = [&] { return static_cast<double>(row) * span.row_step_s; };
    for (std::uint64_t tick = 0;; ++tick) {
        const double time_s = static_cast<double>(tick) * parameters.period_s;
        // Moments before this tick have the row of the last one. A moment at the tick but for a rounding has this tick's.
        for (; tick > 0 && moment_s() < span.end_s && moment_s() < time_s - 1.0e-9; ++row)
            run.rows.push_back(loop.signals().values());
        if (time_s >= span.end_s)
            break;
        loop.step(inputs(time_s));
        run.ticks = tick + 1;
    }
    run.notes = loop.notes();
    const SignalTable table = loop.signals();
    run.runs = loop.finish(span.end_s);
    for (std::size_t i = 0; i < run.rows.size(); ++i) {
        const double time_s = static_cast<double>(i) * span.row_step_s;
        run.rows[i][signal::time] = time_s;
        for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp) {
            run.rows[i][table.place(lamp, lamp_signal::swivel)] = run.swivel_rad(lamp, time_s);
            run.rows[i][table.place(lamp, lamp_signal::pitch)] = run.pitch_rad(lamp, time_s);
        }
    }
    return run;
}

} // namespace fernlicht
