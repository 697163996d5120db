// `traffic` and `traffic_light`: other users of the road.
#pragma once

#include "scenarios/drives/keys/lamp_sets.h"

namespace fernlicht {

/// Rows into drive.traffic_rows, and what light of theirs is left out.
void read_traffic(const YamlMap& keys, LampShelf& shelf, Drive& drive);

} // namespace fernlicht
