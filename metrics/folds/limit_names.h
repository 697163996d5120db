// The readings that a limit of a drive may be set on.
#pragma once

#include "metrics/readings/readings.h"
#include "scenarios/drives/drive.h"

namespace fernlicht {

/// Before anything is drawn: throws InputError for a limit on a reading that no run can have (docs/readings.md has the names).
void check_limit_names(const Drive& drive, const Readings& others = {});

} // namespace fernlicht
