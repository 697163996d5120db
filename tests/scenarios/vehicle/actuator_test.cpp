// Lamp actuators against the closed forms of a second-order system, and their limits.
#include "scenarios/vehicle/actuator.h"

#include <cmath>
#include <complex>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

/// Answer to a step of 1 at time 0 of x'' = w^2 (1 - x) - 2 z w x', from rest (any textbook of control; complex roots cover every z but 1).
double step_response(double w, double z, double t_s) {
    if (t_s <= 0.0)
        return 0.0;
    if (z == 1.0)
        return 1.0 - std::exp(-w * t_s) * (1.0 + w * t_s);
    const std::complex<double> root = std::sqrt(std::complex<double>(z * z - 1.0)), a = w * (-z + root), b = w * (-z - root);
    return 1.0 + ((b * std::exp(a * t_s) - a * std::exp(b * t_s)) / (a - b)).real();
}

constexpr ActuatorParameters unlimited{5.0, 0.7, 1.0e6, -1.0, 1.0, 0.01, 0.0};

/// Commands `to_rad` from tick 1 on.
ActuatorRun stepped(const ActuatorParameters& actuator, double to_rad, double end_s, const SolverOptions& options = {}) {
    return run_actuator(
        actuator, [=](double tick_s) { return tick_s > 0.0 ? to_rad : 0.0; }, {}, end_s, options);
}

TEST(Actuator, AnswersAStepAsTheClosedFormDoes) {
    for (const double z : {0.0, 0.3, 0.7, 1.0, 3.0})
        for (const Solver solver : {Solver::dormand_prince, Solver::rosenbrock, Solver::automatic}) {
            ActuatorParameters actuator = unlimited;
            actuator.damping = z;
            const ActuatorRun run = stepped(actuator, 0.05, 1.0, {.solver = solver, .tolerance = 1e-9});
            for (double t_s = 0.0; t_s <= 1.0; t_s += 0.003)
                // A tolerance of 1e-9 of (0.001 rad + |x|) a step, some hundred steps, an oscillator that keeps them; between steps order 3
                // or 4.
                ASSERT_NEAR(run.angle_rad(t_s), 0.05 * step_response(actuator.frequency_rad_s(), z, t_s - 0.01), 2e-8)
                    << z << ' ' << name(solver) << ' ' << t_s;
        }
}

TEST(Actuator, StiffnessOverEightDecades) {
    // 0.1 Hz to 10 MHz; a second is then from a tenth of a period to ten million.
    for (double hz = 0.1; hz < 2e7; hz *= 10.0) {
        ActuatorParameters actuator = unlimited;
        actuator.natural_frequency_hz = hz;
        actuator.rate_limit_rad_s = 1.0e9;
        const ActuatorRun run = stepped(actuator, 0.05, 1.0);
        double worst = 0.0;
        for (const double t_s : {0.0101, 0.02, 0.1, 0.5, 1.0})
            worst = std::max(worst, std::abs(run.angle_rad(t_s) - 0.05 * step_response(actuator.frequency_rad_s(), 0.7, t_s - 0.01)));
        EXPECT_LT(worst, 2e-6) << hz; // 1e-6 * (0.001 + 0.05) a step, and the cubic between steps
        EXPECT_LT(run.work.dormand_prince.steps + run.work.rosenbrock.steps, 600U) << hz;
        EXPECT_EQ(run.work.rosenbrock.steps > 0, hz > 50.0) << hz;
    }
}

TEST(Actuator, DeadTimeShiftsTheAnswer) {
    ActuatorParameters late = unlimited;
    late.dead_time_s = 0.0375;
    const ActuatorRun now = stepped(unlimited, 0.05, 1.0, {.tolerance = 1e-9}), then = stepped(late, 0.05, 1.0, {.tolerance = 1e-9});
    for (double t_s = 0.1; t_s < 1.0; t_s += 0.01)
        EXPECT_NEAR(then.angle_rad(t_s), now.angle_rad(t_s - 0.0375), 2e-8);
    EXPECT_EQ(then.angle_rad(0.0474), 0.0) << "not before the dead time is over";
    EXPECT_GT(then.angle_rad(0.0476), 0.0);
}

TEST(Actuator, TheRateLimitHoldsToTheLastBit) {
    ActuatorParameters slow = unlimited;
    slow.rate_limit_rad_s = 0.2;
    const ActuatorRun run = stepped(slow, 0.5, 4.0, {.tolerance = 1e-9});
    EXPECT_EQ(run.rate_limited, 1U);
    for (double t_s = 0.0; t_s < 4.0; t_s += 0.001)
        EXPECT_LT(run.path.at(t_s, 1), 0.2 + 1e-9) << t_s;
    // On the limit from where v = 0.2 until w^2 (c - x) = 2 z w v: x = c - 2 z v / w; there it is let go.
    const double w = slow.frequency_rad_s(), let_go_rad = 0.5 - 2.0 * 0.7 * 0.2 / w;
    double reached_s = 0.0;
    while (run.path.at(reached_s, 1) < 0.2 - 1e-9)
        reached_s += 1e-5;
    const double let_go_s = reached_s + (let_go_rad - run.angle_rad(reached_s)) / 0.2;
    EXPECT_NEAR(run.path.at(let_go_s - 1e-4, 1), 0.2, 1e-9);
    EXPECT_LT(run.path.at(let_go_s + 1e-3, 1), 0.2 - 1e-6);
    EXPECT_NEAR(run.angle_rad(4.0), 0.5, 1e-7);
}

TEST(Actuator, StopsHoldAndLetGo) {
    // Under-damped, it would swing beyond; the stop takes its speed, and a command inwards frees it at once.
    ActuatorParameters swinging = unlimited;
    swinging.damping = 0.1;
    swinging.greatest_rad = 0.05;
    const auto command = [](double tick_s) { return tick_s < 0.005 ? 0.0 : tick_s < 0.495 ? 0.2 : -0.02; };
    const ActuatorRun run = run_actuator(swinging, command, {}, 2.0, {.tolerance = 1e-9});
    EXPECT_GE(run.at_stop, 1U);
    for (double t_s = 0.0; t_s < 2.0; t_s += 0.001)
        EXPECT_LE(run.angle_rad(t_s), 0.05 + 1e-12) << t_s;
    EXPECT_NEAR(run.angle_rad(0.3), 0.05, 1e-15); // the rounding of a mean of equal values
    EXPECT_NEAR(run.angle_rad(0.4999), 0.05, 1e-15);
    const double w = swinging.frequency_rad_s();
    EXPECT_NEAR(run.angle_rad(0.55), 0.05 - 0.07 * step_response(w, 0.1, 0.05), 1e-7);
}

TEST(Actuator, ALampSwitchIsAnsweredAtItsTime) {
    const auto parked_before = [](double tick_s) { return tick_s >= 0.12345 ? 0.05 : 0.0; };
    const ActuatorRun run = run_actuator(unlimited, parked_before, {0.12345}, 0.5, {.tolerance = 1e-9});
    EXPECT_EQ(run.angle_rad(0.12345), 0.0);
    const double w = unlimited.frequency_rad_s();
    for (const double later_s : {1e-4, 1e-3, 0.02})
        EXPECT_NEAR(run.angle_rad(0.12345 + later_s), 0.05 * step_response(w, 0.7, later_s), 1e-9)
            << "not at the next control tick, 0.13 s";
}

TEST(Actuator, ACommandThatDoesNotChangeCostsNothing) {
    const ActuatorRun run = run_actuator(
        unlimited, [](double) { return 0.02; }, {}, 100.0);
    EXPECT_EQ(run.angle_rad(0.0), 0.02);
    EXPECT_EQ(run.angle_rad(100.0), 0.02);
    EXPECT_LT(run.work.derivatives, 100U);
}

} // namespace
} // namespace fernlicht
