#include "scenarios/vehicle/actuator.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

enum class Mode { free, slewing_up, slewing_down, at_stop };

/// The equation in each mode, for the command that holds now.
struct Law {
    double w = 0.0, z = 0.0, rate = 0.0, command = 0.0;
    Mode mode = Mode::free;

    double pull(double x, double v) const { return w * w * (command - x) - 2.0 * z * w * v; }
    void rates(const double* x, double* dxdt) const {
        dxdt[0] = mode == Mode::free ? x[1] : mode == Mode::slewing_up ? rate : mode == Mode::slewing_down ? -rate : 0.0;
        dxdt[1] = mode == Mode::free ? pull(x[0], x[1]) : 0.0;
    }
    void jacobian(double* rows, double* dfdt) const {
        const bool free = mode == Mode::free;
        rows[0] = rows[2] = rows[3] = dfdt[0] = dfdt[1] = 0.0;
        rows[1] = free ? 1.0 : 0.0;
        if (free) {
            rows[2] = -w * w;
            rows[3] = -2.0 * z * w;
        }
    }
};

/// Time and value of each change of the command, dead time included.
std::vector<std::pair<double, double>> commands(const ActuatorParameters& actuator, const std::function<double(double)>& command,
                                                const std::vector<double>& switches_s, double end_s) {
    std::vector<double> ticks_s = switches_s;
    const auto last = static_cast<std::uint64_t>(end_s / actuator.control_period_s);
    for (std::uint64_t k = 0; k <= last; ++k)
        ticks_s.push_back(static_cast<double>(k) * actuator.control_period_s);
    std::ranges::sort(ticks_s);
    std::vector<std::pair<double, double>> changes;
    for (const double tick_s : ticks_s) {
        if (tick_s + actuator.dead_time_s >= end_s)
            break;
        const double angle_rad = std::clamp(command(tick_s), actuator.min_rad, actuator.max_rad);
        const double from_s = changes.empty() ? 0.0 : tick_s + actuator.dead_time_s;
        if (!changes.empty() && changes.back().first == from_s)
            changes.back().second = angle_rad;
        else if (changes.empty() || changes.back().second != angle_rad)
            changes.emplace_back(from_s, angle_rad);
    }
    return changes;
}

Mode mode_at(const Law& law, const ActuatorParameters& limits, std::vector<double>& x) {
    const auto outwards = [&](double side) { return side * x[1] > 0.0 || (x[1] == 0.0 && side * (law.command - x[0]) >= 0.0); };
    if ((x[0] >= limits.max_rad && outwards(1.0)) || (x[0] <= limits.min_rad && outwards(-1.0))) {
        x[0] = std::clamp(x[0], limits.min_rad, limits.max_rad);
        x[1] = 0.0;
        const double inwards = x[0] >= limits.max_rad ? -1.0 : 1.0;
        return inwards * (law.command - x[0]) > 0.0 ? Mode::free : Mode::at_stop;
    }
    if (std::abs(x[1]) >= law.rate) {
        x[1] = std::copysign(law.rate, x[1]);
        if (std::copysign(1.0, x[1]) * law.pull(x[0], x[1]) > 0.0)
            return x[1] > 0.0 ? Mode::slewing_up : Mode::slewing_down;
    }
    return Mode::free;
}

std::vector<Watch> watches_for(const Law& law, const ActuatorParameters& limits) {
    std::vector<Watch> watches{{[&](double, const double* x) { return x[0] - limits.max_rad; }, true, false},
                               {[&](double, const double* x) { return x[0] - limits.min_rad; }, false, true}};
    if (law.mode == Mode::free) {
        watches.push_back({[&](double, const double* x) { return x[1] - law.rate; }, true, false});
        watches.push_back({[&](double, const double* x) { return x[1] + law.rate; }, false, true});
    } else if (law.mode != Mode::at_stop) {
        const double side = law.mode == Mode::slewing_up ? 1.0 : -1.0;
        watches.push_back({[&law, side](double, const double* x) { return side * law.pull(x[0], x[1]); }, false, true});
    }
    return watches;
}

} // namespace

struct Actuator::Parts {
    Parts(const ActuatorParameters& limits, const SolverOptions& options)
        : actuator(limits), law{limits.frequency_rad_s(), limits.damping, limits.rate_limit_rad_s}, problem(problem_of(law)),
          integrator(problem, options) {}
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;

    static OdeProblem problem_of(const Law& law) {
        OdeProblem problem;
        problem.derivative = [&law](double, const double* x, double* dxdt) { law.rates(x, dxdt); };
        problem.jacobian = [&law](double, const double*, double* rows, double* dfdt) { law.jacobian(rows, dfdt); };
        problem.scale = {1.0e-3, 1.0e-3 * std::max(1.0, law.w)}; // a milliradian, and as fast as it swings
        return problem;
    }

    ActuatorParameters actuator;
    Law law;
    OdeProblem problem;
    OdeIntegrator integrator;
    std::vector<double> x{0.0, 0.0};
    double time_s = 0.0;
    bool jammed = false;
    ActuatorRun run;
};

Actuator::Actuator(const ActuatorParameters& actuator, double angle_rad, const SolverOptions& options)
    : parts_(std::make_unique<Parts>(actuator, options)) {
    parts_->x[0] = parts_->law.command = std::clamp(angle_rad, actuator.min_rad, actuator.max_rad);
}
Actuator::Actuator(Actuator&&) noexcept = default;
Actuator::~Actuator() = default;

double Actuator::angle_rad() const { return parts_->x[0]; }
void Actuator::command(double angle_rad) {
    parts_->law.command = std::clamp(angle_rad, parts_->actuator.min_rad, parts_->actuator.max_rad);
}

void Actuator::jam(bool jammed) {
    parts_->jammed = jammed;
    if (jammed)
        parts_->x[1] = 0.0;
}

void Actuator::advance(double until_s) {
    Parts& p = *parts_;
    if (p.jammed && p.time_s < until_s) {
        p.law.mode = Mode::at_stop;
        p.time_s = p.integrator.integrate(p.time_s, until_s, p.x, {}, &p.run.path).time_s;
    }
    while (p.time_s < until_s) {
        p.law.mode = mode_at(p.law, p.actuator, p.x);
        p.run.rate_limited += p.law.mode == Mode::slewing_up || p.law.mode == Mode::slewing_down ? 1U : 0U;
        p.run.at_stop += p.law.mode == Mode::at_stop ? 1U : 0U;
        p.time_s = p.integrator.integrate(p.time_s, until_s, p.x, watches_for(p.law, p.actuator), &p.run.path).time_s;
    }
}

const ActuatorRun& Actuator::so_far() const { return parts_->run; }

ActuatorRun Actuator::take() {
    parts_->run.work = parts_->integrator.work();
    return std::move(parts_->run);
}

ActuatorRun run_actuator(const ActuatorParameters& actuator, const std::function<double(double tick_s)>& command,
                         const std::vector<double>& switches_s, double end_s, const SolverOptions& options) {
    const auto changes = commands(actuator, command, switches_s, end_s);
    Actuator moving(actuator, changes.empty() ? 0.0 : changes.front().second, options);
    for (std::size_t i = 0; i < changes.size(); ++i) {
        moving.command(changes[i].second);
        moving.advance(i + 1 < changes.size() ? changes[i + 1].first : end_s);
    }
    return moving.take();
}

} // namespace fernlicht
