#include "scenarios/vehicle/solver_study.h"

#include "scenarios/values/errors.h"
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

} // namespace fernlicht
