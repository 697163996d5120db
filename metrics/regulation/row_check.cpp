#include "metrics/regulation/row_check.h"

#include "metrics/regulation/rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fernlicht {
namespace {

Direction moved(Direction d, Direction by) { return {d.h_deg + by.h_deg, d.v_deg + by.v_deg}; }

Extremes look_at(const RegulationRow& row, const ReceivedBeam& beam, Direction by, WantedExtremes wanted) {
    std::vector<Direction> places = row.places;
    for (Direction& place : places)
        place = moved(place, by);
    switch (row.kind) {
    case RowKind::segment:
        return extremes_on(beam, places[0], places[1], wanted);
    case RowKind::zone:
        return extremes_in(beam, places, wanted);
    case RowKind::brightest: {
        const Extremes e = extremes_in(beam, places, {false, true});
        return {e.highest, e.highest, e.highest.has_value()}; // a minimum is met where the file has light, a maximum is judged by it
    }
    case RowKind::point:
    case RowKind::sum:
        break;
    }
    Extreme total{0.0, places[0]};
    for (const Direction place : places) {
        const std::optional<double> cd = beam.at(place);
        if (!cd)
            return {{}, {}, false};
        total.cd += *cd;
    }
    return {total, total, true};
}

double margin_of_minimum(double found, double min) { return min > 0.0 ? found / min - 1.0 : std::numeric_limits<double>::infinity(); }
double margin_of_maximum(double found, double max) {
    if (std::isinf(max))
        return std::numeric_limits<double>::infinity();
    return max > 0.0 ? 1.0 - found / max : (found > 0.0 ? -std::numeric_limits<double>::infinity() : 0.0);
}

bool has_minimum(const Limits& limits) { return limits.min_cd > 0.0; }
bool has_maximum(const Limits& limits) { return !std::isinf(limits.max_cd); }

RowResult judged(const RegulationRow& row, const Limits& limits, const ReceivedBeam& beam, Direction by) {
    RowResult result;
    result.id = row.id;
    result.limits = limits;
    result.note = row.note;
    const Extremes found = look_at(row, beam, by, {has_minimum(limits), has_maximum(limits)});
    if (!found.lowest && !found.highest) {
        result.reason = "outside the file's angles";
        return result;
    }
    if (has_minimum(limits) && !found.all_covered) {
        result.reason = "reaches beyond the file's angles";
        return result;
    }
    if (!found.all_covered)
        result.note = "reaches beyond the file's angles; judged by what is inside" + (row.note.empty() ? "" : "; " + row.note);
    const double low = found.lowest ? margin_of_minimum(found.lowest->cd, limits.min_cd) : std::numeric_limits<double>::infinity();
    const double high = found.highest ? margin_of_maximum(found.highest->cd, limits.max_cd) : std::numeric_limits<double>::infinity();
    result.minimum_decides = low < high;
    const Extreme& deciding = result.minimum_decides || !found.highest ? *found.lowest : *found.highest;
    result.found = deciding.cd;
    result.where = deciding.where;
    result.margin = std::min(low, high);
    result.verdict = result.margin >= -margin_rounding ? RowVerdict::pass : RowVerdict::fail;
    return result;
}

/// Neither the brightest nor the darkest sample that a turn could bring to where the row failed would do. (A sum is judged by its total and
/// a maximum over every direction by what no turn changes.)
bool hopeless(const RegulationRow& row, const RowResult& failed, const ReceivedBeam& beam, const ReAim& turn) {
    if (row.kind == RowKind::brightest)
        return row.places == everywhere;
    ReceivedBeam::Bounds total;
    for (const Direction place : row.kind == RowKind::sum ? row.places : std::vector{failed.where}) {
        const ReceivedBeam::Bounds here = beam.bounds({place.h_deg - turn.right_deg, place.v_deg - turn.vertical_deg},
                                                      {place.h_deg + turn.left_deg, place.v_deg + turn.vertical_deg});
        total.low_cd += here.low_cd;
        total.high_cd += here.high_cd;
    }
    return failed.minimum_decides ? total.high_cd < failed.limits.min_cd : total.low_cd > failed.limits.max_cd;
}

/// Where a row fails at its place and may be measured beside it: the best of five rings of sixteen directions each.
RowResult judged_with_re_aim(const RegulationRow& row, const Limits& limits, const ReceivedBeam& beam, double within_deg) {
    RowResult best = judged(row, limits, beam, {});
    if (best.verdict != RowVerdict::fail || within_deg <= 0.0 || hopeless(row, best, beam, {within_deg, within_deg, within_deg}))
        return best;
    for (int ring = 1; ring <= 5; ++ring)
        for (int i = 0; i < 16; ++i) {
            const double r = within_deg * ring / 5.0, angle = 2.0 * std::numbers::pi * i / 16.0;
            const Direction by{r * std::cos(angle), r * std::sin(angle)};
            RowResult here = judged(row, limits, beam, by);
            if (here.verdict == RowVerdict::not_measured || here.margin <= best.margin)
                continue;
            best = here;
            best.re_aimed = by;
            if (best.verdict == RowVerdict::pass)
                return best; // the least turn that passes
        }
    return best;
}

class Checker {
  public:
    Checker(const Regulation& regulation, const std::vector<AimedLamp>& lamps) : regulation_(regulation) {
        for (const AimedLamp& lamp : lamps)
            beams_.emplace_back(std::vector{lamp}, regulation.receiver);
        beams_.emplace_back(lamps, regulation.receiver); // the last: what the regulation judges
    }

    bool asks(const RegulationRow& row) const { return row.scope != Scope::each_of_two || beams_.size() == 3; }

    RowResult check(const RegulationRow& row) const {
        if (row.scope == Scope::beam)
            return check(row, beams_.back());
        const std::size_t lamps = beams_.size() - 1;
        RowResult chosen;
        for (std::size_t i = 0; i < lamps; ++i) {
            RowResult one = check(row, beams_[i]);
            if (lamps > 1)
                one.lamps = {static_cast<int>(i)};
            const bool better = one.verdict != RowVerdict::not_measured && one.margin > chosen.margin;
            const bool worse = one.verdict == RowVerdict::not_measured || one.margin < chosen.margin;
            if (i == 0 || (row.scope == Scope::either_side ? better || chosen.verdict == RowVerdict::not_measured
                                                           : worse && chosen.verdict != RowVerdict::not_measured))
                chosen = one;
        }
        return chosen;
    }

  private:
    RowResult check(const RegulationRow& row, const ReceivedBeam& beam) const {
        Limits limits = row.limits;
        std::string of;
        if (!row.ratio_of.empty()) {
            const auto other = std::find_if(regulation_.rows.begin(), regulation_.rows.end(),
                                            [&](const RegulationRow& r) { return r.id == row.ratio_of && r.scope == Scope::beam; });
            const Extremes value = look_at(*other, beam, {}, {false, true});
            if (!value.highest || value.highest->cd <= 0.0) {
                RowResult result;
                result.id = row.id;
                result.reason = row.ratio_of + (value.highest ? " is 0 cd" : " is outside the file's angles");
                return result;
            }
            (row.ratio_is_minimum ? limits.min_cd : limits.max_cd) = row.ratio * value.highest->cd;
            of = std::to_string(row.ratio).substr(0, 3) + " x " + row.ratio_of;
        }
        RowResult result = judged_with_re_aim(row, limits, beam, regulation_.row_re_aim_deg);
        if (!of.empty())
            result.note = of + (result.note.empty() ? "" : "; " + result.note);
        return result;
    }

    const Regulation& regulation_;
    std::vector<ReceivedBeam> beams_;
};

} // namespace

std::vector<RowResult> check_rows(const Regulation& regulation, const std::vector<AimedLamp>& lamps, const std::vector<std::string>& only) {
    const Checker checker(regulation, lamps);
    std::vector<RowResult> results;
    for (const RegulationRow& row : regulation.rows)
        if (checker.asks(row) && (only.empty() || std::find(only.begin(), only.end(), row.id) != only.end()))
            results.emplace_back(checker.check(row)).sureness = regulation.sureness_of(row);
    return results;
}

bool out_of_reach(const Regulation& regulation, const std::vector<AimedLamp>& lamps, const RowResult& failed, const ReAim& allowance) {
    const auto row =
        std::find_if(regulation.rows.begin(), regulation.rows.end(), [&](const RegulationRow& r) { return r.id == failed.id; });
    if (row->scope != Scope::beam || failed.verdict != RowVerdict::fail || !row->ratio_of.empty())
        return false;
    const double own = regulation.row_re_aim_deg;
    return hopeless(*row, failed, ReceivedBeam(lamps, regulation.receiver),
                    {allowance.left_deg + own, allowance.right_deg + own, allowance.vertical_deg + own});
}

RowVerdict verdict_of(const std::vector<RowResult>& rows) {
    const auto any = [&](RowVerdict verdict) {
        return std::any_of(rows.begin(), rows.end(), [&](const RowResult& row) { return row.verdict == verdict; });
    };
    return any(RowVerdict::fail) ? RowVerdict::fail : any(RowVerdict::not_measured) ? RowVerdict::not_measured : RowVerdict::pass;
}

} // namespace fernlicht
