// The own lane ahead of a car as the driver sees it: places on it at even distances, what its ground hides, where a line of sight meets it.
// Along its centre and across in the tangent plane there: banked roads are followed, their edges and what stands beside them are not.
#pragma once

#include "scenarios/roads/route.h"

namespace fernlicht {

class LaneAhead {
  public:
    /// Places every `step_m` from `from_m` along the route, to `length_m` farther or the route's end.
    LaneAhead(const Route& route, double from_m, double length_m, double step_m);

    const std::vector<Pose>& surface() const { return surface_; }

    /// True where the lane rises above the line between two points: of no use for points below it.
    bool hides(const glm::dvec3& from, const glm::dvec3& to) const;
    /// Where the line from `eye` through `point` meets the lane beyond `point`: the place's pose, the point on its surface. nullopt: it
    /// does not meet what is known of the lane.
    std::optional<Pose> behind(const glm::dvec3& eye, const glm::dvec3& point) const;

  private:
    double height_m(std::size_t place, const glm::dvec3& from, const glm::dvec3& direction, double& share) const;

    std::vector<Pose> surface_;
};

} // namespace fernlicht
