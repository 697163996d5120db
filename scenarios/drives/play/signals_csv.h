// The signal table over a drive as a CSV file: one row per moment.
#pragma once

#include "scenarios/control/control_run.h"
#include "scenarios/drives/drive.h"

#include <string>

namespace fernlicht {

/// Columns: frame, then each signal by name; a signal that is lost is empty, a distance to nothing "inf". Behind them, of each input from a
/// bus, NAME.state (fresh, stale, missing, out_of_range, contradictory) and NAME.age_s. Of the ticks first..last.
std::string signals_csv(const Drive& drive, const ControlRun& run, int first, int last);

} // namespace fernlicht
