// How far ahead a small target on the own lane is detected, over a drive: visibility level after Adrian (metrics/visibility.h) in the light
// of the lamps' tables in double, against the road that the driver sees behind it.
#pragma once

#include "metrics/lane_ahead.h"
#include "metrics/lit_surface.h"
#include "metrics/readings.h"
#include "metrics/visibility.h"
#include "runner/seeing/seeing_series.h"

namespace fernlicht {

/// A target at one place ahead.
struct SeenTarget {
    double ahead_m = 0.0;
    Value level; ///< 0 where the lane hides it from the driver
    std::optional<SurfaceLuminance> background;
};

class VisibilityFold {
  public:
    /// The drive must ask for visibility. Drive and route must outlive the fold.
    VisibilityFold(const Drive& drive, const Route& route);

    void add(const Moment& moment);
    /// detection_own_m, _min_m, _p05_m; undetected_before_detection_own_m; and at each distance visibility_level_own_at_50m,
    /// background_luminance_own_at_50m_cdm2, mesopic_luminance_own_at_50m_cdm2, medians.
    Readings readings() const;
    std::vector<SeeingSeries> series() const;

  private:
    SeenTarget target(const Moment& moment, const LaneAhead& lane, const Pose& place, double ahead_m, const glm::dvec3& eye_m) const;

    struct AtDistance {
        std::vector<double> level, photopic, mesopic;
        std::string no_level, no_background;
    };
    const Drive& drive_;
    const Route& route_;
    Material road_;
    glm::dvec3 eye_m_{0.0}; ///< in the car's frame
    std::vector<int> ticks_;
    std::vector<double> along_m_;
    struct Detection {
        Value from_m, undetected_m; ///< not measured where the route's end cuts them off
    };
    std::vector<Detection> detections_;
    std::vector<AtDistance> at_;
    std::vector<std::vector<std::optional<double>>> level_series_;
};

} // namespace fernlicht
