// How far the reach that a picture shows lies from the reference's.
#pragma once

#include "metrics/road/extent.h"

#include <string>
#include <vector>

namespace fernlicht {

/// Reach on the own lane's centre against the reference's, over the moments in which both have one.
struct ReachError {
    Surface surface = Surface::road;
    double threshold_lx = 0.0;
    std::size_t moments = 0;
    double median_m = 0.0, worst_m = 0.0; ///< signed: above 0 the picture is lit farther; `worst` by its size
    std::string why_not;                  ///< why there is none; "" where there is
};

/// By plane and limit. `tested` and `reference` hold the extents of the same moments. A plane for which a reason is given has none.
std::vector<ReachError> reach_errors(const std::vector<std::vector<LaneExtent>>& tested,
                                     const std::vector<std::vector<LaneExtent>>& reference, const std::vector<double>& thresholds_lx,
                                     const std::string& no_road, const std::string& no_target);

} // namespace fernlicht
