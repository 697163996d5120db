#include "scenarios/drives/play/bus_motion.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

std::size_t BusMotion::point_at(double time_s) const {
    const auto next = std::ranges::upper_bound(points_, time_s, {}, &Point::time_s);
    return next == points_.begin() ? 0 : static_cast<std::size_t>(next - points_.begin()) - 1;
}

void BusMotion::add(double time_s, double speed_mps, std::optional<double> way_m) {
    if (way_m) {
        way_told_ = true;
        points_.push_back({time_s, speed_mps, *way_m});
        return;
    }
    const std::size_t n = points_.size();
    if (n >= 2 && points_[n - 1].speed_mps == speed_mps && points_[n - 2].speed_mps == speed_mps)
        points_.pop_back();
    const double before_m = points_.empty() ? 0.0 : points_.back().way_m;
    const double ridden_m = points_.empty() ? 0.0 : (time_s - points_.back().time_s) * 0.5 * (points_.back().speed_mps + speed_mps);
    points_.push_back({time_s, speed_mps, before_m + ridden_m});
}

double BusMotion::speed_mps(double time_s) const {
    const std::size_t at = point_at(time_s);
    const Point& before = points_[at];
    if (at + 1 == points_.size() || time_s <= before.time_s)
        return before.speed_mps;
    const Point& next = points_[at + 1];
    return std::lerp(before.speed_mps, next.speed_mps, (time_s - before.time_s) / (next.time_s - before.time_s));
}

double BusMotion::way_m(double time_s) const {
    const std::size_t at = point_at(time_s);
    const Point& before = points_[at];
    if (!way_told_)
        return before.way_m + (time_s - before.time_s) * 0.5 * (before.speed_mps + speed_mps(time_s));
    if (at + 1 == points_.size())
        return before.way_m;
    const Point& next = points_[at + 1];
    return std::lerp(before.way_m, next.way_m, (time_s - before.time_s) / (next.time_s - before.time_s));
}

std::vector<SpeedPoint> BusMotion::profile() const {
    std::vector<SpeedPoint> profile;
    for (const Point& point : points_)
        profile.push_back({point.time_s, point.speed_mps});
    return profile;
}

} // namespace fernlicht
