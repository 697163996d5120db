// A drive's moments in readings: what limits are set on. docs/readings.md defines every name.
#pragma once

#include "runner/report/report.h"

namespace fernlicht {

/// Readings of the whole drive: extents by limit, plane and lane with their difference from the twin, their sensitivity and the grid's
/// error. Probes are not among them. The same inputs give the same bytes.
Readings summarise(const PlayedVariant& played, const Drive& drive);

/// How long each pass took: median, 95th percentile and spread. Kept apart from summarise because no two runs agree on them.
Readings times(const PlayedVariant& played);

/// A lane's or a pass's name as it stands within a reading's name: "left 1" -> "left_1".
std::string name_part(const std::string& text);

/// Whether a reading tells how long something took on this machine: such readings are reported and never compared.
bool is_unit_of_time(const std::string& unit);

} // namespace fernlicht
