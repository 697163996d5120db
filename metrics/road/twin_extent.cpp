#include "metrics/road/extent.h"

#include "metrics/road/lux_near_thresholds.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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

/// For limits of a light that is `factor` times as strong: what it reaches, this light reaches at limits so many times lower.
std::vector<double> divided(std::vector<double> thresholds_lx, double factor) {
    for (double& threshold : thresholds_lx)
        threshold /= factor;
    return thresholds_lx;
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
    const SurfacePlaces own = grid.places.x_m.empty() ? SurfacePlaces(grid.surface) : SurfacePlaces();
    const SurfacePlaces& places = grid.places.x_m.empty() ? own : grid.places;
    const double min_lx = *std::ranges::min_element(thresholds_lx);
    return lux_near_thresholds(
        grid, thresholds_lx,
        [&](std::size_t first, std::span<LuxBounds> bounds) {
            if (surface == Surface::road)
                light.surface_lx(places, first, 0.99 * min_lx, bounds);
            else
                light.target_lx(places, first, grid.target_height_m, bounds);
        },
        [&](std::size_t i) { return twin_lx(lit, grid.surface[i], grid.target_height_m, surface); });
}

NudgedExtents nudged_extents(const ExtentGrid& grid, const Moment& moment, const std::vector<double>& thresholds_lx,
                             const std::vector<double>& width_at_m, const Nudges& nudges) {
    NudgedExtents extents;
    const auto measure = [&](const std::vector<double>& lx, Surface surface, double factor, std::vector<LaneExtent>& into) {
        for (LaneExtent& extent : measure_extent(grid, lx, surface, divided(thresholds_lx, factor), width_at_m)) {
            extent.threshold_lx = *std::ranges::min_element(
                thresholds_lx, {}, [&](double threshold_lx) { return std::abs(threshold_lx / factor - extent.threshold_lx); });
            into.push_back(std::move(extent));
        }
    };
    std::vector<double> with_flux = thresholds_lx;
    for (const std::optional<Nudge>& nudge : nudges)
        if (nudge && nudge->flux_factor != 1.0)
            std::ranges::copy(divided(thresholds_lx, nudge->flux_factor), std::back_inserter(with_flux));
    for (const Surface surface : {Surface::road, Surface::target}) {
        const std::vector<double> as_is = twin_lux_near_thresholds(grid, moment, surface, with_flux);
        measure(as_is, surface, 1.0, extents.as_is);
        for (std::size_t kind = 0; kind < nudges.size(); ++kind)
            if (const std::optional<Nudge>& nudge = nudges[kind]; nudge && nudge->flux_factor != 1.0)
                measure(as_is, surface, nudge->flux_factor, extents.nudged[kind]);
            else if (nudge)
                measure(twin_lux_near_thresholds(grid, nudged(moment, *nudge), surface, thresholds_lx), surface, 1.0, extents.nudged[kind]);
    }
    return extents;
}

} // namespace fernlicht
