#include "metrics/improve/improve_beam.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

// What a miss costs, against squares of a change: thirty times the light over a square degree is 10^3.
constexpr double gain_price = 1e3, kept_price = 1e4;

/// A beam that was read.
struct ReadBeam {
    std::vector<double> x;
    std::shared_ptr<LampFile> file;
    std::vector<std::vector<Moment>> drives;
    std::vector<Value> values;
    std::optional<RegulationCheck> check;
    std::vector<double> missed; ///< by reading, in its scale
    RegulationRows::Missed regulation;
    double cost = 0.0; ///< with what is missed
};

class Improvement {
  public:
    Improvement(const ImproveProblem& problem, const SolveQuadratic& solve)
        : problem_(problem), solve_(solve), first_(read_first()),
          basis_(problem.table, box(), 0.5 * problem.narrowest_deg, 0.25 * problem.narrowest_deg, problem.floor_cd),
          hessian_(basis_.size_and_bends(problem.narrowest_deg, 0.5 * problem.narrowest_deg)) {
        first_.x.assign(basis_.size(), 0.0);
        judge(first_);
    }

    ImprovedBeam find() {
        ImprovedBeam found;
        found.before = found.foretold = first_.values;
        found.variables = basis_.size();
        ReadBeam here = first_;
        constexpr double first_step = 0.25, shortest = 0.004, longest = 2.0;
        double step = first_step;
        std::vector<double> refused; // by the regulation, in a step as long
        constexpr int most_looks = 4;
        int looks = 0;
        while (step >= shortest && static_cast<int>(found.steps.size()) < problem_.max_steps) {
            const auto [programme, rows] = programme_at(here, step);
            const QuadraticSolution solution = solve_(programme);
            if (!solution.solved) {
                step *= 0.5;
                continue;
            }
            keep_prices(found, solution, rows);
            ReadBeam next = read_at({solution.x.begin(), solution.x.begin() + static_cast<std::ptrdiff_t>(basis_.size())});
            const double foretold_gain = here.cost - cost_of(programme, solution.x), gain = here.cost - next.cost;
            // Where all is met, what a step may still save must be worth it.
            found.settled = foretold_gain <= (is_met(here) ? 0.01 : 1e-3 * std::min(1.0, step / first_step)) * here.cost;
            if (found.settled && gain <= 0.0)
                break;
            ImproveStep& told = found.steps.emplace_back();
            told.longest = step;
            told.foretold = foretold(here, next);
            told.found = next.values;
            told.size = std::sqrt(size_of(next.x));
            told.regulation_row = next.regulation.row;
            told.taken = gain > 0.0 && gain >= 0.1 * foretold_gain;
            if (!told.taken) {
                // The regulation's check has found places that are held from now on: once more, unless that changes nothing.
                const bool changes = refused.empty() || !std::ranges::equal(refused, next.x, [&](double a, double b) {
                                         return std::abs(a - b) < 0.02 * step;
                                     });
                const bool again = next.regulation.by > 0.0 && changes && ++looks < most_looks;
                refused = again ? next.x : std::vector<double>();
                looks = again ? looks : 0;
                step *= again ? 1.0 : 0.5;
                continue;
            }
            refused.clear();
            looks = 0;
            double farthest = 0.0;
            for (std::size_t i = 0; i < next.x.size(); ++i)
                farthest = std::max(farthest, std::abs(next.x[i] - here.x[i]));
            if (gain > 0.75 * foretold_gain && farthest > 0.9 * step)
                step = std::min(2.0 * step, longest);
            found.foretold = told.foretold;
            here = std::move(next);
            if (found.settled)
                break;
        }
        found.found = here.values;
        found.table = here.file->table;
        for (std::size_t i = 0; i < here.missed.size(); ++i) {
            found.met.push_back(here.missed[i] <= 0.0);
            found.gain_missed = found.gain_missed || (problem_.readings[i].is_gain && here.missed[i] > 1e-3);
        }
        found.regulation_met = here.regulation.by <= 0.0;
        return found;
    }

  private:
    ReadBeam read_first() const {
        ReadBeam beam;
        beam.file = std::make_shared<LampFile>();
        beam.file->table = problem_.table;
        beam.drives = problem_.drives;
        bool any = false;
        for (std::vector<Moment>& moments : beam.drives)
            for (Moment& moment : moments)
                for (LitLamp& lamp : moment.lamps)
                    if (lamp.file->table == problem_.table) {
                        lamp.file = beam.file;
                        any = true;
                    }
        if (!any)
            throw std::logic_error("improve_beam: no lamp of the drives has this table");
        return beam;
    }

    ReadBeam read_at(std::vector<double> x) const {
        ReadBeam beam;
        beam.x = std::move(x);
        beam.file = std::make_shared<LampFile>();
        beam.file->table = basis_.changed(beam.x);
        beam.drives = first_.drives;
        for (std::vector<Moment>& moments : beam.drives)
            for (Moment& moment : moments)
                for (LitLamp& lamp : moment.lamps)
                    if (lamp.file == first_.file)
                        lamp.file = beam.file;
        judge(beam);
        return beam;
    }

    void judge(ReadBeam& beam) const {
        beam.cost = size_of(beam.x);
        beam.values.clear();
        beam.missed.clear();
        for (const SoughtReading& sought : problem_.readings) {
            const Value& value = beam.values.emplace_back(sought.reading->value(beam.drives[sought.drive]));
            const double beyond = value.figure() ? (sought.at_least ? 1.0 : -1.0) * (*value.figure() - sought.bound) / sought.scale : -10.0;
            beam.missed.push_back(std::max(0.0, -beyond));
            beam.cost += (sought.is_gain ? gain_price : kept_price) * beam.missed.back();
        }
        if (problem_.regulation) {
            beam.check = problem_.regulation->check(beam.file->table);
            beam.regulation = problem_.regulation->missed_by(*beam.check);
            beam.cost += kept_price * 100.0 * beam.regulation.by;
        }
    }

    /// Wherever light decides a reading, and room for the change to come down in.
    BeamBox box() const {
        BeamBox box{180.0, -180.0, 90.0, -90.0};
        for (const SoughtReading& sought : problem_.readings) {
            bool decided = false;
            each_figure(first_, sought, [&](double, const std::vector<double>& per_cd) {
                for (std::size_t i = 0; i < per_cd.size(); ++i)
                    if (per_cd[i] != 0.0) {
                        box.add(problem_.table.h_deg[i % problem_.table.h_deg.size()],
                                problem_.table.v_deg[i / problem_.table.h_deg.size()]);
                        decided = true;
                    }
            });
            if (!decided && sought.is_gain)
                throw InputError({{}, 0, 0, "--gain"}, fmt::format("found '{}', which no light of this lamp decides", sought.name),
                                 "a reading that is a number and changes with the lamp");
        }
        const double h_deg = 2.0 * problem_.narrowest_deg, v_deg = problem_.narrowest_deg;
        return {box.left_deg - h_deg, box.right_deg + h_deg, box.bottom_deg - v_deg, box.top_deg + v_deg};
    }

    /// What it takes to keep the reading on the right side of its bound: figures, and their derivatives by the table's samples.
    void each_figure(const ReadBeam& beam, const SoughtReading& sought,
                     const std::function<void(double, const std::vector<double>&)>& take) const {
        sought.reading->each_side_figure(beam.drives[sought.drive], sought.at_least,
                                         [&](double figure, const BeamGradient& gradient) { take(figure, of_lamp(gradient, beam)); });
    }

    /// Of all lamps that have the file.
    std::vector<double> of_lamp(const BeamGradient& gradient, const ReadBeam& beam) const {
        std::vector<double> per_cd(problem_.table.cd.size());
        for (const LampGradient& one : gradient)
            if (one.file == beam.file)
                std::ranges::transform(one.per_cd, per_cd, per_cd.begin(), std::plus());
        return per_cd;
    }

    double size_of(const std::vector<double>& x) const {
        double twice = 0.0;
        for (const QuadraticProgramme::Term& term : hessian_)
            twice += (term.row == term.column ? 1.0 : 2.0) * term.value * x[term.row] * x[term.column];
        return 0.5 * twice;
    }

    static bool is_met(const ReadBeam& beam) {
        return beam.regulation.by <= 0.0 && std::ranges::all_of(beam.missed, [](double missed) { return missed <= 0.0; });
    }

    double cost_of(const QuadraticProgramme& programme, const std::vector<double>& x) const {
        double cost = size_of(x);
        for (std::size_t i = basis_.size(); i < x.size(); ++i)
            cost += programme.linear[i] * x[i];
        return cost;
    }

    /// Variables: the change, then what each reading misses, then what rows that may be missed miss. And what each row is of.
    std::pair<QuadraticProgramme, std::vector<LimitRow>> programme_at(const ReadBeam& here, double step) const {
        const std::size_t variables = basis_.size(), readings = problem_.readings.size();
        QuadraticProgramme programme;
        programme.hessian = hessian_;
        for (const double x : here.x) {
            programme.low.push_back(x - step);
            programme.high.push_back(x + step);
        }
        programme.linear.assign(variables, 0.0);
        for (std::size_t i = 0; i <= readings; ++i) {
            programme.linear.push_back(i < readings && problem_.readings[i].is_gain ? gain_price : kept_price);
            programme.low.push_back(0.0);
            programme.high.push_back(unbounded);
        }
        const StepFrom from{here.x, step};
        std::vector<LimitRow> rows = table_rows(basis_, problem_.limits, from);
        if (problem_.regulation)
            std::ranges::move(problem_.regulation->rows(basis_, here.file->table, *here.check, from), std::back_inserter(rows));
        for (LimitRow& limit : rows)
            if (limit.may_be_missed)
                limit.row.form.emplace_back(variables + readings, std::isfinite(limit.row.low) ? 1.0 : -1.0);
        for (std::size_t i = 0; i < readings; ++i)
            add_reading(rows, here, problem_.readings[i], variables + i);
        for (const LimitRow& limit : rows)
            programme.rows.push_back(limit.row);
        return {std::move(programme), std::move(rows)};
    }

    /// In units of its scale, a little inside the bound: the table is rounded when it is written.
    void add_reading(std::vector<LimitRow>& rows, const ReadBeam& here, const SoughtReading& sought, std::size_t miss) const {
        const double by = (sought.at_least ? 1.0 : -1.0) / sought.scale, inside = sought.is_gain ? 0.002 : 0.02;
        const std::size_t first = rows.size();
        each_figure(here, sought, [&](double figure, const std::vector<double>& per_cd) {
            LimitRow limit{sought.name, {basis_.form(per_cd)}, sought.is_gain ? 0.01 : 1.0};
            for (auto& [variable, factor] : limit.row.form)
                factor *= by;
            limit.row.low = by * (sought.bound - figure) + inside + value_of(limit.row.form, here.x);
            limit.row.form.emplace_back(miss, 1.0);
            // On a straight road all moments are one.
            for (std::size_t i = first; i < rows.size(); ++i)
                if (is_same(rows[i].row.form, limit.row.form)) {
                    rows[i].row.low = std::max(rows[i].row.low, limit.row.low);
                    return;
                }
            rows.push_back(std::move(limit));
        });
    }

    static bool is_same(const LinearForm& a, const LinearForm& b) {
        return std::ranges::equal(a, b, [](const auto& one, const auto& other) {
            return one.first == other.first && std::abs(one.second - other.second) <= 1e-6 * std::abs(one.second);
        });
    }

    std::vector<Value> foretold(const ReadBeam& here, const ReadBeam& next) const {
        std::vector<Value> values;
        for (std::size_t i = 0; i < problem_.readings.size(); ++i) {
            const SoughtReading& sought = problem_.readings[i];
            const ReadingOfLight::Found found = sought.reading->gradient(here.drives[sought.drive]);
            if (!found.value.number()) {
                values.push_back(found.value);
                continue;
            }
            const std::vector<double> per_cd = of_lamp(found.gradient, here);
            double value = *found.value.number();
            for (std::size_t k = 0; k < per_cd.size(); ++k)
                value += per_cd[k] * (next.file->table.cd[k] - here.file->table.cd[k]);
            values.emplace_back(value);
        }
        return values;
    }

    void keep_prices(ImprovedBeam& found, const QuadraticSolution& solution, const std::vector<LimitRow>& rows) const {
        const bool gain_missed = [&] {
            for (std::size_t i = 0; i < problem_.readings.size(); ++i)
                if (problem_.readings[i].is_gain && solution.x[basis_.size() + i] > 1e-3)
                    return true;
            return false;
        }();
        const double all = gain_missed ? gain_price : size_of(solution.x);
        std::map<std::string, double> worth;
        for (std::size_t i = 0; i < rows.size(); ++i)
            worth[rows[i].of] += solution.prices[i] * rows[i].hundredth / all;
        found.binding.clear();
        for (const SoughtReading& sought : problem_.readings)
            if (gain_missed && sought.is_gain)
                worth.erase(sought.name);
        double most = 0.0;
        for (const auto& [of, one] : worth)
            most = std::max(most, one);
        for (const auto& [of, one] : worth)
            if (one > std::max(0.01 * most, 1e-6)) // a solver leaves all of them a little
                found.binding.push_back({of, one});
        std::ranges::stable_sort(found.binding, std::greater(), &BindingLimit::worth);
    }

    const ImproveProblem& problem_;
    const SolveQuadratic& solve_;
    ReadBeam first_;
    BeamBasis basis_;
    std::vector<QuadraticProgramme::Term> hessian_;
};

} // namespace

ImprovedBeam improve_beam(const ImproveProblem& problem, const SolveQuadratic& solve) { return Improvement(problem, solve).find(); }

} // namespace fernlicht
