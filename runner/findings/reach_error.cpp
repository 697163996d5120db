#include "runner/findings/reach_error.h"

#include "metrics/statistics/statistics.h"
#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

std::vector<ReachError> reach_errors(const std::vector<std::vector<LaneExtent>>& tested,
                                     const std::vector<std::vector<LaneExtent>>& reference, const std::vector<double>& thresholds_lx,
                                     const std::string& no_road, const std::string& no_target) {
    std::vector<ReachError> errors;
    for (const Surface surface : {Surface::road, Surface::target})
        for (const double threshold_lx : thresholds_lx) {
            ReachError error{surface, threshold_lx, 0, 0.0, 0.0, surface == Surface::road ? no_road : no_target};
            std::vector<double> differences;
            for (std::size_t m = 0; m < tested.size(); ++m) {
                const ExtentKey key{surface, "own", threshold_lx};
                const LaneExtent *const ours = find_extent(tested[m], key), *const truth = find_extent(reference.at(m), key);
                if (ours && truth && !ours->reach_is_cut_off && !truth->reach_is_cut_off)
                    differences.push_back(ours->reach_centre_m - truth->reach_centre_m);
            }
            error.moments = differences.size();
            if (const auto spread = spread_of(differences)) {
                error.median_m = spread->median;
                error.worst_m = *std::ranges::max_element(differences, {}, [](double d) { return std::abs(d); });
            } else if (error.why_not.empty()) {
                error.why_not = "no moment has a reach that ends on the road";
            }
            errors.push_back(error);
        }
    return errors;
}

} // namespace fernlicht
