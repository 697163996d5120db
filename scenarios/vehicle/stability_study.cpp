#include "scenarios/vehicle/stability_study.h"

#include "scenarios/vehicle/actuator.h"
#include "scenarios/vehicle/solver_study.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double damping = 0.7;

OdeProblem actuator_step(double w) {
    OdeProblem problem = step_problem(w, damping);
    problem.jacobian = nullptr; // by differences
    return problem;
}

/// Largest error of the answer to a step at some moments of [0, end].
double step_error(double w, const SolverOptions& options, double end_s) {
    const OdeProblem problem = actuator_step(w);
    OdeIntegrator integrator(problem, options);
    std::vector<double> x{0.0, 0.0};
    double worst = 0.0, from_s = 0.0;
    for (const double part : {0.001, 0.01, 0.1, 0.3, 1.0}) {
        integrator.integrate(from_s, part * end_s, x);
        from_s = part * end_s;
        worst = std::max(worst, std::abs(x[0] - step_response(w, damping, from_s)));
    }
    return worst;
}

/// Whether x' = lambda x shrinks over many steps of length 1, |lambda| = `size`.
bool shrinks(Solver solver, double size, double angle_rad) {
    const std::complex<double> lambda = -std::polar(size, angle_rad);
    OdeProblem problem;
    problem.derivative = [=](double, const double* x, double* dxdt) {
        dxdt[0] = lambda.real() * x[0] - lambda.imag() * x[1];
        dxdt[1] = lambda.imag() * x[0] + lambda.real() * x[1];
    };
    problem.jacobian = [=](double, const double*, double* rows, double* dfdt) {
        rows[0] = rows[3] = lambda.real();
        rows[1] = -lambda.imag();
        rows[2] = lambda.imag();
        dfdt[0] = dfdt[1] = 0.0;
    };
    problem.scale = {1.0, 1.0};
    OdeIntegrator integrator(problem, {.solver = solver, .fixed_step_s = 1.0});
    std::vector<double> x{1.0, 0.0};
    constexpr double steps = 2000.0;
    for (double t_s = 0.0; t_s < steps; t_s += 10.0) {
        integrator.integrate(t_s, t_s + 10.0, x);
        if (!(std::hypot(x[0], x[1]) < 1.0e6))
            return false;
    }
    return std::hypot(x[0], x[1]) <= 1.0 + 1.0e-9; // on the imaginary axis nothing shrinks at all
}

double found_limit(double angle_rad, double least, double greatest) {
    for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (least + greatest);
        (shrinks(Solver::dormand_prince, middle, angle_rad) ? least : greatest) = middle;
    }
    return least;
}

} // namespace

std::vector<ExtremeTrial> steps_of_a_microsecond_and_of_ten_seconds() {
    const double w = 2.0 * std::numbers::pi * 5.0;
    std::vector<ExtremeTrial> trials;
    for (const Solver solver : {Solver::dormand_prince, Solver::rosenbrock})
        trials.push_back(
            {fmt::format("{}, steps of 1e-6 s", name(solver)), step_error(w, {.solver = solver, .fixed_step_s = 1.0e-6}, 0.1)});
    {
        const OdeProblem problem = actuator_step(w);
        OdeIntegrator integrator(problem, {.solver = Solver::rosenbrock, .fixed_step_s = 10.0});
        std::vector<double> x{0.0, 0.0};
        integrator.integrate(0.0, 1000.0, x);
        trials.push_back({"rosenbrock, steps of 10 s, settled", std::abs(x[0] - 1.0)});
    }
    return trials;
}

double dormand_prince_limit(double angle_rad) {
    const auto grows = [&](double size) {
        const std::complex<double> z = -std::polar(size, angle_rad);
        return std::abs(1.0 + z * (1.0 + z * (1.0 / 2.0 + z * (1.0 / 6.0 + z * (1.0 / 24.0 + z * (1.0 / 120.0 + z / 600.0)))))) > 1.0;
    };
    double least = 0.5, greatest = 0.5;
    while (!grows(greatest))
        greatest += 0.01;
    least = greatest - 0.01;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (least + greatest);
        (grows(middle) ? greatest : least) = middle;
    }
    return least;
}

std::vector<ExtremeTrial> largest_stable_steps() {
    std::vector<ExtremeTrial> trials;
    for (const double degrees_off : {0.0, 30.0, 60.0}) {
        const double angle_rad = degrees_off * std::numbers::pi / 180.0, theory = dormand_prince_limit(angle_rad);
        const double found = found_limit(angle_rad, 0.7, 5.9);
        trials.push_back(
            {fmt::format("dormand-prince, {:g} degrees off the real axis: {:.4f}, by theory {:.4f}", degrees_off, found, theory),
             std::abs(found / theory - 1.0)});
    }
    for (const double degrees_off : {0.0, 30.0, 60.0, 90.0}) {
        double unstable = 0.0;
        for (double size = 1.0e-2; size <= 1.0e12; size *= 10.0)
            unstable += shrinks(Solver::rosenbrock, size, degrees_off * std::numbers::pi / 180.0) ? 0.0 : 1.0;
        trials.push_back(
            {fmt::format("rosenbrock, {:g} degrees off the real axis: unstable steps from 0.01 to 1e12", degrees_off), unstable});
    }
    return trials;
}

} // namespace fernlicht
