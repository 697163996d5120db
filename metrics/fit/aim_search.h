// Where to start from: the misfit has many minima over aim, because a cut-off may lie on either side of a point.
#pragma once

#include "metrics/fit/descent.h"

namespace fernlicht {

/// How far off the drive's aim is looked.
inline constexpr double search_pitch_deg = 3.0, search_yaw_deg = 5.0;

/// Shifts of aim and flux, heights as they are, best last: none; all lamps alike; each by itself, twice round. Each over a grid of 0.25 by
/// 0.5 degrees, then of 0.05 by 0.1 round its best place. What is held of pitch, yaw and flux stays. Compared by the sum of
/// |ln(calculated / read)|, each at most 2, which needs no right scale and takes outliers.
std::vector<Shifts> starts_of(const FitModel& model, const FreeGroups& free);

} // namespace fernlicht
