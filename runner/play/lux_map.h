// The bird's-eye lux map of a captured moment with the lanes' edges in map coordinates.
#pragma once

#include "runner/findings/report.h"

#include <functional>
#include <map>
#include <set>

namespace fernlicht {

/// From a frame of a map view that has illuminance; `bumper_m` is the car's.
LuxMap lux_map_of(const Frame& frame, const Moment& moment, const View& view, const Route& route, double bumper_m);

/// Edges of driving lanes and shoulders in a view from above, a line for each side of each, every 2 m along the route.
std::vector<LuxMap::Polyline> edges_on_map(const Moment& moment, const View& view, const Route& route);

/// A car of 1.8 m, from its front bumper to 0.9 m behind its rear axle: where the light comes from, to scale.
LuxMap::Polyline car_outline(double bumper_m);

/// The maps that the page will show: of all captured moments those that spread_over picks, and until the drive is played to its end, in
/// case it never is, as many of the others. Their number does not grow with the drive.
class LuxMaps {
  public:
    explicit LuxMaps(std::size_t captured_moments);

    /// `captured`: the moment's number among the captured ones. The map is made only if it is kept.
    void add(std::size_t captured, const std::function<LuxMap()>& make);
    /// In the order of moments.
    std::vector<LuxMap> finish(bool all_played);

  private:
    std::set<std::size_t> shown_;
    std::size_t stride_ = 1; ///< of the others every such is kept
    std::multimap<std::size_t, LuxMap> maps_;
};

} // namespace fernlicht
