// How much more light moves a reading, and so how far noise of the lamps' tables does.
#pragma once

#include "metrics/readings/significance.h"

namespace fernlicht {

/// How far noise of the tables is followed: three standard deviations of one intensity. Light on the road is interpolated from several
/// intensities of two lamps, whose noise averages; what deviates evenly within +-a never goes beyond 1.73 of them.
inline constexpr double noise_deviations = 3.0;

/// What 100 % more light would move a reading by, going on as it begins: its derivative after the logarithm of the light. Illuminance and
/// luminance go with the light; reach has its sensitivity to flux; other extents take the steeper slope to the same extent at the next
/// limits, for twice the light reaches twice the limit. nullopt when nothing tells.
std::optional<double> moved_by_light(const PlayedReadings& played, const Reading& reading);

} // namespace fernlicht
