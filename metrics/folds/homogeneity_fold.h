// How evenly the own lane is lit over a drive (metrics/seeing/homogeneity.h), from the lamps' tables in double, on the road's surface.
#pragma once

#include "metrics/folds/seeing_series.h"
#include "metrics/readings/readings.h"
#include "metrics/seeing/homogeneity.h"
#include "scenarios/drives/play/moment.h"

namespace fernlicht {

/// Places of the own lane ahead of the bumper where its evenness is measured, in rows, and all but the light there.
struct LanePlaces {
    LaneLight light; ///< without `lx`
    std::vector<Pose> surface;
};
/// Distances from the middle of the moment's lamps.
LanePlaces lane_places(const Drive& drive, const HomogeneityParameters& asked, const Route& route, const Moment& moment,
                       const glm::dvec3& eye_m);
/// Targets across the own lane, 0.25 m up; none where there is no such lane. Up to the route's end.
std::vector<glm::dvec3> targets_across(const Route& route, double along_m);

class HomogeneityFold {
  public:
    /// The drive must ask for homogeneity. Drive and route must outlive the fold.
    HomogeneityFold(const Drive& drive, const Route& route) : drive_(drive), route_(route) {}

    void add(const Moment& moment);
    /// gradient_along_own_per_m and _per_deg, gradient_across_..., patch_dark_own_m and patch_bright_own_m (the longest), medians and
    /// _max_; foreground_own_lx, foreground_ratio_own, uniformity_target_own_at_20m ..., medians.
    Readings readings() const;
    std::vector<SeeingSeries> series() const;

  private:
    struct Row {
        int tick = 0;
        double along_m = 0.0;
        Gradients gradients;
        Unevenness patches;
        Value foreground_lx, foreground_ratio;
        std::vector<Value> uniformity; ///< by distance
    };
    const Drive& drive_;
    const Route& route_;
    std::vector<Row> rows_;
};

} // namespace fernlicht
