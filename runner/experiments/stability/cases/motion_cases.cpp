// What moves car and lamps: stiff and extreme cases of its equations. scenarios/vehicle/stability_study.h has the measuring.
#include "runner/experiments/stability/stability_case.h"
#include "scenarios/control/control_stability.h"
#include "scenarios/vehicle/stability_study.h"

namespace fernlicht {
namespace {

std::function<Found(StabilityBench&)> worst_of(std::vector<ExtremeTrial> (*study)()) {
    return [study](StabilityBench&) {
        Found found;
        for (const ExtremeTrial& trial : study())
            found.add(trial.error, trial.what);
        return found;
    };
}

} // namespace

std::vector<StabilityCase> motion_cases() {
    return {
        {"motion", "down-to-rest-and-back", "tyres divide by the speed, brakes turn over at rest: the speed or the pitch jumps", 0.1,
         "of 1 g in a millisecond; of 1 mrad of pitch", "a twentieth beyond friction is the springing back; solvers agree within 0.1 mrad",
         worst_of(from_60_mps_to_rest_and_back)},
        {"motion", "tiny-and-huge-steps", "roundings of a hundred thousand steps add up; a step of 50 periods swings", 1e-12, "of the step",
         "some roundings of 1, and of 1 / h in the implicit method", worst_of(steps_of_a_microsecond_and_of_ten_seconds)},
        {"motion", "largest-stable-step", "a solver is not the one of the books", 1e-9, "of the step by theory; unstable steps",
         "2000 steps, judged to 1e-9, tell growth from decay more finely still", worst_of(largest_stable_steps)},
        {"motion", "lamp-control-actuators", "commands every tick to a stiff or slow actuator, late or rare, drive it beyond its limits",
         1e-5, "rad beyond stops and rate limit",
         "steps are taken to 1e-6 rad each, looked at between them by an interpolant of lower order",
         worst_of(control_of_extreme_actuators)},
    };
}

} // namespace fernlicht
