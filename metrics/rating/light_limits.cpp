#include "metrics/rating/light_limits.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

double as_rounded(double lx, const JudgingRules& rules) { return rules.round_lx ? rounded_to(lx, *rules.round_lx) : lx; }

bool is_over(const LightSample& sample, const LimitRange& range, const JudgingRules& rules) {
    return as_rounded(sample.lx, rules) > as_rounded(range.limit_lx(sample.distance_m), rules);
}

/// The range with its ends between the two distances, limits where it is cut.
LimitRange cut_to(const LimitRange& range, double from_m, double to_m) {
    LimitRange cut = range;
    cut.from_m = std::max(range.from_m, from_m);
    cut.to_m = std::min(range.to_m, to_m);
    if (range.at_most_lx_far) {
        cut.at_most_lx = range.limit_lx(cut.from_m);
        cut.at_most_lx_far = range.limit_lx(cut.to_m);
    }
    return cut;
}

/// Takes out of `counting` each row of samples above the limit that is short and low enough. Gives how many.
std::size_t excuse_moments(std::vector<const LightSample*>& counting, const LimitRange& range, const JudgingRules& rules) {
    const MomentaryExcess& excess = rules.excess;
    std::vector<const LightSample*> left;
    std::size_t excused = 0;
    for (std::size_t i = 0; i < counting.size();) {
        std::size_t end = i;
        bool low = true;
        for (; end < counting.size() && is_over(*counting[end], range, rules); ++end)
            low = low && counting[end]->lx <= (1.0 + 0.01 * excess.percent) * range.limit_lx(counting[end]->distance_m);
        if (end == i) {
            left.push_back(counting[i++]);
            continue;
        }
        const LightSample& first = *counting[i];
        const LightSample& after = *counting[std::min(end, counting.size() - 1)]; // until it is known to be over
        const bool is_short =
            after.time_s - first.time_s <= excess.for_s + 1e-9 || first.distance_m - after.distance_m <= excess.for_m + 1e-9;
        if (low && is_short)
            excused += end - i;
        else
            left.insert(left.end(), counting.begin() + static_cast<std::ptrdiff_t>(i), counting.begin() + static_cast<std::ptrdiff_t>(end));
        i = end;
    }
    counting = std::move(left);
    return excused;
}

void judge_range(RangeJudgement& judged, std::vector<const LightSample*> counting, const JudgingRules& rules) {
    const LimitRange& range = judged.range;
    judged.samples = counting.size();
    if (counting.empty()) {
        judged.why = judged.left_out > 0 ? "every moment there is left out for its pitch" : "no moment lies there";
        return;
    }
    if (!range.at_most_lx) {
        judged.worst = **std::ranges::max_element(counting, {}, [](const LightSample* sample) { return sample->lx; });
        judged.lx = as_rounded(judged.worst->lx, rules);
        judged.verdict = RatingVerdict::told;
        return;
    }
    std::vector<const LightSample*> left = counting;
    if (rules.excess.allowed)
        judged.excused = excuse_moments(left, range, rules);
    if (left.empty())
        left = counting; // all of it was a moment's excess: within, and told
    // Rounding may put the farthest above its limit within, and another above.
    const auto over = [&](const LightSample* sample) { return is_over(*sample, range, rules); };
    if (std::ranges::any_of(left, over))
        std::erase_if(left, [&](const LightSample* sample) { return !over(sample); });
    judged.worst =
        **std::ranges::max_element(left, {}, [&](const LightSample* sample) { return sample->lx / range.limit_lx(sample->distance_m); });
    judged.lx = as_rounded(judged.worst->lx, rules);
    judged.limit_lx = as_rounded(range.limit_lx(judged.worst->distance_m), rules);
    judged.verdict = *judged.lx > *judged.limit_lx && judged.excused < counting.size() ? RatingVerdict::exceeded : RatingVerdict::within;
}

} // namespace

double rounded_to(double value, double step) {
    const double steps = value / step, below = std::floor(steps), rest = steps - below;
    const bool is_half = std::abs(rest - 0.5) < 1e-9;
    const double whole = is_half ? 2.0 * std::round(0.5 * (below + 0.5)) : std::round(steps);
    // 3 steps of 0.1 are 0.3 rather than 0.30000000000000004
    const double per_one = std::round(1.0 / step);
    return std::abs(per_one * step - 1.0) < 1e-12 ? whole / per_one : whole * step;
}

std::optional<double> leave_out_pitching(LightApproach& approach, double from_m, double to_m, double most_off_deg) {
    double sum = 0.0, count = 0.0;
    for (const LightSample& sample : approach)
        if (sample.distance_m >= from_m && sample.distance_m <= to_m)
            sum += sample.pitch_deg, ++count;
    if (count == 0.0)
        return std::nullopt;
    const double mean = sum / count;
    for (LightSample& sample : approach)
        sample.left_out = std::abs(sample.pitch_deg - mean) > most_off_deg;
    return mean;
}

std::vector<RangeJudgement> judge_light(const LightApproach& approach, const LimitCurve& limits, double from_m, double to_m,
                                        const JudgingRules& rules) {
    std::vector<RangeJudgement> all;
    for (const LimitRange& range : limits.ranges)
        if (range.from_m < to_m && range.to_m > from_m)
            all.emplace_back().range = cut_to(range, from_m, to_m);
    const auto [nearest, farthest] = std::ranges::minmax_element(approach, {}, &LightSample::distance_m);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const LimitRange& range = all[i].range;
        const bool has_end = i + 1 == all.size() || all[i + 1].range.from_m > range.to_m;
        std::vector<const LightSample*> counting;
        for (const LightSample& sample : approach) {
            if (sample.distance_m < range.from_m || sample.distance_m > range.to_m || (sample.distance_m == range.to_m && !has_end))
                continue;
            if (sample.left_out)
                ++all[i].left_out;
            else
                counting.push_back(&sample);
        }
        if (approach.empty())
            all[i].why = "no moment of the approach is there";
        else if (nearest->distance_m > range.from_m || farthest->distance_m < range.to_m)
            all[i].why = fmt::format("the drive has light from {:.1f} to {:.1f} m only", nearest->distance_m, farthest->distance_m);
        else
            judge_range(all[i], std::move(counting), rules);
    }
    return all;
}

RatingVerdict worst_of(RatingVerdict a, RatingVerdict b) {
    using enum RatingVerdict;
    for (const RatingVerdict verdict : {exceeded, not_measured, within})
        if (a == verdict || b == verdict)
            return verdict;
    return told;
}

} // namespace fernlicht
