// Light on a photometer over an approach, against limits by distance: as FMVSS 108 S14.9.3.12.2 judges adaptive driving beams on the road,
// each rule of it only where a rating asks for it.
#pragma once

#include "scenarios/ratings/rating.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

struct LightSample {
    int tick = 0;
    double time_s = 0.0, distance_m = 0.0;
    double lx = 0.0;
    double pitch_deg = 0.0; ///< of the car's body, nose up positive
    bool left_out = false;
};
/// By time; the car comes nearer.
using LightApproach = std::vector<LightSample>;

/// told: there is no limit.
enum class RatingVerdict { within, exceeded, not_measured, told };
inline constexpr const char* rating_verdict_words[] = {"within", "exceeded", "not_measured", "told"};

struct RangeJudgement {
    LimitRange range;                 ///< cut to the distances measured; limits at its ends as cut
    std::size_t samples = 0;          ///< that count
    std::size_t left_out = 0;         ///< by pitch
    std::size_t excused = 0;          ///< above the limit for a moment
    std::optional<LightSample> worst; ///< of those that count the nearest to its limit or the farthest above; without a limit the brightest
    std::optional<double> lx, limit_lx; ///< of it, rounded as asked; nullopt: none, without a limit
    RatingVerdict verdict = RatingVerdict::not_measured;
    std::string why; ///< not measured

    /// Share of the limit that is left; negative above it. Of a range with limit and worst sample.
    double margin() const { return (*limit_lx - *lx) / *limit_lx; }
};

/// To a multiple of `step` (> 0), halves to the even one, as ASTM E29 (6.4) rounds. What misses a half by 1e-9 of a step is one.
double rounded_to(double value, double step);

/// Leaves out samples whose pitch is farther off the mean of those from `from_m` to `to_m` than so much. Gives that mean; nullopt, and
/// leaves out none, where no sample lies there.
std::optional<double> leave_out_pitching(LightApproach& approach, double from_m, double to_m, double most_off_deg);

/// The ranges of a curve that lie between two distances, each from its beginning to below its end, the last one to its end. One that the
/// approach does not pass from end to end, or that has no sample left, is not measured.
std::vector<RangeJudgement> judge_light(const LightApproach& approach, const LimitCurve& limits, double from_m, double to_m,
                                        const JudgingRules& rules);

/// exceeded before not_measured before within before told.
RatingVerdict worst_of(RatingVerdict a, RatingVerdict b);

} // namespace fernlicht
