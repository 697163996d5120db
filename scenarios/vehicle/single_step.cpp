#define BOOST_UBLAS_NDEBUG 1 // ublas' own checks would make a debug build another program
#include "scenarios/vehicle/single_step.h"

#include <algorithm>
#include <boost/numeric/odeint/stepper/rosenbrock4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/util/ublas_wrapper.hpp>
#include <cmath>
#include <limits>

namespace fernlicht {
namespace {

namespace odeint = boost::numeric::odeint;
using Vector = boost::numeric::ublas::vector<double>;
using Matrix = boost::numeric::ublas::matrix<double>; // by rows

/// Boost 1.74 has the last weight of df/dt with the wrong sign, which leaves order 1 where the equations depend on time. It follows from
/// the others: gamma (1 + c41 d1 + c42 d2 + c43 d3), as df/dt enters like one more variable whose derivative is 1.
struct RodasCoefficients : odeint::default_rosenbrock_coefficients<double> {
    const double d4 = -0.3620000000000023e-01;
};

double norm(const std::vector<double>& x, const std::vector<double>& scale) {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        sum += (x[i] / scale[i]) * (x[i] / scale[i]);
    return std::sqrt(sum);
}

} // namespace

struct SingleStep::Parts {
    const OdeProblem& problem;
    SolverWork& work;
    TriedStep tried;
    bool last_was_rosenbrock = false;

    odeint::runge_kutta_dopri5<std::vector<double>> explicit_method;
    std::vector<double> first_slope, last_slope, stage, stage_slope; ///< `stage`: the argument of the evaluation before the last
    bool slope_known = false;                                        ///< first_slope holds f at the step's start

    odeint::rosenbrock4<double, RodasCoefficients> implicit_method;
    Vector from, to, error, between;
    std::vector<double> jacobian, probe, slope, moved; ///< of the Rosenbrock method; `probe`: the power iteration's direction

    Parts(const OdeProblem& p, SolverWork& w)
        : problem(p), work(w), first_slope(p.size()), last_slope(p.size()), stage(p.size()), stage_slope(p.size()), from(p.size()),
          to(p.size()), error(p.size()), between(p.size()), jacobian(p.size() * p.size()), probe(p.scale), slope(p.size()),
          moved(p.size()) {
        tried.end.resize(p.size());
        tried.error.resize(p.size());
        tried.nodes.resize(p.size() * DensePath::nodes);
    }

    void derivative(double t_s, const double* x, double* dxdt) {
        ++work.derivatives;
        problem.derivative(t_s, x, dxdt);
    }

    /// Increments are the root of the rounding unit: truncation and rounding then weigh the same.
    void jacobian_by_differences(double t_s, const double* x, double* rows, double* dfdt) {
        const std::size_t n = problem.size();
        const double root = std::sqrt(std::numeric_limits<double>::epsilon());
        derivative(t_s, x, slope.data());
        std::copy(x, x + n, moved.begin());
        std::vector<double> there(n);
        for (std::size_t column = 0; column < n; ++column) {
            moved[column] = x[column] + root * (problem.scale[column] + std::abs(x[column]));
            derivative(t_s, moved.data(), there.data());
            for (std::size_t row = 0; row < n; ++row)
                rows[row * n + column] = (there[row] - slope[row]) / (moved[column] - x[column]);
            moved[column] = x[column];
        }
        const double later_s = t_s + root * (1.0 + std::abs(t_s));
        derivative(later_s, x, there.data());
        for (std::size_t row = 0; row < n; ++row)
            dfdt[row] = (there[row] - slope[row]) / (later_s - t_s);
    }

    void full_jacobian(double t_s, const Vector& x, Matrix& rows, Vector& dfdt) {
        ++work.jacobians;
        problem.jacobian ? problem.jacobian(t_s, &x[0], &rows(0, 0), &dfdt[0]) : jacobian_by_differences(t_s, &x[0], &rows(0, 0), &dfdt[0]);
        std::copy(rows.data().begin(), rows.data().end(), jacobian.begin());
    }

    /// Largest eigenvalue's magnitude by the power method, in the scaled components. The direction is kept from step to step, so a few
    /// iterations do; a pair of complex eigenvalues makes the growth swing, hence the mean over all of them.
    double spectral_radius() {
        const std::size_t n = problem.size();
        double growth_log = 0.0;
        constexpr int iterations = 6;
        for (int k = 0; k < iterations; ++k) {
            const double before = norm(probe, problem.scale);
            if (!(before > 0.0) || !std::isfinite(before)) {
                probe = problem.scale; // the Jacobian is 0 along it, or not finite
                return 0.0;
            }
            for (std::size_t i = 0; i < n; ++i)
                slope[i] = probe[i] / before;
            for (std::size_t row = 0; row < n; ++row) {
                probe[row] = 0.0;
                for (std::size_t column = 0; column < n; ++column)
                    probe[row] += jacobian[row * n + column] * slope[column];
            }
            growth_log += std::log(norm(probe, problem.scale) + std::numeric_limits<double>::min());
        }
        return std::exp(growth_log / iterations);
    }
};

SingleStep::SingleStep(const OdeProblem& problem, SolverWork& work) : parts_(std::make_unique<Parts>(problem, work)) {}
SingleStep::~SingleStep() = default;
TriedStep& SingleStep::tried() { return parts_->tried; }

void SingleStep::dormand_prince(double t_s, double step_s, const std::vector<double>& x) {
    Parts& p = *parts_;
    if (!p.slope_known)
        p.derivative(t_s, x.data(), p.first_slope.data());
    p.slope_known = true;
    p.last_was_rosenbrock = false;
    int stage = 1;
    const auto system = [&](const std::vector<double>& at, std::vector<double>& dxdt, double time_s) {
        p.derivative(time_s, at.data(), dxdt.data());
        if (++stage == 6) {
            p.stage = at;
            p.stage_slope = dxdt;
        }
    };
    p.explicit_method.do_step(system, x, p.first_slope, t_s, p.tried.end, p.last_slope, step_s, p.tried.error);
    std::vector<double>&apart = p.slope, &slopes_apart = p.moved;
    for (std::size_t i = 0; i < x.size(); ++i) {
        apart[i] = p.tried.end[i] - p.stage[i];
        slopes_apart[i] = p.last_slope[i] - p.stage_slope[i];
    }
    const double distance = norm(apart, p.problem.scale);
    p.tried.stiffness = distance > 0.0 ? step_s * norm(slopes_apart, p.problem.scale) / distance : 0.0;
}

void SingleStep::rosenbrock(double t_s, double step_s, const std::vector<double>& x) {
    Parts& p = *parts_;
    p.last_was_rosenbrock = true;
    std::copy(x.begin(), x.end(), p.from.begin());
    const auto system = [&](const Vector& at, Vector& dxdt, double time_s) { p.derivative(time_s, &at[0], &dxdt[0]); };
    const auto jacobian = [&](const Vector& at, Matrix& rows, const double& time_s, Vector& dfdt) {
        p.full_jacobian(time_s, at, rows, dfdt);
    };
    p.implicit_method.do_step(std::make_pair(system, jacobian), p.from, t_s, p.to, step_s, p.error);
    std::copy(p.to.begin(), p.to.end(), p.tried.end.begin());
    std::copy(p.error.begin(), p.error.end(), p.tried.error.begin());
    p.tried.stiffness = step_s * p.spectral_radius();
}

void SingleStep::accept() {
    Parts& p = *parts_;
    p.slope_known = !p.last_was_rosenbrock;
    std::swap(p.first_slope, p.last_slope);
}

void SingleStep::restart() { parts_->slope_known = false; }

void SingleStep::extend(double step_s, const std::vector<double>& x) {
    Parts& p = *parts_;
    const std::size_t n = x.size();
    std::copy(x.begin(), x.end(), p.tried.nodes.begin());
    std::copy(p.tried.end.begin(), p.tried.end.end(), p.tried.nodes.end() - static_cast<std::ptrdiff_t>(n));
    if (p.last_was_rosenbrock)
        p.implicit_method.prepare_dense_output();
    for (std::size_t node = 1; node + 1 < DensePath::nodes; ++node) {
        // On [0, 1], whatever t is: far from t = 0 the differences of times would lose digits.
        const double place = static_cast<double>(node) / 5.0;
        double* out = &p.tried.nodes[node * n];
        if (p.last_was_rosenbrock) {
            p.implicit_method.calc_state(place, p.between, p.from, 0.0, p.to, 1.0);
            std::copy(p.between.begin(), p.between.end(), out);
        } else {
            p.explicit_method.calc_state(place * step_s, p.moved, x, p.first_slope, 0.0, p.tried.end, p.last_slope, step_s);
            std::copy(p.moved.begin(), p.moved.end(), out);
        }
    }
}

} // namespace fernlicht
