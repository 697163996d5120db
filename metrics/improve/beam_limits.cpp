#include "metrics/improve/beam_limits.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double lattice_h_deg = 0.25, lattice_v_deg = 0.125;
constexpr double most_aim_h_deg = 0.1, most_aim_v_deg = 0.05; ///< as procedures find it again: what moves a cut-off farther is another lamp
constexpr double kept_within = 0.005;                         ///< of the limit: with every change the aim moves a little
constexpr double inner_share = 0.002; ///< limits are held by so much more: places between those that are held, and rounding

LinearForm difference_of(const LinearForm& a, double by_a, const LinearForm& b, double by_b, std::size_t variables) {
    std::vector<double> sums(variables);
    for (const auto& [variable, factor] : a)
        sums[variable] += by_a * factor;
    for (const auto& [variable, factor] : b)
        sums[variable] -= by_b * factor;
    return sparse(sums);
}

/// Even-odd rule.
bool is_within(const std::vector<Direction>& corners, Direction at) {
    bool within = false;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
        const Direction &a = corners[i], &b = corners[j];
        if ((a.v_deg > at.v_deg) != (b.v_deg > at.v_deg) &&
            at.h_deg < a.h_deg + (b.h_deg - a.h_deg) * (at.v_deg - a.v_deg) / (b.v_deg - a.v_deg))
            within = !within;
    }
    return within;
}

/// Of a row with a zone or a segment: its corners, and a lattice in what of it lies within 25 degrees of the axis.
std::vector<Direction> lattice_of(const RegulationRow& row) {
    std::vector<Direction> places = row.places;
    if (row.kind == RowKind::segment) {
        const Direction from = row.places[0], to = row.places[1];
        const int count = static_cast<int>(std::ceil(std::hypot(to.h_deg - from.h_deg, to.v_deg - from.v_deg) / lattice_v_deg));
        for (int i = 1; i < count; ++i)
            places.push_back({std::lerp(from.h_deg, to.h_deg, double(i) / count), std::lerp(from.v_deg, to.v_deg, double(i) / count)});
    } else
        for (double v = -25.0; v <= 25.0; v += lattice_v_deg)
            for (double h = -25.0; h <= 25.0; h += lattice_h_deg)
                if (is_within(row.places, {h, v}))
                    places.push_back({h, v});
    return places;
}

} // namespace

bool StepFrom::may_leave(const LinearForm& form, double low, double high) const {
    double sum = 0.0, room = 0.0;
    for (const auto& [variable, factor] : form) {
        sum += factor * x[variable];
        room += std::abs(factor) * step;
    }
    return room > 0.0 && (sum - room < low || sum + room > high);
}

std::vector<LimitRow> table_rows(const BeamBasis& basis, const TableLimits& limits, const StepFrom& from) {
    const CandelaTable& table = basis.table();
    std::vector<LimitRow> rows;
    for (std::size_t i = 0; i < table.cd.size(); ++i) {
        const double most =
            std::min(limits.change_share ? *limits.change_share * table.cd[i] : unbounded, limits.change_cd.value_or(unbounded)) /
            basis.weight_cd(i);
        const double least = -std::min(most, table.cd[i] / basis.weight_cd(i));
        LinearForm form = basis.at_sample(i);
        if (from.may_leave(form, least, most))
            rows.push_back({limits.change_share || limits.change_cd ? "the most that a sample may change" : "no light less than none",
                            {std::move(form), least, most},
                            0.01 * std::min(most, -least)});
    }
    if (limits.flux_share) {
        std::vector<double> per_relative(basis.size());
        const double flux = flux_lm(table);
        for (std::size_t j = 0; j < per_relative.size(); ++j) {
            std::vector<double> one(basis.size());
            one[j] = 1.0;
            per_relative[j] = 100.0 * (flux_lm(basis.changed(one)) - flux) / flux;
        }
        rows.push_back({"flux", {sparse(per_relative), -unbounded, 100.0 * *limits.flux_share}, 1.0, true});
    }
    if (limits.steepness) {
        const std::size_t columns = table.h_deg.size();
        const auto each_pair = [&](const auto& take) {
            for (std::size_t i = 0; i < table.cd.size(); ++i) {
                if (i % columns + 1 < columns)
                    take(i, i + 1, table.h_deg[i % columns + 1] - table.h_deg[i % columns]);
                if (i + columns < table.cd.size())
                    take(i, i + columns, table.v_deg[i / columns + 1] - table.v_deg[i / columns]);
            }
        };
        double steepest = 0.0;
        each_pair(
            [&](std::size_t a, std::size_t b, double deg) { steepest = std::max(steepest, std::abs(table.cd[b] - table.cd[a]) / deg); });
        const double most = *limits.steepness * steepest;
        each_pair([&](std::size_t a, std::size_t b, double deg) {
            const LinearForm of_a = basis.at_sample(a), of_b = basis.at_sample(b);
            if (of_a.empty() && of_b.empty())
                return;
            LinearForm form =
                difference_of(of_b, basis.weight_cd(b) / deg / steepest, of_a, basis.weight_cd(a) / deg / steepest, basis.size());
            const double slope = (table.cd[b] - table.cd[a]) / deg / steepest, bound = most / steepest;
            if (from.may_leave(form, -bound - slope, bound - slope))
                rows.push_back({"the steepest place", {std::move(form), -bound - slope, bound - slope}, 0.01 * bound});
        });
    }
    return rows;
}

RegulationRows::RegulationRows(const Regulation& regulation, bool left_hand_traffic, const CandelaTable& first,
                               std::vector<std::string> kept)
    : regulation_(regulation), left_hand_traffic_(left_hand_traffic), kept_(std::move(kept)) {
    for (const RegulationRow& row : regulation.rows)
        if (row.scope != Scope::each_of_two) {
            asked_.push_back(&row);
            const bool by_lattice = row.kind == RowKind::segment || row.kind == RowKind::zone || row.kind == RowKind::brightest;
            places_.push_back(by_lattice ? lattice_of(row) : row.places);
        }
    before_ = check(first);
    for (const std::string& id : kept_)
        if (std::ranges::find(before_.rows, id, &RowResult::id) == before_.rows.end())
            throw std::invalid_argument(id);
}

bool RegulationRows::is_kept(const std::string& id) const { return std::ranges::find(kept_, id) != kept_.end(); }

const RowResult& RegulationRows::result_of(const RegulationCheck& check, std::size_t row) const {
    return check.rows[check.rows.size() - asked_.size() + row]; // behind those about the cut-off
}

RegulationCheck RegulationRows::check(const CandelaTable& table) {
    CheckOptions options;
    options.left_hand_traffic = left_hand_traffic_;
    options.re_aim = before_.rows.empty() || before_.was_re_aimed;
    RegulationCheck check = check_regulation(regulation_, {table}, options);
    for (std::size_t i = 0; i < asked_.size(); ++i) {
        const RowResult& found = result_of(check, i);
        const double sign = left_hand_traffic_ ? -1.0 : 1.0;
        const Direction worst{sign * (found.where.h_deg - found.re_aimed.h_deg), found.where.v_deg - found.re_aimed.v_deg};
        const bool by_lattice = asked_[i]->kind != RowKind::point && asked_[i]->kind != RowKind::sum;
        if (by_lattice && found.verdict != RowVerdict::not_measured && std::ranges::find(places_[i], worst) == places_[i].end())
            places_[i].push_back(worst);
    }
    return check;
}

std::vector<LimitRow> RegulationRows::rows(const BeamBasis& basis, const CandelaTable& table, const RegulationCheck& check,
                                           const StepFrom& from) const {
    std::vector<LimitRow> rows;
    const double sign = left_hand_traffic_ ? -1.0 : 1.0;
    const Direction aim = check.aims.front().turned;
    const Direction turned{aim.h_deg + check.re_aimed.h_deg, aim.v_deg + check.re_aimed.v_deg};
    const auto of_table = [&](Direction place) { return Direction{sign * place.h_deg - turned.h_deg, place.v_deg - turned.v_deg}; };
    for (std::size_t i = 0; i < asked_.size(); ++i) {
        const RowResult &now = result_of(check, i), &first = result_of(before_, i);
        if (now.verdict == RowVerdict::not_measured)
            continue;
        Limits limits{now.limits.min_cd * (1.0 + inner_share), now.limits.max_cd * (1.0 - inner_share)};
        if (first.verdict != RowVerdict::not_measured && (first.margin < inner_share || is_kept(now.id)))
            (first.minimum_decides ? limits.min_cd : limits.max_cd) = first.found;
        const auto add = [&](const std::vector<Direction>& places, bool minimum, bool maximum) {
            std::vector<SampleWeight> weights;
            double cd = 0.0;
            for (const Direction place : places)
                for (const SampleWeight& one : received_weights(table, regulation_.receiver, of_table(place))) {
                    weights.push_back(one);
                    cd += one.weight * table.cd[one.sample];
                }
            const LinearForm form = basis.form(weights);
            const double here = value_of(form, from.x); // cd of the change so far
            const auto add_bound = [&](double limit_cd, bool is_minimum) {
                LimitRow limit{now.id, {form}, 1.0, true};
                for (auto& [variable, factor] : limit.row.form)
                    factor *= 100.0 / limit_cd;
                (is_minimum ? limit.row.low : limit.row.high) = 100.0 * (limit_cd - cd + here) / limit_cd;
                if (from.may_leave(limit.row.form, limit.row.low, limit.row.high))
                    rows.push_back(std::move(limit));
            };
            if (minimum && limits.min_cd > 0.0)
                add_bound(limits.min_cd, true);
            if (maximum && limits.max_cd > 0.0 && std::isfinite(limits.max_cd))
                add_bound(limits.max_cd, false);
        };
        std::vector<Direction> places = places_[i];
        for (Direction& place : places)
            place = {place.h_deg + sign * now.re_aimed.h_deg, place.v_deg + now.re_aimed.v_deg};
        if (asked_[i]->kind == RowKind::point || asked_[i]->kind == RowKind::sum)
            add(places, true, true);
        else
            for (const Direction place : places)
                if (basis.reaches(of_table(place), regulation_.receiver.size_deg))
                    add({place}, asked_[i]->kind != RowKind::brightest, true);
        if (asked_[i]->kind == RowKind::brightest)
            add({{sign * now.where.h_deg, now.where.v_deg}}, true, false);
    }
    return rows;
}

RegulationRows::Missed RegulationRows::missed_by(const RegulationCheck& check) const {
    Missed most;
    const Direction aim = check.aims.front().turned, first_aim = before_.aims.front().turned;
    if (std::abs(aim.h_deg - first_aim.h_deg) > most_aim_h_deg || std::abs(aim.v_deg - first_aim.v_deg) > most_aim_v_deg)
        return {1.0, "the aim by the cut-off"};
    for (const RowResult& first : before_.rows) {
        if (first.verdict == RowVerdict::not_measured)
            continue;
        const auto now = std::ranges::find(check.rows, first.id, &RowResult::id); // a cut-off that is none any more has no rows
        const bool measured = now != check.rows.end() && now->verdict != RowVerdict::not_measured;
        const double by = measured ? (is_kept(first.id) ? first.margin - kept_within : std::min(0.0, first.margin)) - now->margin : 1.0;
        if (by > most.by)
            most = {by, first.id};
    }
    return most;
}

} // namespace fernlicht
