// The reference line in the ground plane: arc length to position, heading and curvature, for each shape OpenDRIVE knows.
#pragma once

#include "scenarios/roads/road_network.h"

namespace fernlicht {

/// A point of a reference line.
struct PlanPoint {
    double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;
    double heading_rate_per_m = 0.0; ///< change of heading per metre of s: the curvature where s is the arc length
    double speed = 1.0;              ///< metres on the curve per metre of s; other than 1 only for paramPoly3
};

/// Fills the caches of spirals and cubics, so that plan_point costs the same everywhere on the element.
void prepare(PlanElement& element);

/// The point `ds_m` after the element's start; a little beyond its end the formula goes on.
PlanPoint plan_point(const PlanElement& element, double ds_m);

/// The point of the road's reference line at s, clamped to the road. A road without elements lies at the origin.
PlanPoint plan_point(const Road& road, double s_m);

/// The element that holds at s. The road must have one.
const PlanElement& element_at(const Road& road, double s_m);

/// Length of the curve an element draws, by integration; equals length_m for everything but a badly written paramPoly3.
double drawn_length_m(const PlanElement& element);

} // namespace fernlicht
