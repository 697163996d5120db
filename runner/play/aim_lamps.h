// Lamps whose aim is `auto`: turned by what is found in their tables, before a drive is played.
#pragma once

#include "runner/findings/lamp_aim.h"
#include "scenarios/drives/drive.h"

namespace fernlicht {

/// Aligns each lamp of lamp sets and traffic whose rule is automatic (installed_aim.h), low and high beams as their names tell. A file that
/// a change gives it is aimed by its own cut-off, and where it has none (the high beam of a lamp for both) as the lamp was before. What was
/// found depends on files, mounts and rules alone: once more changes nothing, and neither does a drive written and read again.
/// Throws InputError with lamp, file and reason where there is nothing to aim by.
void aim_lamps(Drive& drive);

/// By its name: aimed by its cut-off, if by anything; neither fog nor cornering lamps are.
bool is_low_beam(const MountedLamp& lamp);

/// Each lamp of the set with each file that it has over the drive. Needs aim_lamps() before. Looks through the tables of lamps as they are
/// filed too, to say where their beams lie: some 50 ms a table.
std::vector<LampAim> lamp_aims(const LampSet& lamp_set);

} // namespace fernlicht
