#include "scenarios/vehicle/solver_study.h"

#include "scenarios/values/errors.h"
#include "scenarios/vehicle/actuator.h"
#include "scenarios/vehicle/car_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int samples = 997; // a prime: no rhythm with the steps
constexpr Solver all_solvers[] = {Solver::dormand_prince, Solver::rosenbrock, Solver::automatic};
constexpr double tight = 1.0e-12;

/// The result at the moments looked at, and what it took.
struct Solution {
    std::vector<double> values;
    SolverWork work;
};

struct StudiedProblem {
    std::string name, unit, against;
    std::function<Solution(const SolverOptions&)> solve;
    std::vector<double> truth;
    double floor = 0.0;
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

StudiedProblem actuator(double natural_frequency_hz, double end_s) {
    const double w = 2.0 * std::numbers::pi * natural_frequency_hz, z = 0.7;
    const auto moment_s = [=](int k) { return end_s * (k + 1) / samples; };
    StudiedProblem problem{natural_frequency_hz < 1000.0 ? fmt::format("actuator of {:g} Hz", natural_frequency_hz)
                                                         : fmt::format("actuator of {:g} kHz", natural_frequency_hz / 1000.0),
                           "of the step",
                           "closed form",
                           nullptr,
                           {},
                           0.0};
    for (int k = 0; k < samples; ++k)
        problem.truth.push_back(step_response(w, z, moment_s(k)));
    problem.solve = [=](const SolverOptions& options) {
        const OdeProblem ode = step_problem(w, z);
        OdeIntegrator integrator(ode, options);
        DensePath path({0});
        std::vector<double> x{0.0, 0.0};
        integrator.integrate(0.0, end_s, x, {}, &path);
        Solution solution{{}, integrator.work()};
        for (int k = 0; k < samples; ++k)
            solution.values.push_back(path.at(moment_s(k), 0));
        return solution;
    };
    return problem;
}

StudiedProblem car(const std::string& name, const std::vector<SpeedSegment>& wishes, const std::vector<RoadStep>& steps, double end_s) {
    StudiedProblem problem{name, "rad", fmt::format("rosenbrock at a tolerance of {:g}", tight), nullptr, {}, 0.0};
    problem.solve = [=](const SolverOptions& options) {
        CarModel model;
        model.car.road_steps = steps;
        model.car.solver = options.solver;
        model.car.tolerance = options.tolerance;
        const CarRun run = run_car(model, wishes, end_s);
        Solution solution{{}, run.work()};
        for (int k = 0; k < samples; ++k)
            solution.values.push_back(run.at(end_s * (k + 1) / samples).pitch_rad);
        return solution;
    };
    // Two methods that share nothing but the equations: what they differ by is the least that either may be wrong by.
    problem.truth = problem.solve({.solver = Solver::rosenbrock, .tolerance = tight}).values;
    problem.floor = largest_difference(problem.truth, problem.solve({.solver = Solver::dormand_prince, .tolerance = tight}).values);
    return problem;
}

SolverRow measured(const StudiedProblem& problem, const SolverOptions& options, int repetitions) {
    SolverRow row;
    row.problem = problem.name;
    row.solver = options.solver;
    row.tolerance = options.fixed_step_s > 0.0 ? 0.0 : options.tolerance;
    row.step_s = options.fixed_step_s;
    row.unit = problem.unit;
    row.against = problem.against;
    row.floor = problem.floor;
    try {
        std::vector<double> seconds;
        for (int k = 0; k < repetitions; ++k) {
            const auto began = std::chrono::steady_clock::now();
            const Solution solution = problem.solve(options);
            seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
            row.error = largest_difference(solution.values, problem.truth);
            const SolverWork& work = solution.work;
            row.steps = work.dormand_prince.steps + work.rosenbrock.steps;
            row.rejected = work.dormand_prince.rejected + work.rosenbrock.rejected;
            row.derivatives = work.derivatives;
            row.jacobians = work.jacobians;
        }
        std::ranges::sort(seconds);
        row.seconds = seconds[seconds.size() / 2];
        row.min_seconds = seconds.front();
        row.max_seconds = seconds.back();
        row.repetitions = seconds.size();
    } catch (const InputError& gave_up) {
        row.not_measured = gave_up.what();
    }
    return row;
}

} // namespace

std::vector<SolverRow> study_solvers(const SolverStudy& study) {
    std::vector<StudiedProblem> problems{actuator(5.0, 1.0), actuator(50'000.0, 0.1)};
    problems.push_back(car("car over an edge of 2 cm", {{0.0, 20.0, 0.0}}, {{10.0, 0.02}}, 2.0));
    problems.push_back(car("car to rest", {{0.0, 10.0, 0.0}, {0.5, 10.0, -7.0}, {0.5 + 10.0 / 7.0, 0.0, 0.0}}, {}, 3.0));
    std::vector<SolverRow> rows;
    for (const Solver solver : {Solver::dormand_prince, Solver::rosenbrock})
        for (const double step_s : study.steps_s)
            rows.push_back(measured(problems.front(), {.solver = solver, .fixed_step_s = step_s}, study.repetitions));
    for (const StudiedProblem& problem : problems)
        for (const Solver solver : all_solvers)
            for (const double tolerance : study.tolerances)
                rows.push_back(measured(problem, {.solver = solver, .tolerance = tolerance}, study.repetitions));
    return rows;
}

OdeProblem step_problem(double w, double z) {
    OdeProblem problem;
    problem.derivative = [=](double, const double* x, double* dxdt) {
        dxdt[0] = x[1];
        dxdt[1] = w * w * (1.0 - x[0]) - 2.0 * z * w * x[1];
    };
    problem.jacobian = [=](double, const double*, double* rows, double* dfdt) {
        rows[0] = dfdt[0] = dfdt[1] = 0.0;
        rows[1] = 1.0;
        rows[2] = -w * w;
        rows[3] = -2.0 * z * w;
    };
    problem.scale = {1.0, std::max(w, 1.0)};
    return problem;
}

double step_response(double w, double z, double t_s) {
    if (t_s <= 0.0)
        return 0.0;
    if (z == 1.0)
        return 1.0 - std::exp(-w * t_s) * (1.0 + w * t_s);
    const std::complex<double> root = std::sqrt(std::complex<double>(z * z - 1.0));
    const std::complex<double> a = w * (-z + root), b = w * (-z - root);
    return 1.0 + ((b * std::exp(a * t_s) - a * std::exp(b * t_s)) / (a - b)).real();
}

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
