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

/// The surface across the road at one s: all that does not depend on t, for callers that ask for many t.
struct SurfaceCut {
    double s_m = 0.0;
    const std::vector<ShapeProfile>* shapes = nullptr; ///< nullptr: flat
    glm::dvec3 reference_m{0.0};                       ///< the point at t = 0 of a flat cut
    glm::dvec3 forward{0.0}, left{0.0}, up{0.0};       ///< unit
    glm::dvec3 advance{0.0}, turning{0.0};             ///< derivatives by s of the reference point and of the frame's attitude
};

SurfaceCut cut_at(const SurfaceStrip& strip, double s_m);
SurfacePoint surface_point(const SurfaceCut& cut, double t_m);
inline SurfacePoint surface_point(const SurfaceStrip& strip, double s_m, double t_m) { return surface_point(cut_at(strip, s_m), t_m); }

/// x along `direction` (tangent to the surface, need not be unit), z the surface's normal, upwards.
Pose pose_along(const SurfacePoint& point, const glm::dvec3& direction);

} // namespace fernlicht
