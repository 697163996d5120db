#include "runner/report/extent_summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace fernlicht {
namespace {

std::optional<double> median_of(std::vector<double> samples) {
    const std::optional<Spread> spread = spread_of(std::move(samples));
    return spread ? std::optional(spread->median) : std::nullopt;
}

} // namespace

const char* plane_name(ExtentPlane plane) { return plane == ExtentPlane::road ? "road" : "target"; }

const char* verdict_name(VerdictKind kind) {
    switch (kind) {
    case VerdictKind::pass:
        return "pass";
    case VerdictKind::fail:
        return "fail";
    case VerdictKind::flaky:
        return "flaky";
    case VerdictKind::not_measured:
        break;
    }
    return "not_measured";
}

std::vector<ExtentKey> extent_keys(const PlayedVariant& played) {
    std::vector<std::string> lanes;
    std::vector<ExtentKey> keys;
    const auto collect = [&](const std::vector<LaneExtent>& extents) {
        for (const LaneExtent& extent : extents) {
            if (std::find(lanes.begin(), lanes.end(), extent.lane) == lanes.end())
                lanes.push_back(extent.lane);
            const ExtentKey key{extent.plane, extent.lane, extent.limit_lx};
            if (std::find(keys.begin(), keys.end(), key) == keys.end())
                keys.push_back(key);
        }
    };
    for (const ExtentRow& row : played.extents) {
        collect(row.rendered);
        collect(row.twin);
    }
    const auto rank = [&](const ExtentKey& key) {
        return std::tuple(key.plane, std::find(lanes.begin(), lanes.end(), key.lane) - lanes.begin(), key.limit_lx);
    };
    std::stable_sort(keys.begin(), keys.end(), [&](const ExtentKey& a, const ExtentKey& b) { return rank(a) < rank(b); });
    return keys;
}

const LaneExtent* find_extent(const std::vector<LaneExtent>& extents, const ExtentKey& key) {
    const auto found = std::find_if(extents.begin(), extents.end(), [&](const LaneExtent& extent) {
        return extent.plane == key.plane && extent.limit_lx == key.limit_lx && extent.lane == key.lane;
    });
    return found == extents.end() ? nullptr : &*found;
}

ExtentSummary summarise(const PlayedVariant& played, const ExtentKey& key) {
    ExtentSummary summary;
    summary.key = key;
    std::vector<double> reach, area, per_degree, per_flux, grid;
    std::map<double, std::vector<double>> widths;
    for (const ExtentRow& row : played.extents) {
        const LaneExtent* const rendered = find_extent(row.rendered, key);
        const LaneExtent* const twin = find_extent(row.twin, key);
        if (rendered && twin)
            summary.largest_twin_difference_m =
                std::max(summary.largest_twin_difference_m.value_or(0.0), std::abs(rendered->reach_centre_m - twin->reach_centre_m));
        if (rendered) {
            reach.push_back(rendered->reach_centre_m);
            area.push_back(rendered->area_m2);
            for (const LaneExtent::Width& width : rendered->widths)
                widths[width.at_m].push_back(width.width_m);
            summary.cut_off += rendered->reach_is_cut_off ? 1 : 0;
        }
        if (key.lane != "own")
            continue;
        for (const ReachSensitivity& sensitivity : row.sensitivity)
            if (sensitivity.plane == key.plane && sensitivity.limit_lx == key.limit_lx) {
                per_degree.push_back(sensitivity.metres_per_tenth_degree);
                per_flux.push_back(sensitivity.metres_per_tenth_flux);
            }
        for (const GridError& error : row.grid_errors)
            if (error.plane == key.plane && error.limit_lx == key.limit_lx)
                grid.push_back(error.reach_m);
    }
    summary.moments = reach.size();
    summary.reach_m = spread_of(std::move(reach));
    summary.area_m2 = spread_of(std::move(area));
    for (auto& [at_m, samples] : widths)
        summary.width_m.emplace_back(at_m, *spread_of(std::move(samples)));
    summary.metres_per_tenth_degree = median_of(std::move(per_degree));
    summary.metres_per_tenth_flux = median_of(std::move(per_flux));
    summary.grid_error_m = median_of(std::move(grid));
    return summary;
}

} // namespace fernlicht
