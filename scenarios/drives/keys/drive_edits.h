// What flags change in a drive that was read.
#pragma once

#include "scenarios/drives/keys/lamp_sets.h"

namespace fernlicht {

/// Applies `edits` and notes what the user would not guess. Throws InputError for a side that no lamp has.
void apply_edits(Drive& drive, const DriveEdits& edits, LampShelf& shelf);

} // namespace fernlicht
