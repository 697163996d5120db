// What a set of lamps does to one eye: in one moment, and followed over the moments of a drive.
#pragma once

#include "metrics/folds/seeing_series.h"
#include "metrics/glare/glare.h"
#include "metrics/readings/readings.h"
#include "metrics/road/lit_line.h"

#include <span>

namespace fernlicht {

/// What a set of sources does to one eye.
struct GlareFigures {
    Value facing_lx = 0.0; ///< sum of I / d^2
    Value eye_lx = 0.0;    ///< across the line of sight
    Value veiling_cdm2, increment_percent, de_boer;
    Value adaptation_cdm2; ///< not measured: neither are the two that need it
};
GlareFigures glare_figures(const std::vector<GlareSource>& sources, double facing_lx, const Value& adaptation_cdm2,
                           const GlareParameters& parameters);
/// All of them not measured for this reason, but what the eye is adapted to.
GlareFigures no_figures(const std::string& why, const Value& adaptation_cdm2);

/// One figure of an eye over the moments.
struct FollowedFigure {
    Approach approach;
    std::vector<std::string> why_not; ///< by moment: why it was not measured; "" where it was, and where the moment does not count

    void add(const Moment& moment, double to_go_m, const Value& value, bool counts = true);
    /// Why some moment that counts lacks it; "" where none does.
    std::string missing() const;
    /// With distances to go: largest, or smallest, from `near_m` to `far_m`, both ends among them. Not measured where the drive does not
    /// pass all of that, or a moment of it that counts lacks it; of none that counts, for the reason `why_none`.
    Value extreme_between(double near_m, double far_m, bool of_largest, const std::string& why_none) const;
    /// The quantile (type 7, `share` from 0 to 1) of the moments in that range, which are equally spaced in time; otherwise as
    /// extreme_between(), and not measured where no moment lies there.
    Value quantile_between(double near_m, double far_m, double share, const std::string& why_none) const;

    /// Of moments, every second one from `first` (0 or 1) on.
    FollowedFigure every_second(std::size_t first) const;
    /// The moments from `near_m` to `far_m`, and the one before and the one behind.
    Approach around(double near_m, double far_m) const;
    Approach within(double near_m, double far_m) const; ///< those from `near_m` to `far_m` alone

  private:
    std::string unknown_between(double near_m, double far_m, const std::string& why_none) const; ///< why; "" where it is known
};

/// Figures of one eye over the moments.
struct GlareFollowed {
    std::vector<int> ticks;
    FollowedFigure facing, eye_lx, veiling, increment, de_boer;
    std::vector<Value> adaptation;
    std::vector<std::vector<double>> theta_deg; ///< by lamp

    /// `theta_deg` of the first `lamps` sources are followed.
    void add(const Moment& moment, double to_go_m, const std::vector<GlareSource>& sources, std::size_t lamps, const GlareFigures& figures);
    /// Figures under the eye's key, first over each range of distances to go between one edge of `ranges_m` and the next, then over the
    /// drive: largest illuminances, veiling luminance and threshold increment, smallest rating, in ranges with median and 95th (of the
    /// rating 5th) percentile over the moments, over the drive where the eye has no name: such are no approach. Times and metres beyond the
    /// limits; what the eye is adapted to, median. Moments whose adaptation is not measured do not count for the threshold increment and
    /// the rating.
    void say(Readings& readings, const ReadingKey& eye, const std::string& where, const std::string& why_none,
             const GlareParameters& parameters, std::span<const double> ranges_m = {}) const;
    SeeingSeries series(const ReadingKey& eye, const std::string& title, const std::string& over,
                        const std::vector<std::string>& lamps) const;

  private:
    std::string adapted() const;
    std::string no_adaptation() const; ///< why it lacks in all moments; "" where some moment has it, or there is none
};

} // namespace fernlicht
