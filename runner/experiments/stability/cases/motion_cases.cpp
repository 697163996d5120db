// What moves car and lamps: stiff and extreme cases of its equations (scenarios/vehicle/solver_study.h has the measuring), and steps of
// time from a millionth of a second to ten seconds.
#include "runner/experiments/stability/stability_case.h"
#include "runner/experiments/stability/trial.h"
#include "scenarios/control/control_stability.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/vehicle/disturbance_study.h"
#include "scenarios/vehicle/solver_study.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using namespace stability;

StabilityCase::Measure worst_of(std::vector<ExtremeTrial> (*study)()) {
    return [study](StabilityBench&, Found& worst) {
        for (const ExtremeTrial& trial : study())
            worst.add(trial.error, trial.what);
    };
}

/// Speed 0 to 60 m/s and back to 0 over 8 s: v = 15 t up to 4 s. Distance in closed form.
double truth_m(double t) { return t <= 4.0 ? 7.5 * t * t : 120.0 + 60.0 * (t - 4.0) - 7.5 * (t - 4.0) * (t - 4.0); }

void time_steps(StabilityBench& bench, Found& worst) {
    for (const double step_s : {1e-6, 1e-4, 1.0 / 30.0, 0.1, 1.0, 10.0}) {
        const std::filesystem::path path = write_drive_file(
            bench, "steps.yaml", "changes:\n  - {at_s: 4, lamp: right, level: 0.5}",
            fmt::format(
                "speed: [{{at_s: 0, speed_mps: 0}}, {{at_s: 4, speed_mps: 60}}, {{at_s: 8, speed_mps: 0}}]\nstep_s: {}\nduration_s: 8",
                step_s));
        const Drive drive = read_drive(path);
        const RoadNetwork network = read_opendrive(drive.road_file);
        const Route route(network, drive.start);
        const int ticks = tick_count(drive);
        worst.add(std::abs(ticks - std::max(1.0, std::round(std::ceil(8.0 / step_s - 1e-6)))) * 1e9,
                  fmt::format("{} ticks of {} s", ticks, step_s));
        State state = start(drive);
        const int stride = std::max(1, ticks / 997);
        for (int tick = 0; tick < ticks; tick += stride) {
            state.tick = tick - 1; // a state is a function of its tick
            state = advance(state, drive);
            const double t = tick * step_s;
            worst.add(std::abs(state.distance_m - truth_m(t)) / 240.0, fmt::format("step {} s, tick {}: distance", step_s, tick));
            const Moment moment = moment_at(state, drive, route, drive.lamp_sets.front());
            worst.add(std::abs(moment.ego.position_m.x - truth_m(t)) / 240.0, fmt::format("step {} s, tick {}: place", step_s, tick));
            if (std::abs(t - 4.0) > 1e-6 * step_s)
                worst.add(moment.lamps.front().intensity_factor == (t < 4.0 ? 1.0 : 0.5) ? 0.0 : 1.0,
                          fmt::format("step {} s, tick {}: lamp", step_s, tick));
        }
        // As a loop would come there, step by step: no drift over a million of them.
        State walked = start(drive);
        for (int i = 0; i < std::min(ticks - 1, 1'000'000); ++i)
            walked = advance(walked, drive);
        worst.add(std::abs(walked.distance_m - truth_m(walked.tick * step_s)) / 240.0,
                  fmt::format("step {} s, walked {} steps", step_s, walked.tick));
    }
}

} // namespace

std::vector<StabilityCase> motion_cases() {
    return {
        {"motion", "tiny-and-huge-steps", "roundings of a hundred thousand steps add up; a step of 50 periods swings", 1e-12, "of the step",
         "some roundings of 1, and of 1 / h in the implicit method", worst_of(steps_of_a_microsecond_and_of_ten_seconds)},
        {"motion", "largest-stable-step", "a solver is not the one of the books", 1e-9, "of the step by theory; unstable steps",
         "2000 steps, judged to 1e-9, tell growth from decay more finely still", worst_of(largest_stable_steps)},
        {"motion", "body-roll", "bars stiffer than any car's, or a body that all but tips over, are solved too coarsely", 1e-5,
         "rad of pitch or roll", "steps are taken to 1e-6 of 1 cm, 0.01 rad and 0.1 m/s each, some hundred of them",
         worst_of(roll_of_extreme_cars)},
        {"motion", "rough-roads", "waves quicker than the steps, and wheels that fly, are passed over", 1e-4, "rad of pitch or roll",
         "as for the roll; each landing is a kink that no step is told of", worst_of(extreme_rough_roads)},
        {"motion", "load-steps", "loads that come within a step, or on springs of rock, are felt late", 1e-5, "rad of pitch or roll",
         "as for the roll; loads end a step exactly", worst_of(extreme_loads)},
        {"motion", "lamp-control-actuators", "commands every tick to a stiff or slow actuator, late or rare, drive it beyond its limits",
         1e-5, "rad beyond stops and rate limit",
         "steps are taken to 1e-6 rad each, looked at between them by an interpolant of lower order",
         worst_of(control_of_extreme_actuators)},
    };
}

std::vector<StabilityCase> time_cases() {
    return {
        {"time", "steps", "steps of 1e-6 and 10 s: drift over a million steps, changes that fall between", 1e-12, "of the distance driven",
         "a state is a function of its tick; the integral of the speed is exact but for 20 roundings of a double", time_steps},
    };
}

} // namespace fernlicht
