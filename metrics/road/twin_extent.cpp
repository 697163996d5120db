#include "metrics/road/extent.h"

#include "metrics/road/lux_near_thresholds.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

namespace fernlicht {
namespace {

/// The moment without the lamps that are off: they add exactly 0, and at most times half of a car's lamps are off.
Moment with_lit_lamps(const Moment& moment) {
    Moment result = moment;
    std::erase_if(result.lamps, [](const LitLamp& lamp) { return lamp.intensity_factor == 0.0; });
    return result;
}

double twin_lx(const Moment& moment, const Pose& pose, double target_height_m, Surface surface) {
    return surface == Surface::road ? surface_illuminance_lx(moment, pose.position_m, pose.up())
                                    : target_illuminance_lx(moment, pose.position_m + target_height_m * pose.up());
}

/// The own lane's centre, the offset nearest to 0, in the light of lamps that may stand otherwise than the moment says.
class LitCentreLine {
  public:
    LitCentreLine(const ExtentGrid& grid, Moment moment, Surface surface)
        : grid_(grid),
          column_(std::ranges::min_element(grid.offset_m, {}, [](double offset_m) { return std::abs(offset_m); }) - grid.offset_m.begin()),
          moment_(std::move(moment)), surface_(surface), first_known_(grid.ahead_m.size()), row_lx_(grid.ahead_m.size()) {}

    /// Farthest place with E >= limit, to a millionth of a row; nullopt where that is nowhere or beyond the last row.
    std::optional<double> reach_m(double threshold_lx) {
        std::size_t unlit = row_lx_.size();
        while (unlit > 0 && lx_in_row(unlit - 1) < threshold_lx)
            --unlit;
        if (unlit == 0 || unlit == row_lx_.size())
            return std::nullopt;
        double lit_row = static_cast<double>(unlit - 1);
        double unlit_row = static_cast<double>(unlit);
        for (int halving = 0; halving < 20; ++halving) {
            const double middle = 0.5 * (lit_row + unlit_row);
            (lx(middle) >= threshold_lx ? lit_row : unlit_row) = middle;
        }
        return grid_.ahead_m[unlit - 1] + (lit_row - static_cast<double>(unlit - 1)) * (grid_.ahead_m[unlit] - grid_.ahead_m[unlit - 1]);
    }

  private:
    double lx(double row) const {
        const auto before = std::min(static_cast<std::size_t>(row), row_lx_.size() - 2);
        const double share = row - static_cast<double>(before);
        const Pose* const near = &grid_.surface[before * grid_.offset_m.size()] + column_;
        const Pose &a = *near, &b = near[grid_.offset_m.size()];
        const Pose between{a.position_m + share * (b.position_m - a.position_m), a.axes + share * (b.axes - a.axes)};
        return twin_lx(moment_, between, grid_.target_height_m, surface_);
    }

    /// Asked from the far end on, by one limit after the other.
    double lx_in_row(std::size_t row) {
        for (; first_known_ > row; --first_known_)
            row_lx_[first_known_ - 1] = lx(static_cast<double>(first_known_ - 1));
        return row_lx_[row];
    }

    const ExtentGrid& grid_;
    std::ptrdiff_t column_;
    Moment moment_;
    Surface surface_;
    std::size_t first_known_;
    std::vector<double> row_lx_; ///< from `first_known_` on
};

/// Half of what the reach changes between two states of the lamps.
std::optional<double> half_difference_m(LitCentreLine& less, LitCentreLine& more, double threshold_lx) {
    const std::optional<double> near_m = less.reach_m(threshold_lx);
    const std::optional<double> far_m = near_m ? more.reach_m(threshold_lx) : std::nullopt;
    return far_m ? std::optional(0.5 * (*far_m - *near_m)) : std::nullopt;
}

Moment with_pitch(Moment moment, double more_rad) {
    for (LitLamp& lamp : moment.lamps)
        lamp.pose.axes = lamp.pose.axes * axes_from_angles(0.0, more_rad, 0.0);
    return moment;
}

Moment with_flux(Moment moment, double factor) {
    for (LitLamp& lamp : moment.lamps)
        lamp.intensity_factor *= factor;
    return moment;
}

} // namespace

std::vector<double> twin_illuminance_lx(const ExtentGrid& grid, const Moment& moment, Surface surface) {
    const Moment lit = with_lit_lamps(moment);
    const std::size_t columns = grid.offset_m.size();
    std::vector<double> lx(grid.surface.size());
    oneapi::tbb::parallel_for(std::size_t{0}, grid.ahead_m.size(), [&](std::size_t row) {
        for (std::size_t i = row * columns; i < (row + 1) * columns; ++i)
            lx[i] = twin_lx(lit, grid.surface[i], grid.target_height_m, surface);
    });
    return lx;
}

std::vector<double> twin_lux_near_thresholds(const ExtentGrid& grid, const Moment& moment, Surface surface,
                                             const std::vector<double>& thresholds_lx) {
    if (thresholds_lx.empty())
        return std::vector<double>(grid.surface.size());
    const Moment lit = with_lit_lamps(moment);
    const LightBounds light(lit);
    const double min_lx = *std::ranges::min_element(thresholds_lx);
    return lux_near_thresholds(
        grid, thresholds_lx,
        [&](std::size_t i) {
            const Pose& pose = grid.surface[i];
            return surface == Surface::road ? light.surface_lx(pose.position_m, pose.up(), 0.99 * min_lx)
                                            : light.target_lx(pose.position_m + grid.target_height_m * pose.up());
        },
        [&](std::size_t i) { return twin_lx(lit, grid.surface[i], grid.target_height_m, surface); });
}

std::vector<ReachSensitivity> reach_sensitivity(const ExtentGrid& grid, const Moment& moment, const std::vector<double>& thresholds_lx) {
    std::vector<ReachSensitivity> results;
    if (grid.ahead_m.size() < 2 || grid.offset_m.empty())
        return results;
    const Moment lit = with_lit_lamps(moment);
    for (const Surface surface : {Surface::road, Surface::target}) {
        LitCentreLine lower(grid, with_pitch(lit, radians(-0.1)), surface), higher(grid, with_pitch(lit, radians(0.1)), surface);
        LitCentreLine weaker(grid, with_flux(lit, 0.9), surface), stronger(grid, with_flux(lit, 1.1), surface);
        for (const double limit : thresholds_lx) {
            const std::optional<double> by_aim = half_difference_m(lower, higher, limit);
            const std::optional<double> by_flux = half_difference_m(weaker, stronger, limit);
            if (by_aim && by_flux)
                results.push_back({limit, surface, *by_aim, *by_flux});
        }
    }
    return results;
}

} // namespace fernlicht
