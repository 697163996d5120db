#include "scenarios/vehicle/integrator.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {

double quintic(const double* values, std::size_t stride, double place) {
    // Lagrange's form; the denominators are (k/5 - 0/5) .. without (k/5 - k/5).
    static constexpr double weight[DensePath::nodes] = {-3125.0 / 120.0, 3125.0 / 24.0,  -3125.0 / 12.0,
                                                        3125.0 / 12.0,   -3125.0 / 24.0, 3125.0 / 120.0};
    double sum = 0.0;
    for (std::size_t k = 0; k < DensePath::nodes; ++k) {
        double product = weight[k];
        for (std::size_t j = 0; j < DensePath::nodes; ++j)
            product *= j == k ? 1.0 : place - static_cast<double>(j) / 5.0;
        sum += product * values[k * stride];
    }
    return sum;
}

DensePath::DensePath(std::vector<std::size_t> kept) : kept_(std::move(kept)) {}

void DensePath::add(double start_s, double end_s, const double* values, std::size_t state_size) {
    starts_s_.push_back(start_s);
    ends_s_.push_back(end_s);
    for (std::size_t node = 0; node < nodes; ++node)
        for (const std::size_t component : kept_)
            values_.push_back(values[node * state_size + component]);
}

std::size_t DensePath::step_at(double time_s) const {
    const auto next = std::upper_bound(starts_s_.begin(), starts_s_.end(), time_s);
    return next == starts_s_.begin() ? 0 : static_cast<std::size_t>(next - starts_s_.begin()) - 1;
}

double DensePath::at(double time_s, std::size_t component) const {
    const std::size_t step = step_at(time_s);
    const double length_s = ends_s_[step] - starts_s_[step];
    const double place = std::clamp((time_s - starts_s_[step]) / length_s, 0.0, 1.0);
    return quintic(&values_[step * nodes * kept_.size() + component], kept_.size(), place);
}

namespace {

constexpr double stiff_from = 3.25, mild_below = 1.0;
constexpr int stiff_after = 15, not_stiff_after = 6, mild_after = 25;
constexpr double rounding = std::numeric_limits<double>::epsilon();

bool crosses(const Watch& watch, double before, double after) {
    return (watch.rising && before < 0.0 && after >= 0.0) || (watch.falling && before > 0.0 && after <= 0.0);
}

struct Crossing {
    std::size_t watch = 0;
    double place = 2.0; ///< of the step, [0, 1]
    bool rising = true;
};

/// The state at a place of the step tried.
void state_at(const TriedStep& step, double place, std::vector<double>& x) {
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = quintic(&step.nodes[i], x.size(), place);
}

/// The first of the watches to change sign within the step, by bisection: `place` lies behind the change by at most `within`.
std::optional<Crossing> first_crossing(const std::vector<Watch>& watches, const TriedStep& step, double t_s, double step_s, double within) {
    Crossing first;
    const std::size_t n = step.end.size();
    std::vector<double> x(n);
    for (std::size_t w = 0; w < watches.size(); ++w) {
        double before = watches[w].value(t_s, step.nodes.data());
        for (std::size_t node = 1; node < DensePath::nodes; ++node) {
            double low = static_cast<double>(node - 1) / 5.0, high = static_cast<double>(node) / 5.0;
            const double after = watches[w].value(t_s + high * step_s, &step.nodes[node * n]);
            if (low >= first.place)
                break;
            if (crosses(watches[w], before, after)) {
                while (high - low > within && high - low > rounding) {
                    const double middle = 0.5 * (low + high);
                    state_at(step, middle, x);
                    const double there = watches[w].value(t_s + middle * step_s, x.data());
                    (crosses(watches[w], before, there) ? high : low) = middle;
                }
                if (high < first.place)
                    first = {w, high, before < 0.0};
                break;
            }
            before = after;
        }
    }
    return first.place <= 1.0 ? std::optional(first) : std::nullopt;
}

} // namespace

OdeIntegrator::OdeIntegrator(const OdeProblem& problem, const SolverOptions& options)
    : problem_(problem), options_(options), single_(problem, work_),
      active_(options.solver == Solver::rosenbrock ? Solver::rosenbrock : Solver::dormand_prince) {
    if (!(options.tolerance >= 1.0e-14 && options.tolerance <= 0.1))
        throw std::invalid_argument(fmt::format("OdeIntegrator: a tolerance of {}", options.tolerance));
    if (options.fixed_step_s != 0.0 && (!(options.fixed_step_s > 0.0) || options.solver == Solver::automatic))
        throw std::invalid_argument("OdeIntegrator: a fixed step that is not above 0, or without a chosen solver");
    for (const double scale : problem.scale)
        if (!(scale > 0.0))
            throw std::invalid_argument("OdeIntegrator: a scale that is not above 0");
}

void OdeIntegrator::give_up(double t_s, const std::string& found) const {
    throw InputError({{}, 0, 0, "solver"}, fmt::format("{} with {} at {:.6g} s", found, name(active_), t_s),
                     options_.solver == Solver::dormand_prince ? "solver: auto or rosenbrock, or a larger tolerance"
                                                               : "a larger tolerance or equations that change less quickly");
}

void OdeIntegrator::try_step(double t_s, double step_s, const std::vector<double>& x) {
    active_ == Solver::rosenbrock ? single_.rosenbrock(t_s, step_s, x) : single_.dormand_prince(t_s, step_s, x);
}

double OdeIntegrator::error_of(const std::vector<double>& x) {
    const TriedStep& step = single_.tried();
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double allowed = options_.tolerance * (problem_.scale[i] + std::max(std::abs(x[i]), std::abs(step.end[i])));
        sum += (step.error[i] / allowed) * (step.error[i] / allowed);
        if (!std::isfinite(step.end[i]))
            return std::numeric_limits<double>::infinity();
    }
    return std::isfinite(sum) ? std::sqrt(sum / static_cast<double>(x.size())) : std::numeric_limits<double>::infinity();
}

/// So short that an explicit Euler step would change the state by a hundredth of its scale (Hairer, Norsett & Wanner I, II.4, first guess).
double OdeIntegrator::first_step(double t_s, double room_s, const std::vector<double>& x) {
    std::vector<double> slope(x.size());
    ++work_.derivatives;
    problem_.derivative(t_s, x.data(), slope.data());
    double change = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        change = std::max(change, std::abs(slope[i]) / (problem_.scale[i] + std::abs(x[i])));
    const double guess_s = change > 0.0 ? 0.01 / change : room_s;
    return std::min(room_s, guess_s * std::pow(options_.tolerance / 1.0e-6, 0.2));
}

double OdeIntegrator::next_step(double step_s, double error, bool taken) {
    if (!std::isfinite(error))
        return 0.1 * step_s;
    const bool implicit = active_ == Solver::rosenbrock;
    const double beta = implicit ? 0.0 : 0.04;
    const double power = implicit ? 0.25 : 0.2 - 0.75 * beta;
    const double floor_error = std::max(error, 1.0e-10);
    double factor = 0.9 * std::pow(floor_error, -power) * (taken ? std::pow(last_error_, beta) : 1.0);
    factor = std::clamp(factor, 0.2, taken && !after_rejection_ ? 8.0 : 1.0);
    if (taken)
        last_error_ = std::max(error, 1.0e-4);
    return step_s * factor;
}

void OdeIntegrator::weigh_stiffness() {
    if (options_.solver != Solver::automatic)
        return;
    const double product = single_.tried().stiffness;
    if (active_ == Solver::dormand_prince) {
        if (product > stiff_from) {
            mild_steps_ = 0;
            ++stiff_steps_;
        } else if (++mild_steps_ >= not_stiff_after)
            stiff_steps_ = 0;
        if (stiff_steps_ < stiff_after)
            return;
        active_ = Solver::rosenbrock;
    } else {
        slow_steps_ = product < mild_below ? slow_steps_ + 1 : 0;
        if (slow_steps_ < mild_after)
            return;
        active_ = Solver::dormand_prince;
    }
    ++work_.switches;
    stiff_steps_ = mild_steps_ = slow_steps_ = 0;
    single_.restart();
}

/// Repeats the step so that it ends behind the event by at most `within_s`. The continuous extension, where the event was found, is less
/// exact than the method itself, hence the corrections: Newton's, by the slope over the last fifth of the step.
double OdeIntegrator::step_to(const Watch& watch, bool rising, double t_s, double step_s, double within_s, const std::vector<double>& x) {
    constexpr int max_corrections = 6;
    for (int correction = 0;; ++correction) {
        try_step(t_s, step_s, x);
        single_.extend(step_s, x);
        const std::vector<double>& nodes = single_.tried().nodes;
        const double there = watch.value(t_s + step_s, single_.tried().end.data());
        const double before = watch.value(t_s + 0.8 * step_s, &nodes[4 * x.size()]);
        const double slope = (there - before) / (0.2 * step_s), late_s = there / slope;
        const bool crossed = rising ? there >= 0.0 : there <= 0.0;
        if (correction == max_corrections || (crossed && !(late_s > within_s)))
            return step_s;
        // Aims at the middle of what is allowed; where the slope tells nothing, just on.
        const double further_s = late_s > -0.5 * step_s && late_s < 0.5 * step_s ? 0.5 * within_s - late_s : within_s;
        step_s += crossed || further_s > 0.0 ? further_s : within_s;
    }
}

Arrival OdeIntegrator::integrate(double start_s, double end_s, std::vector<double>& x, const std::vector<Watch>& watches, DensePath* path) {
    const bool fixed = options_.fixed_step_s > 0.0;
    double t_s = start_s;
    std::uint64_t fixed_steps = 0;
    single_.restart();
    after_rejection_ = false;
    if (!(step_s_ > 0.0))
        step_s_ = first_step(t_s, end_s - t_s, x);
    while (t_s < end_s) {
        if (work_.dormand_prince.steps + work_.rosenbrock.steps + work_.dormand_prince.rejected + work_.rosenbrock.rejected >=
            options_.max_steps)
            give_up(t_s, fmt::format("{} steps", options_.max_steps));
        // Steps of a fixed length are counted, not added up. The last step is stretched by up to a per cent rather than leave a splinter.
        const double wanted_s =
            fixed ? start_s + static_cast<double>(fixed_steps + 1) * options_.fixed_step_s - t_s : std::min(step_s_, end_s - t_s);
        const bool last = t_s + (fixed ? 1.0 + 1.0e-9 : 1.01) * wanted_s >= end_s;
        double step_s = last ? end_s - t_s : wanted_s;
        if (!last && !(t_s + step_s > t_s + 4.0 * rounding * std::abs(t_s)))
            give_up(t_s, fmt::format("a step of {:.3g} s", step_s));
        try_step(t_s, step_s, x);
        MethodWork& method = active_ == Solver::rosenbrock ? work_.rosenbrock : work_.dormand_prince;
        const double error = fixed ? 0.0 : error_of(x);
        if (error > 1.0) {
            ++method.rejected;
            step_s_ = next_step(step_s, error, false);
            after_rejection_ = true;
            continue;
        }
        const bool used_whole = step_s >= 0.99 * step_s_ || error > 0.5; // a step cut short by the end says little about the next
        const double following_s = fixed ? step_s : next_step(step_s, error, true);
        after_rejection_ = false;
        double arrival_s = last ? end_s : t_s + step_s;
        std::optional<Crossing> crossing;
        if (path || !watches.empty())
            single_.extend(step_s, x);
        if (!watches.empty()) {
            const double within_s = std::max(options_.event_tolerance_s, 4.0 * rounding * std::abs(t_s));
            crossing = first_crossing(watches, single_.tried(), t_s, step_s, within_s / step_s);
            if (crossing && crossing->place < 1.0) {
                step_s = step_to(watches[crossing->watch], crossing->rising, t_s, step_s * crossing->place, within_s, x);
                arrival_s = t_s + step_s;
            }
        }
        if (path)
            path->add(t_s, arrival_s, single_.tried().nodes.data(), x.size());
        ++method.steps;
        ++fixed_steps;
        method.simulated_s += arrival_s - t_s;
        x = single_.tried().end;
        t_s = arrival_s;
        single_.accept();
        step_s_ = used_whole || following_s > step_s_ ? following_s : step_s_;
        if (crossing) {
            ++work_.events;
            return {t_s, crossing->watch};
        }
        weigh_stiffness();
    }
    return {t_s, std::nullopt};
}

} // namespace fernlicht
