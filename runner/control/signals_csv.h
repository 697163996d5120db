// The signal table over a drive as a CSV file: one row per moment.
#pragma once

#include "scenarios/control/control_run.h"

#include <string>

namespace fernlicht {

/// Columns: frame, then each signal by name; a signal that is lost is empty, a distance to nothing "inf". Of the ticks first..last.
std::string signals_csv(const ControlRun& run, int first, int last);

} // namespace fernlicht
