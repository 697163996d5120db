// The extents of a drive's moments in a few figures, for tables and the summary of report.json.
#pragma once

#include "runner/report/report.h"

#include <compare>
#include <optional>

namespace fernlicht {

/// Which of a moment's extents.
struct ExtentKey {
    ExtentPlane plane = ExtentPlane::road;
    std::string lane;
    double limit_lx = 0.0;
    auto operator<=>(const ExtentKey&) const = default;
};

const char* plane_name(ExtentPlane plane);  ///< "road", "target"
const char* verdict_name(VerdictKind kind); ///< "pass", "fail", "not_measured"

/// Every key that occurs in any moment (rendered or twin): planes, then lanes, in the order of first sight, then limits ascending.
std::vector<ExtentKey> extent_keys(const PlayedVariant& played);

/// The extent of that key in one moment's list; nullptr where there is none (a lane that ended).
const LaneExtent* find_extent(const std::vector<LaneExtent>& extents, const ExtentKey& key);

struct ExtentSummary {
    ExtentKey key;
    std::size_t moments = 0;       ///< in which it was measured
    std::size_t cut_off = 0;       ///< moments whose reach is only a lower bound
    std::optional<Spread> reach_m; ///< on the lane's centre, rendered
    std::optional<Spread> area_m2;
    std::vector<std::pair<double, Spread>> width_m;                       ///< at each distance ahead
    std::optional<double> largest_twin_difference_m;                      ///< of reach, |rendered - twin|
    std::optional<double> metres_per_tenth_degree, metres_per_tenth_flux; ///< medians; own lane only
    std::optional<double> grid_error_m;                                   ///< median; own lane only
};
ExtentSummary summarise(const PlayedVariant& played, const ExtentKey& key);

} // namespace fernlicht
