#include "scenarios/traffic/track.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

namespace fernlicht {

Track::Track(std::vector<TrackPoint> points) : points_(std::move(points)) {
    if (points_.empty())
        throw std::invalid_argument("a track without points");
    for (std::size_t i = 1; i < points_.size(); ++i)
        if (!(points_[i].time_s > points_[i - 1].time_s))
            throw std::invalid_argument("a track whose times do not ascend");
}

TrackPoint Track::at(double time_s) const {
    const auto next = std::ranges::upper_bound(points_, time_s, {}, &TrackPoint::time_s);
    if (next == points_.begin() || next == points_.end()) {
        TrackPoint end = next == points_.begin() ? points_.front() : points_.back();
        if (end.time_s != time_s)
            end.speed_mps = 0.0;
        return end;
    }
    const TrackPoint &a = *(next - 1), &b = *next;
    if (a.time_s == time_s)
        return a;
    const double step = b.time_s - a.time_s, u = (time_s - a.time_s) / step, v = 1.0 - u;
    // Cubic Hermite: with straight, even motion its velocity is the points' own.
    const glm::dvec3 from = a.pose.forward() * (a.speed_mps * step), to = b.pose.forward() * (b.speed_mps * step);
    TrackPoint out;
    out.time_s = time_s;
    out.pose.position_m = a.pose.position_m * (v * v * (1.0 + 2.0 * u)) + from * (u * v * v) +
                          b.pose.position_m * (u * u * (3.0 - 2.0 * u)) - to * (u * u * v);
    out.pose.axes = glm::mat3_cast(glm::normalize(glm::slerp(glm::quat_cast(a.pose.axes), glm::quat_cast(b.pose.axes), u)));
    out.speed_mps = a.speed_mps * v + b.speed_mps * u;
    return out;
}

} // namespace fernlicht
