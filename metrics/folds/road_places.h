// Where across a road's section sensors and observers stand.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

/// Offset from the own lane's centre, left positive. nullopt: there is no such lane here. Edges are those of all driving lanes.
std::optional<double> offset_across_m(const CrossSection& section, Across across);

/// "right edge of the lanes".
std::string place_name(Across across);

} // namespace fernlicht
