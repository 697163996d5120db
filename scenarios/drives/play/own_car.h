// The own car's body: what its driver sees of it.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

/// Of the drive's own_car adds what its driver cannot look through: triangles ahead of the eye of the first perspective view that lie
/// wholly below five sixths of its height (bonnet, doors, dashboard; no windows). They move with the last of Moment::bodies, stand in the
/// way of no light (the lamps sit at their front), and hide what lies behind them. Nothing without a model or a perspective view. After
/// add_road_users().
void add_own_car(Scene& scene, const Drive& drive);

} // namespace fernlicht
