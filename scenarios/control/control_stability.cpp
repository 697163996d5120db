#include "scenarios/control/control_stability.h"

#include "scenarios/values/pose.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

const std::vector<ControlledLamp> two_lamps{{"left", {3.4, 0.6, 0.65}, 0.0}, {"right", {3.4, -0.6, 0.65}, 0.0}};
constexpr ControlledCar car{2.7, 0.003};
constexpr double finest_s = 2.5e-4;

ControlRun run_of(const ControlParameters& control, double end_s, const std::function<ControlInputs(double)>& inputs) {
    return run_control(control, two_lamps, car, inputs, {end_s, end_s});
}

/// Largest breach of stops and rate limit, looked at every millisecond.
double breach_rad(const ControlRun& run, const ActuatorParameters& actuator, double end_s) {
    constexpr double step_s = 1.0e-3;
    double worst = 0.0;
    for (std::size_t lamp = 0; lamp < run.lamps.size(); ++lamp) {
        double before = run.swivel_rad(lamp, 0.0);
        for (int k = 1; k * step_s < end_s; ++k) {
            const double now = run.swivel_rad(lamp, k * step_s);
            if (!std::isfinite(now))
                return std::numeric_limits<double>::infinity();
            worst = std::max(
                {worst, now - actuator.max_rad, actuator.min_rad - now, std::abs(now - before) - actuator.rate_limit_rad_s * step_s});
            before = now;
        }
    }
    return worst;
}

/// A course of bends; `side` -1: mirrored.
ControlInputs weaving(double time_s, double side = 1.0) {
    ControlInputs in;
    in.time_s = time_s;
    in.speed_mps = 20.0;
    in.distance_m = in.speed_mps * time_s;
    in.yaw_rate_rad_s = side * 0.2 * std::sin(2.0 * pi * time_s / 4.0);
    in.curvature_per_m = in.yaw_rate_rad_s / in.speed_mps;
    in.steering_rad = (car.wheelbase_m + car.self_steering_s2_per_m * in.speed_mps * in.speed_mps) * in.curvature_per_m;
    in.bearing_ahead_rad = side * 0.15 * std::sin(2.0 * pi * (time_s + 0.75) / 4.0);
    return in;
}

constexpr BendLaw all_laws[] = {BendLaw::steering, BendLaw::yaw_rate, BendLaw::route};

} // namespace

ControlParameters plain_bend_light(BendLaw law, double period_s) {
    ControlParameters control;
    control.period_s = period_s;
    control.bend = BendParameters{};
    control.bend->law = law;
    control.bend->lamps = {"left", "right"};
    return control;
}

std::vector<ExtremeTrial> control_of_extreme_actuators() {
    std::vector<ExtremeTrial> trials;
    for (const double frequency_hz : {0.1, 3.0, 1.0e3, 1.0e6})
        for (const double dead_time_s : {0.0, 0.03, 5.0})
            for (const double period_s : {1.0e-3, 0.02, 1.0}) {
                ControlParameters control = plain_bend_light(BendLaw::yaw_rate, period_s);
                control.bend->actuator.natural_frequency_hz = frequency_hz;
                control.bend->actuator.dead_time_s = dead_time_s;
                constexpr double end_s = 4.0;
                const ControlRun run = run_of(control, end_s, [](double t) { return weaving(t); });
                trials.push_back({fmt::format("{:g} Hz, dead time {:g} s, period {:g} s", frequency_hz, dead_time_s, period_s),
                                  breach_rad(run, control.bend->actuator, end_s)});
            }
    return trials;
}

std::vector<ExtremeTrial> control_with_extreme_signals() {
    struct Case {
        const char* what;
        std::function<void(ControlInputs&)> change;
    };
    const auto alternating = [](const ControlInputs& in) { return std::lround(in.time_s / 0.02) % 2 == 0 ? 1.0 : -1.0; };
    const std::vector<Case> cases{
        {"yaw rate NaN", [](ControlInputs& in) { in.yaw_rate_rad_s = std::numeric_limits<double>::quiet_NaN(); }},
        {"yaw rate NaN every other tick",
         [&](ControlInputs& in) {
             if (alternating(in) < 0.0)
                 in.yaw_rate_rad_s = std::numeric_limits<double>::quiet_NaN();
         }},
        {"speed infinite", [](ControlInputs& in) { in.speed_mps = std::numeric_limits<double>::infinity(); }},
        {"steering 1e300", [](ControlInputs& in) { in.steering_rad = 1.0e300; }},
        {"yaw rate denormal", [](ControlInputs& in) { in.yaw_rate_rad_s = 5.0e-324; }},
        {"full lock to full lock every tick",
         [&](ControlInputs& in) {
             in.steering_rad = alternating(in) * 0.6;
             in.yaw_rate_rad_s = alternating(in) * 6.0;
             in.bearing_ahead_rad = alternating(in) * 3.1;
         }},
        {"standing", [](ControlInputs& in) { in.speed_mps = 0.0; }},
        {"reversing", [](ControlInputs& in) { in.speed_mps = -10.0; }},
        {"a hairpin at 80 m/s",
         [](ControlInputs& in) {
             in.speed_mps = 80.0;
             in.yaw_rate_rad_s = in.time_s > 1.0 && in.time_s < 2.0 ? 6.2 : 0.0;
             in.steering_rad = in.time_s > 1.0 && in.time_s < 2.0 ? 0.6 : 0.0;
             in.bearing_ahead_rad = in.time_s > 1.0 && in.time_s < 2.0 ? 3.1 : -3.1;
         }},
    };
    std::vector<ExtremeTrial> trials;
    for (const Case& one : cases)
        for (const BendLaw law : all_laws) {
            const ControlParameters control = plain_bend_light(law, 0.02);
            constexpr double end_s = 3.0;
            const ControlRun run = run_of(control, end_s, [&](double t) {
                ControlInputs in = weaving(t);
                one.change(in);
                return in;
            });
            trials.push_back({fmt::format("{}, law {}", one.what, static_cast<int>(law)), breach_rad(run, control.bend->actuator, end_s)});
        }
    return trials;
}

std::vector<ExtremeTrial> control_mirrored() {
    std::vector<ExtremeTrial> trials;
    for (const BendLaw law : all_laws) {
        ControlParameters control = plain_bend_light(law, 0.02);
        control.bend->outer_share = 0.6;
        const ControlRun left = run_of(control, 4.0, [](double t) { return weaving(t); });
        const ControlRun right = run_of(control, 4.0, [](double t) { return weaving(t, -1.0); });
        double worst = 0.0;
        for (int k = 0; k < 997; ++k)
            for (const std::size_t lamp : {std::size_t{0}, std::size_t{1}})
                worst = std::max(worst, std::abs(left.swivel_rad(lamp, 4.0 * k / 997.0) + right.swivel_rad(1 - lamp, 4.0 * k / 997.0)));
        trials.push_back({fmt::format("law {}", static_cast<int>(law)), worst});
    }
    return trials;
}

ControlRun weave(BendLaw law, double period_s, double end_s) {
    return run_of(plain_bend_light(law, period_s), end_s, [](double t) { return weaving(t); });
}

double control_period_error_rad(BendLaw law, double period_s) {
    constexpr double end_s = 4.0;
    const ControlRun fine = weave(law, finest_s, end_s), coarse = weave(law, period_s, end_s);
    double worst = 0.0;
    for (int k = 0; k < 997; ++k)
        worst = std::max(worst, std::abs(fine.swivel_rad(0, end_s * k / 997.0) - coarse.swivel_rad(0, end_s * k / 997.0)));
    return worst;
}

} // namespace fernlicht
