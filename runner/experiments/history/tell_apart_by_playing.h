// Telling causes apart by playing one cell: today's program with the lamps of an earlier night, which the store still has.
#pragma once

#include "runner/experiments/history/history_findings.h"
#include "runner/experiments/study/study_run.h"

namespace fernlicht {

/// Plays into the store, and with a folder there for the files in between. Where anything but lamps was another, or the store has lost a
/// lamp, it says so instead. Both references must outlive it.
TellApart tell_apart_by_playing(const Study& study, const StudyOptions& options);

} // namespace fernlicht
