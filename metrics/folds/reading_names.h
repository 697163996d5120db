// Names that a drive gives to what is measured, and the readings that its limits may be set on.
#pragma once

#include "metrics/readings/readings.h"
#include "scenarios/drives/drive.h"
#include "scenarios/roads/route.h"

#include <string>
#include <string_view>

namespace fernlicht {

/// Before anything is drawn: throws InputError for a probe, sensor, eye, mirror or target whose readings would have another's name, and
/// for a limit on a reading that no run can have (docs/readings.md has the names). `others`: readings beside extents, times and probes.
/// `route`: has the lanes; nullptr: any lane will do.
void check_names(const Drive& drive, const Readings& others = {}, const Route* route = nullptr);

/// The key of `measure:` by which a drive has readings whose names begin so: "glare". "" where it is no affair of `measure:`.
std::string asked_for_by(std::string_view name);

} // namespace fernlicht
