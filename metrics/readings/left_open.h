// What calculation leaves open of a reading: how far the figure may be off for a lamp that is known exactly. docs/studies.md has the table.
#pragma once

#include "metrics/readings/significance.h"

namespace fernlicht {

/// To either side, in the reading's unit; nullopt when nothing tells.
std::optional<double> left_open(const PlayedReadings& played, const Reading& reading);

/// "reach_5lx_road_own" of "reach_5lx_road_own_left_edge_p05_m": quantity, limit, plane and lane, by which rows on trust are named. ""
/// where the name has no such parts.
std::string extent_subject(const std::string& name);

} // namespace fernlicht
