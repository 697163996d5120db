#include "metrics/regulation/regulation_check.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fernlicht {
namespace {

RowResult about_cut_off(std::string id, std::optional<double> found, Direction where, Limits limits, std::string unit,
                        const std::string& reason) {
    RowResult row;
    row.id = std::move(id);
    row.limits = limits;
    row.unit = std::move(unit);
    row.where = where;
    if (!found) {
        row.reason = reason;
        return row;
    }
    row.found = *found;
    const double low = limits.min_cd > 0.0 ? *found / limits.min_cd - 1.0 : std::numeric_limits<double>::infinity();
    const double high = std::isinf(limits.max_cd) ? std::numeric_limits<double>::infinity() : 1.0 - *found / limits.max_cd;
    row.margin = std::min(low, high);
    row.minimum_decides = low < high;
    row.verdict = row.margin >= 0.0 ? RowVerdict::pass : RowVerdict::fail;
    return row;
}

std::string first_reason(const CutOffFigures& c) {
    for (const CutOffScan* scan : {&c.level, &c.level_inner, &c.level_outer})
        if (!scan->reason.empty())
            return scan->reason;
    return {};
}

/// The cut-off's own requirements, of a lamp aimed by it; not measured where another aim was asked for than the regulation's.
void add_cut_off_rows(std::vector<RowResult>& rows, const Aim& aim, bool asked_otherwise) {
    const auto v_of = [](const CutOffScan& scan) { return scan.inflection_deg.value_or(0.0); };
    if (aim.rule == AimRule::cut_off || aim.rule == AimRule::cut_off_by_line || aim.rule == AimRule::elbow) {
        const CutOffFigures& c = *aim.cut_off;
        rows.push_back(about_cut_off("cut-off sharpness G", c.level.sharpness, {-2.5, v_of(c.level)}, {0.13, 0.40}, "", c.level.reason));
        rows.push_back(about_cut_off("cut-off linearity", c.linearity_deg, {-2.5, v_of(c.level)}, {0.0, 0.2}, "deg", first_reason(c)));
    } else if ((aim.rule == AimRule::vol || aim.rule == AimRule::vor) && aim.cut_off) {
        const CutOffFigures& c = *aim.cut_off;
        const bool left = aim.rule == AimRule::vol;
        const CutOffScan& middle = left ? c.level : c.rise[1];
        const CutOffScan& inner = left ? c.level_inner : c.rise[0];
        const CutOffScan& outer = left ? c.level_outer : c.rise[2];
        std::optional<double> apart;
        if (middle.inflection_deg && inner.inflection_deg && outer.inflection_deg)
            apart = std::max(std::abs(*inner.inflection_deg - *middle.inflection_deg),
                             std::abs(*outer.inflection_deg - *middle.inflection_deg));
        const Direction where{middle.at_deg, v_of(middle)};
        rows.push_back(about_cut_off("cut-off gradient G", middle.sharpness, where, {0.13, std::numeric_limits<double>::infinity()}, "",
                                     middle.reason));
        rows.push_back(about_cut_off("cut-off level over 2 deg", apart, where, {0.0, 0.2}, "deg",
                                     middle.inflection_deg ? (inner.reason.empty() ? outer.reason : inner.reason) : middle.reason));
    } else if (aim.rule == AimRule::vol || aim.rule == AimRule::vor)
        rows.push_back(about_cut_off("cut-off gradient G", std::nullopt, {}, {0.13, std::numeric_limits<double>::infinity()}, "", aim.how));
    else if (asked_otherwise) {
        constexpr const char* reason = "no cut-off was looked for, as --aim-rule asks";
        rows.push_back(about_cut_off("cut-off sharpness G", std::nullopt, {}, {0.13, 0.40}, "", reason));
        rows.push_back(about_cut_off("cut-off linearity", std::nullopt, {}, {0.0, 0.2}, "deg", reason));
    }
}

/// Which of two aims serves better.
struct Rank {
    std::ptrdiff_t failed = 0;
    double smallest_margin = std::numeric_limits<double>::infinity();
    bool better_than(const Rank& other) const {
        return failed != other.failed ? failed < other.failed : smallest_margin > other.smallest_margin;
    }
};

Rank rank_of(const std::vector<RowResult>& rows) {
    Rank rank;
    for (const RowResult& row : rows) {
        rank.failed += row.verdict != RowVerdict::pass;
        if (row.verdict != RowVerdict::not_measured)
            rank.smallest_margin = std::min(rank.smallest_margin, row.margin);
    }
    return rank;
}

class Examination {
  public:
    Examination(const Regulation& regulation, const std::vector<CandelaTable>& lamps, const std::vector<Aim>& aims)
        : regulation_(regulation), lamps_(lamps), aims_(aims) {}

    std::vector<RowResult> rows_at(Direction turn, const std::vector<std::string>& only = {}) const {
        return check_rows(regulation_, aimed(turn), only);
    }

    /// The best aim within the allowance, for a lamp with these rows as first aimed. It stays where no other aim leaves fewer rows failed.
    Direction re_aim(const std::vector<RowResult>& rows) const {
        const ReAim& allowed = regulation_.re_aim;
        Direction best;
        const Rank first_rank = rank_of(rows);
        Rank best_rank = first_rank;
        std::vector<std::string> failed; // and within reach
        std::ptrdiff_t lost = 0;
        for (const RowResult& row : rows) {
            if (row.verdict == RowVerdict::pass)
                continue;
            if (row.verdict == RowVerdict::fail && out_of_reach(regulation_, aimed({}), row, allowed))
                ++lost;
            else
                failed.push_back(row.id);
        }
        if (failed.empty())
            return best;
        const auto try_at = [&](Direction turn) {
            const double slack = 1e-9;
            if (turn.h_deg < -allowed.left_deg - slack || turn.h_deg > allowed.right_deg + slack ||
                std::abs(turn.v_deg) > allowed.vertical_deg + slack)
                return;
            // The rows that failed, first: most turns help none of them.
            const std::ptrdiff_t still = lost + rank_of(rows_at(turn, failed)).failed;
            if (still > best_rank.failed || still == first_rank.failed)
                return;
            if (const Rank rank = rank_of(rows_at(turn)); rank.better_than(best_rank)) {
                best_rank = rank;
                best = turn;
            }
        };
        constexpr double step = 0.125;
        for (double v = -allowed.vertical_deg; v <= allowed.vertical_deg + 1e-9; v += step)
            for (double h = -allowed.left_deg; h <= allowed.right_deg + 1e-9; h += step)
                try_at({h, v});
        for (const double s : {step / 2.0, step / 4.0}) {
            const Direction middle = best;
            for (const double v : {-s, 0.0, s})
                for (const double h : {-s, 0.0, s})
                    try_at({middle.h_deg + h, middle.v_deg + v});
        }
        return best;
    }

  private:
    std::vector<AimedLamp> aimed(Direction turn) const {
        std::vector<AimedLamp> all;
        for (std::size_t i = 0; i < lamps_.size(); ++i)
            all.push_back({&lamps_[i], {aims_[i].turned.h_deg + turn.h_deg, aims_[i].turned.v_deg + turn.v_deg}});
        return all;
    }

    const Regulation& regulation_;
    const std::vector<CandelaTable>& lamps_;
    const std::vector<Aim>& aims_;
};

RegulationCheck checked(const Regulation& regulation, const std::vector<CandelaTable>& lamps, const CheckOptions& options,
                        const CandelaTable* aim_by) {
    RegulationCheck check;
    AimRule rule = options.aim && *options.aim != AimRule::automatic ? *options.aim : regulation.aim; // automatic: its own way
    if (aim_by) {
        rule = rule_of_aim_by(rule);
        check.aims.assign(lamps.size(), aim_of(*aim_by, rule));
        for (Aim& aim : check.aims)
            aim.how = "by the passing beam: " + aim.how;
    } else
        for (const CandelaTable& lamp : lamps)
            check.aims.push_back(aim_of(lamp, rule));
    const Examination examination(regulation, lamps, check.aims);
    std::vector<RowResult> rows = examination.rows_at({});
    if (options.re_aim && regulation.re_aim.any() && !options.aim_by && rule != AimRule::as_is && verdict_of(rows) == RowVerdict::fail) {
        check.re_aimed = examination.re_aim(rows);
        check.was_re_aimed = check.re_aimed != Direction{};
        rows = examination.rows_at(check.re_aimed);
    }
    if (!aim_by)
        for (const Aim& aim : check.aims)
            add_cut_off_rows(check.rows, aim, regulation.aim == AimRule::automatic && rule != AimRule::automatic);
    std::vector<RowResult> all_as_filed = check.rows;
    check.rows.insert(check.rows.end(), rows.begin(), rows.end());
    check.verdict = verdict_of(check.rows);
    if (!options.as_filed)
        return check;
    check.verdict_as_filed = check.verdict;
    if (check.was_re_aimed || std::ranges::any_of(check.aims, [](const Aim& aim) { return aim.turned != Direction{}; })) {
        const std::vector<Aim> not_turned(lamps.size());
        const std::vector<RowResult> filed = Examination(regulation, lamps, not_turned).rows_at({});
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (filed[i].verdict != rows[i].verdict)
                check.as_filed.push_back(filed[i]);
        all_as_filed.insert(all_as_filed.end(), filed.begin(), filed.end());
        check.verdict_as_filed = verdict_of(all_as_filed);
    }
    return check;
}

double mirrored_angle(double deg) { return 0.0 - deg; } // not -deg: no negative zero in reports

void mirror(RegulationCheck& check) {
    const auto mirror_row = [](RowResult& row) {
        row.id = mirrored_name(row.id);
        row.note = mirrored_name(row.note);
        row.reason = mirrored_name(row.reason);
        row.where.h_deg = mirrored_angle(row.where.h_deg);
        row.re_aimed.h_deg = mirrored_angle(row.re_aimed.h_deg);
    };
    std::ranges::for_each(check.rows, mirror_row);
    std::ranges::for_each(check.as_filed, mirror_row);
    check.re_aimed.h_deg = mirrored_angle(check.re_aimed.h_deg);
    for (Aim& aim : check.aims) {
        aim.turned.h_deg = mirrored_angle(aim.turned.h_deg);
        aim.residual.h_deg = mirrored_angle(aim.residual.h_deg);
        aim.how = mirrored_name(aim.how);
    }
}

} // namespace

AimRule rule_of_aim_by(AimRule asked) { return asked == AimRule::as_is || asked == AimRule::maximum ? AimRule::automatic : asked; }

std::string mirrored_name(std::string name) {
    for (char& c : name)
        c = c == 'L' ? 'R' : c == 'R' ? 'L' : c;
    std::string out;
    for (std::size_t at = 0; at < name.size();) {
        const bool left = name.compare(at, 4, "left") == 0, right = name.compare(at, 5, "right") == 0;
        out += left ? "right" : right ? "left" : name.substr(at, 1);
        at += left ? 4 : right ? 5 : 1;
    }
    return out;
}

RegulationCheck check_regulation(const Regulation& regulation, const std::vector<CandelaTable>& lamps, const CheckOptions& options) {
    if (!options.left_hand_traffic)
        return checked(regulation, lamps, options, options.aim_by);
    if (!regulation.mirrors)
        throw InputError({{}, 0, 0, "--left-hand-traffic"}, regulation.id + ", which has one form for all traffic",
                         "another regulation or no flag");
    std::vector<CandelaTable> mirror_images;
    for (const CandelaTable& lamp : lamps)
        mirror_images.push_back(mirrored(lamp));
    const CandelaTable aim_by = options.aim_by ? mirrored(*options.aim_by) : CandelaTable{};
    RegulationCheck check = checked(regulation, mirror_images, options, options.aim_by ? &aim_by : nullptr);
    mirror(check);
    check.left_hand_traffic = true;
    return check;
}

} // namespace fernlicht
