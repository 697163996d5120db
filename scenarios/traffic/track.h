// Where something is at any time: time-stamped poses, and what lies between them.
#pragma once

#include "scenarios/values/pose.h"

#include <vector>

namespace fernlicht {

struct TrackPoint {
    double time_s = 0.0;
    Pose pose; ///< in the world: on the road's surface under the rear axle, x forward, y left, z up
    double speed_mps = 0.0;

    bool operator==(const TrackPoint&) const = default;
};

/// A pure function of time. Between points places follow cubic Hermite curves with the points' velocities (speed along x), axes turn at a
/// constant rate about one axis, speeds are linear. Before the first and after the last point it stands there.
class Track {
  public:
    /// Times ascend strictly. Throws std::invalid_argument for no points or times that do not ascend.
    explicit Track(std::vector<TrackPoint> points);

    TrackPoint at(double time_s) const;
    double first_s() const { return points_.front().time_s; }
    double last_s() const { return points_.back().time_s; }
    const std::vector<TrackPoint>& points() const { return points_; }

  private:
    std::vector<TrackPoint> points_;
};

} // namespace fernlicht
