// The bird's-eye lux map of a captured moment with the lanes' edges in map coordinates.
// A map of the ground before the car, as programs place it themselves.
#pragma once

#include "runner/findings/report.h"
#include "scenarios/drives/drive.h"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace fernlicht {

/// From a frame of a map view that has illuminance; `bumper_m` is the car's.
LuxMap lux_map_of(const Frame& frame, const Moment& moment, const View& view, const Route& route, double bumper_m);

/// Edges of driving lanes and shoulders in a view from above, a line for each side of each, every 2 m along the route.
std::vector<LuxMap::Polyline> edges_on_map(const Moment& moment, const View& view, const Route& route);

/// A car of 1.8 m, from its front bumper to 0.9 m behind its rear axle: where the light comes from, to scale.
LuxMap::Polyline car_outline(double bumper_m);

/// What the page will show of captured moments: of those that spread_over picks, and until the drive is played to its end, in case it never
/// is, of as many of the others. Their number does not grow with the drive.
template <class Kept> class ShownMoments {
  public:
    explicit ShownMoments(std::size_t captured_moments) {
        for (const std::size_t index : spread_over(captured_moments, max_pictured_moments))
            shown_.insert(index);
    }

    /// `captured`: the moment's number among the captured ones. It is made only if it is kept.
    void add(std::size_t captured, const std::function<Kept()>& make) {
        const auto kept = [this](std::size_t index) { return shown_.contains(index) || index % stride_ == 0; };
        if (!kept(captured))
            return;
        all_.emplace(captured, make());
        const auto others = [this] {
            std::set<std::size_t> moments;
            for (const auto& [index, one] : all_)
                if (!shown_.contains(index))
                    moments.insert(index);
            return moments.size();
        };
        while (others() > max_pictured_moments) {
            stride_ *= 2;
            std::erase_if(all_, [&](const auto& entry) { return !kept(entry.first); });
        }
    }
    /// In the order of moments.
    std::vector<Kept> finish(bool all_played) {
        std::vector<Kept> kept;
        for (auto& [index, one] : all_)
            if (!all_played || shown_.contains(index))
                kept.push_back(std::move(one));
        return kept;
    }

  private:
    std::set<std::size_t> shown_;
    std::size_t stride_ = 1; ///< of the others every such is kept
    std::multimap<std::size_t, Kept> all_;
};
using LuxMaps = ShownMoments<LuxMap>;

/// From `from_m` to `to_m` ahead of the car's reference point (from_m < to_m; behind it they are negative) and `beside_m` > 0 to each side.
inline View map_of(std::string name, double from_m, double to_m, double beside_m, int width_px, int height_px) {
    View view;
    view.name = std::move(name);
    view.projection = Projection::map;
    view.map_ahead_m = to_m;
    view.map_behind_m = -from_m;
    view.map_left_m = view.map_right_m = beside_m;
    view.width_px = width_px;
    view.height_px = height_px;
    return view;
}

} // namespace fernlicht
