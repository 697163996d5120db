// The road's surface by s and t, with its tangents. For callers that ask often: the pieces that hold on a stretch are looked up once.
#pragma once

#include "scenarios/roads/plan.h"

namespace fernlicht {

/// The pieces of a road's geometry that hold at some s, into the road's own vectors.
struct SurfaceStrip {
    const PlanElement* element = nullptr;
    const Cubic *elevation = nullptr, *superelevation = nullptr; ///< nullptr: zero
    const std::vector<ShapeProfile>* shapes = nullptr;
};

SurfaceStrip strip_at(const Road& road, double s_m);

struct SurfacePoint {
    glm::dvec3 position_m{0.0};
    glm::dvec3 by_s{1.0, 0.0, 0.0}, by_t{0.0, 1.0, 0.0}; ///< derivatives of the position, by_s never backwards
};

SurfacePoint surface_point(const SurfaceStrip& strip, double s_m, double t_m);

/// x along `direction` (tangent to the surface, need not be unit), z the surface's normal, upwards.
Pose pose_along(const SurfacePoint& point, const glm::dvec3& direction);

} // namespace fernlicht
