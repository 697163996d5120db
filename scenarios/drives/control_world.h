// What lamp control is told of a drive at any time: the car's state, the road ahead, light and others.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

/// Runs the control of each variant that has one and puts it into the variant's motion, with notes: after simulate() and
/// place_traffic(). Nothing for a drive without. Throws
/// InputError for what the control names and the variant lacks.
void simulate_control(Drive& drive, const Route& route);

} // namespace fernlicht
