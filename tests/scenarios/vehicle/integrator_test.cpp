// The ruler of the solvers: orders, stability and events against closed forms.
#include "scenarios/values/errors.h"
#include "scenarios/vehicle/integrator.h"

#include <cmath>
#include <gmock/gmock.h>

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
TEST(OdeIntegrator, HasTheMethodsOrders) {
    const OdeProblem problem = smooth();
    const auto order = [&](Solver solver) { return std::log2(error_at_end(problem, solver, 0.05) / error_at_end(problem, solver, 0.025)); };
    EXPECT_NEAR(order(Solver::dormand_prince), 5.0, 0.25);
    EXPECT_NEAR(order(Solver::rosenbrock), 4.0, 0.25);
    EXPECT_NEAR(std::log2(error_between(Solver::dormand_prince, 0.1) / error_between(Solver::dormand_prince, 0.05)), 5.0, 0.3)
        << "local error of the continuous extension of order 4";
    EXPECT_NEAR(std::log2(error_between(Solver::rosenbrock, 0.1) / error_between(Solver::rosenbrock, 0.05)), 4.0, 0.3)
        << "local error of the continuous extension of order 3";
}

TEST(OdeIntegrator, AJacobianByDifferencesKeepsTheOrder) {
    OdeProblem problem = smooth();
    problem.jacobian = nullptr;
    EXPECT_NEAR(std::log2(error_at_end(problem, Solver::rosenbrock, 0.1) / error_at_end(problem, Solver::rosenbrock, 0.05)), 4.0, 0.25);
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
    OdeProblem problem;
    problem.derivative = [](double, const double* x, double* dxdt) { dxdt[0] = -x[0]; };
    problem.scale = {1.0};
    OdeIntegrator integrator(problem, {.solver = solver, .fixed_step_s = z});
    std::vector<double> x{1.0};
    integrator.integrate(0.0, z * steps, x);
    return std::abs(x[0]);
}

TEST(OdeIntegrator, DormandPrinceIsStableUpTo3Point306) {
    // The largest z with |R(-z)| = 1 of R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24 + z^5/120 + z^6/600.
    EXPECT_LT(after_steps(Solver::dormand_prince, 3.30, 1000), 1.0);
    EXPECT_GT(after_steps(Solver::dormand_prince, 3.31, 1000), 1.0);
}

TEST(OdeIntegrator, RosenbrockIsLStable) {
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
    EXPECT_EQ(path.start_s(), 0.0);
    EXPECT_EQ(path.end_s(), 2.0);
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
        OdeIntegrator integrator(problem, {.solver = solver, .most_steps = 20'000});
        std::vector<double> x{1.0};
        try {
            integrator.integrate(0.0, 2.0, x);
            FAIL() << "went through a pole";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("step"));
        }
    }
    EXPECT_THROW(OdeIntegrator(problem, {.tolerance = 0.0}), std::invalid_argument);
    EXPECT_THROW(OdeIntegrator(problem, {.solver = Solver::automatic, .fixed_step_s = 0.1}), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
