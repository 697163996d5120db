// What calculation leaves open of a reading: how far the figure may be off for a lamp that is known exactly. docs/studies.md has the table.
#pragma once

#include "metrics/readings/significance.h"

namespace fernlicht {

/// To either side, in the reading's unit; nullopt when nothing tells.
std::optional<double> left_open(const PlayedReadings& played, const Reading& reading);

} // namespace fernlicht
