// The ruler of the solvers: orders, stability and events against closed forms.
#include "scenarios/values/errors.h"
#include "scenarios/vehicle/actuator.h"
#include "scenarios/vehicle/integrator.h"
#include "scenarios/vehicle/solver_study.h"
#include "tests/trial.h"

#include <cmath>
#include <gmock/gmock.h>
#include <tuple>

namespace fernlicht {
namespace {

using testing::HasSubstr;

/// One that is not linear and depends on time, y' = -2 t y^2, y(0) = 1: y = 1 / (1 + t^2); beside it an oscillator, x'' = -4 x, x = cos 2t.
OdeProblem smooth() {
    OdeProblem problem;
    problem.derivative = [](double t, const double* x, double* dxdt) {
        dxdt[0] = -2.0 * t * x[0] * x[0];
        dxdt[1] = x[2];
        dxdt[2] = -4.0 * x[1];
    };
    problem.jacobian = [](double t, const double* x, double* rows, double* dfdt) {
        std::fill_n(rows, 9, 0.0);
        rows[0] = -4.0 * t * x[0];
        rows[5] = 1.0;
        rows[7] = -4.0;
        dfdt[0] = -2.0 * x[0] * x[0];
        dfdt[1] = dfdt[2] = 0.0;
    };
    problem.scale = {1.0, 1.0, 1.0};
    return problem;
}

double error_at_end(const OdeProblem& problem, Solver solver, double step_s, DensePath* path = nullptr) {
    OdeIntegrator integrator(problem, {.solver = solver, .fixed_step_s = step_s});
    std::vector<double> x{1.0, 1.0, 0.0};
    integrator.integrate(0.0, 2.0, x, {}, path);
    return std::max({std::abs(x[0] - 0.2), std::abs(x[1] - std::cos(4.0)), std::abs(x[2] + 2.0 * std::sin(4.0))});
}

double error_between(Solver solver, double step_s) {
    const OdeProblem problem = smooth();
    DensePath path({0, 1});
    error_at_end(problem, solver, step_s, &path);
    double worst = 0.0;
    for (double t = 0.0; t <= 2.0; t += 0.0007)
        worst = std::max({worst, std::abs(path.at(t, 0) - 1.0 / (1.0 + t * t)), std::abs(path.at(t, 1) - std::cos(2.0 * t))});
    return worst;
}

/// Order seen when the step is halved. Within 0.25 of the method's: the next term of the error is smaller by some h, and h is 0.025 here.
TEST(OdeIntegrator, HasTheMethodsOrdersAlsoWithAJacobianByDifferences) {
    const OdeProblem problem = smooth();
    const auto order = [&](Solver solver) { return std::log2(error_at_end(problem, solver, 0.05) / error_at_end(problem, solver, 0.025)); };
    EXPECT_NEAR(order(Solver::dormand_prince), 5.0, 0.25);
    EXPECT_NEAR(order(Solver::rosenbrock), 4.0, 0.25);
    EXPECT_NEAR(std::log2(error_between(Solver::dormand_prince, 0.1) / error_between(Solver::dormand_prince, 0.05)), 5.0, 0.3)
        << "local error of the continuous extension of order 4";
    EXPECT_NEAR(std::log2(error_between(Solver::rosenbrock, 0.1) / error_between(Solver::rosenbrock, 0.05)), 4.0, 0.3)
        << "local error of the continuous extension of order 3";
    OdeProblem other_problem = smooth();
    other_problem.jacobian = nullptr;
    EXPECT_NEAR(std::log2(error_at_end(other_problem, Solver::rosenbrock, 0.1) / error_at_end(other_problem, Solver::rosenbrock, 0.05)),
                4.0, 0.25);
}

TEST(OdeIntegrator, ErrorFollowsTheTolerance) {
    const OdeProblem problem = smooth();
    for (const Solver solver : {Solver::dormand_prince, Solver::rosenbrock})
        for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
            OdeIntegrator integrator(problem, {.solver = solver, .tolerance = tolerance});
            std::vector<double> x{1.0, 1.0, 0.0};
            integrator.integrate(0.0, 2.0, x);
            // Errors of some ten steps, of a scale of 1 + |x|, carried on by an oscillator that keeps them.
            EXPECT_LT(std::abs(x[1] - std::cos(4.0)), 20.0 * tolerance) << name(solver);
            EXPECT_GT(integrator.work().dormand_prince.steps + integrator.work().rosenbrock.steps, 5U);
        }
}

/// x' = lambda x with n steps of z / |lambda|: how far it is from 0 after that.
double after_steps(Solver solver, double z, int steps) {
    OdeProblem problem{.derivative = [](double, const double* x, double* dxdt) { dxdt[0] = -x[0]; }, .scale = {1.0}};
    OdeIntegrator integrator(problem, {.solver = solver, .fixed_step_s = z});
    std::vector<double> x{1.0};
    integrator.integrate(0.0, z * steps, x);
    return std::abs(x[0]);
}

TEST(OdeIntegrator, DormandPrinceIsStableUpTo3Point306AndRosenbrockIsLStable) {
    // The largest z with |R(-z)| = 1 of R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24 + z^5/120 + z^6/600.
    EXPECT_LT(after_steps(Solver::dormand_prince, 3.30, 1000), 1.0);
    EXPECT_GT(after_steps(Solver::dormand_prince, 3.31, 1000), 1.0);
    // R(infinity) = 0: one step of any length leaves nothing, up to the rounding of 1 / (gamma h).
    for (const double z : {10.0, 1e3, 1e6, 1e9, 1e12})
        EXPECT_LT(after_steps(Solver::rosenbrock, z, 1), 10.0 / z) << z;
}

/// Van der Pol's oscillator with mu = 1000 has stretches that are stiff and corners that are not.
TEST(OdeIntegrator, ChoosesByStiffness) {
    OdeProblem problem;
    problem.derivative = [](double, const double* x, double* dxdt) {
        dxdt[0] = x[1];
        dxdt[1] = 1000.0 * (1.0 - x[0] * x[0]) * x[1] - x[0];
    };
    problem.scale = {1.0, 1.0};
    std::vector<double> stiff{2.0, 0.0};
    OdeIntegrator automatic(problem, {});
    automatic.integrate(0.0, 100.0, stiff);
    EXPECT_EQ(automatic.active(), Solver::rosenbrock);
    EXPECT_GT(automatic.work().rosenbrock.simulated_s, 98.0);
    EXPECT_LT(automatic.work().dormand_prince.steps, 100U);

    OdeIntegrator explicit_only(problem, {.solver = Solver::dormand_prince});
    std::vector<double> x{2.0, 0.0};
    explicit_only.integrate(0.0, 100.0, x);
    EXPECT_GT(explicit_only.work().dormand_prince.steps, 100U * automatic.work().rosenbrock.steps);
    EXPECT_NEAR(x[0], stiff[0], 1e-4);

    OdeIntegrator smooth_one(problem = smooth(), {});
    std::vector<double> y{1.0, 1.0, 0.0};
    smooth_one.integrate(0.0, 20.0, y);
    EXPECT_EQ(smooth_one.work().switches, 0U);
    EXPECT_EQ(smooth_one.work().rosenbrock.steps, 0U);
}

TEST(OdeIntegrator, GoesBackToTheExplicitMethod) {
    // x' = -k(t) (x - cos t) with k from 1 to 1e5 and back.
    OdeProblem problem;
    problem.derivative = [](double t, const double* x, double* dxdt) {
        dxdt[0] = -(1.0 + 1.0e5 * (t > 2.0 && t < 4.0 ? 1.0 : 0.0)) * (x[0] - std::cos(t));
    };
    problem.scale = {1.0};
    OdeIntegrator integrator(problem, {});
    std::vector<double> x{1.0};
    std::vector<Solver> then;
    for (const double stop : {2.0, 4.0, 30.0}) {
        integrator.integrate(stop == 2.0 ? 0.0 : stop == 4.0 ? 2.0 : 4.0, stop, x);
        then.push_back(integrator.active());
    }
    EXPECT_EQ(then, (std::vector{Solver::dormand_prince, Solver::rosenbrock, Solver::dormand_prince}));
    EXPECT_EQ(integrator.work().switches, 2U);
}

TEST(OdeIntegrator, StopsAtEvents) {
    // A falling body: h = 10 - 4.905 t^2 reaches the ground at sqrt(10 / 4.905).
    OdeProblem problem;
    problem.derivative = [](double, const double* x, double* dxdt) {
        dxdt[0] = x[1];
        dxdt[1] = -9.81;
    };
    problem.scale = {1.0, 1.0};
    for (const Solver solver : {Solver::dormand_prince, Solver::rosenbrock}) {
        OdeIntegrator integrator(problem, {.solver = solver});
        std::vector<double> x{10.0, 0.0};
        const std::vector<Watch> watches{{[](double, const double* s) { return s[0] - 20.0; }},
                                         {[](double, const double* s) { return s[0]; }, false, true},
                                         {[](double, const double* s) { return s[0] - 9.0; }, true, false}};
        const Arrival ground = integrator.integrate(0.0, 5.0, x, watches);
        EXPECT_EQ(ground.event, 1U);
        EXPECT_NEAR(ground.time_s, std::sqrt(10.0 / 4.905), 1.0e-9) << "the event tolerance";
        EXPECT_NEAR(x[0], 0.0, 1e-7);
        EXPECT_NEAR(x[1], -std::sqrt(2.0 * 9.81 * 10.0), 1e-7);
        EXPECT_LE(x[0], 0.0) << "behind the event, so that it is not met again";
        EXPECT_EQ(integrator.integrate(ground.time_s, 5.0, x, watches).event, std::nullopt);
        EXPECT_EQ(integrator.work().events, 1U);
    }
}

TEST(OdeIntegrator, ThePathIsTheSolutionWhoeverAsks) {
    const OdeProblem problem = smooth();
    DensePath path({1});
    OdeIntegrator integrator(problem, {.tolerance = 1e-9});
    std::vector<double> x{1.0, 1.0, 0.0};
    integrator.integrate(0.0, 2.0, x, {}, &path);
    EXPECT_EQ(std::tuple(path.start_s(), path.end_s()), std::tuple(0.0, 2.0));
    EXPECT_EQ(path.at(2.0, 0), x[1]);
    EXPECT_EQ(path.at(3.0, 0), x[1]);
    EXPECT_EQ(path.at(-1.0, 0), 1.0);
    for (double t = 0.0; t < 2.0; t += 0.0101)
        EXPECT_NEAR(path.at(t, 0), std::cos(2.0 * t), 1e-7); // between steps the error is of order 4, not 5
}

TEST(OdeIntegrator, GivesUpWithASentence) {
    OdeProblem problem;
    problem.derivative = [](double, const double* x, double* dxdt) { dxdt[0] = x[0] * x[0]; }; // 1 / (1 - t): ends at t = 1
    problem.scale = {1.0};
    for (const Solver solver : {Solver::automatic, Solver::dormand_prince, Solver::rosenbrock}) {
        OdeIntegrator integrator(problem, {.solver = solver, .max_steps = 20'000});
        std::vector<double> x{1.0};
        EXPECT_THAT(tests::refusal_of([&] { integrator.integrate(0.0, 2.0, x); }), HasSubstr("step")) << "goes through a pole";
    }
    EXPECT_THROW(OdeIntegrator(problem, {.tolerance = 0.0}), std::invalid_argument);
    EXPECT_THROW(OdeIntegrator(problem, {.solver = Solver::automatic, .fixed_step_s = 0.1}), std::invalid_argument);
}

// Lamp actuators against the closed forms of a second-order system, and their limits.

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

TEST(Actuator, DeadTimeAndRateLimitHold) {
    ActuatorParameters late = unlimited;
    late.dead_time_s = 0.0375;
    const ActuatorRun now = stepped(unlimited, 0.05, 1.0, {.tolerance = 1e-9}), then = stepped(late, 0.05, 1.0, {.tolerance = 1e-9});
    for (double t_s = 0.1; t_s < 1.0; t_s += 0.01)
        EXPECT_NEAR(then.angle_rad(t_s), now.angle_rad(t_s - 0.0375), 2e-8);
    EXPECT_EQ(then.angle_rad(0.0474), 0.0) << "not before the dead time is over";
    EXPECT_GT(then.angle_rad(0.0476), 0.0);
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
    swinging.max_rad = 0.05;
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

TEST(Actuator, ALampSwitchIsAnsweredAtItsTimeAndNoChangeCostsNothing) {
    const auto parked_before = [](double tick_s) { return tick_s >= 0.12345 ? 0.05 : 0.0; };
    const ActuatorRun run = run_actuator(unlimited, parked_before, {0.12345}, 0.5, {.tolerance = 1e-9});
    EXPECT_EQ(run.angle_rad(0.12345), 0.0);
    const double w = unlimited.frequency_rad_s();
    for (const double later_s : {1e-4, 1e-3, 0.02})
        EXPECT_NEAR(run.angle_rad(0.12345 + later_s), 0.05 * step_response(w, 0.7, later_s), 1e-9)
            << "not at the next control tick, 0.13 s";
    const ActuatorRun other_run = run_actuator(
        unlimited, [](double) { return 0.02; }, {}, 100.0);
    EXPECT_EQ(other_run.angle_rad(0.0), 0.02);
    EXPECT_EQ(other_run.angle_rad(100.0), 0.02);
    EXPECT_LT(other_run.work.derivatives, 100U);
}

// The studies' figures, which reports show: errors fall as theory says. The extremes are held to their bounds as cases of `fernlicht
// stability`.

std::vector<SolverRow> rows_of(const std::vector<SolverRow>& all, const std::string& problem, Solver solver, bool by_steps) {
    std::vector<SolverRow> rows;
    for (const SolverRow& row : all)
        if (row.problem == problem && row.solver == solver && (row.step_s > 0.0) == by_steps)
            rows.push_back(row);
    return rows;
}

TEST(SolverStudy, ErrorsFallWithTheWorkAsTheorySays) {
    const std::vector<SolverRow> all = study_solvers(SolverStudy{.repetitions = 1, .tolerances = {1e-4, 1e-6, 1e-8}});
    for (const SolverRow& row : all) {
        EXPECT_EQ(row.not_measured, "") << row.problem;
        EXPECT_GT(row.seconds, 0.0);
        EXPECT_GT(row.steps, 0U);
        EXPECT_LT(row.floor, 1e-10) << row.problem << ": two methods that share nothing agree";
        const double allowed = row.tolerance > 0.0 ? 5.0 * row.tolerance : 1.0; // the worst: an explicit method at its limit of stability
        EXPECT_LT(row.error, allowed + 2.0 * row.floor) << row.problem << ' ' << name(row.solver) << ' ' << row.tolerance;
    }
    // Order from the second and the last of the steps; local errors between steps, of order 5 and 4, show beside the methods' own.
    for (const auto& [solver, order] : {std::pair(Solver::dormand_prince, 5.0), std::pair(Solver::rosenbrock, 4.0)}) {
        const auto rows = rows_of(all, "actuator of 5 Hz", solver, true);
        ASSERT_EQ(rows.size(), 5U);
        EXPECT_NEAR(std::log(rows[1].error / rows[4].error) / std::log(rows[1].step_s / rows[4].step_s), order, 0.4) << name(solver);
    }
    const auto forced = rows_of(all, "actuator of 50 kHz", Solver::dormand_prince, false);
    const auto chosen = rows_of(all, "actuator of 50 kHz", Solver::automatic, false);
    EXPECT_GT(forced[1].steps, 50U * chosen[1].steps) << "the choice saves the steps that stability would ask for";
    EXPECT_EQ(rows_of(all, "actuator of 5 Hz", Solver::automatic, false)[1].jacobians, 0U) << "and costs nothing where nothing is stiff";
}

TEST(StabilityStudy, TheoryIsThatOfTheBooks) {
    EXPECT_NEAR(dormand_prince_limit(0.0), 3.3066, 1e-4); // Hairer & Wanner II, IV.2: 3.3
}

} // namespace
} // namespace fernlicht
