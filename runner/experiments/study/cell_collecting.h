// From what was played to what a study's folder holds: each cell's files, judged by its drive as it is now.
#pragma once

#include "runner/experiments/study/study_run.h"

namespace fernlicht {

/// Of a cell that was planned, before anything of it is there.
CellResult unplayed_cell(const Study& study, const StudyPlan& plan, const PlannedCell& planned);

/// The command that plays this cell of the study, where its folder is not there.
std::string playing_anew(const StudyOptions& options, const StudyCell& cell);

/// "lamp xenon-low.ies changed (bytes of its file) while the study was played; start it again"; "" where nothing did.
std::string changed_since(const Drive& drive, const PlannedCell& planned);

/// Puts the cell's files from the store into the study's folder in place of what is there, judges them, and fills in `result`. Throws
/// InputError where the store lacks them, DeviceError where it holds them damaged (they are taken out) or the disk refuses.
void collect_cell(const CellStore& store, const Study& study, const PlannedCell& planned, const StudyOptions& options, CellResult& result);

/// The same with files that lie in the folder and are not judged.
void judge_cell(const Study& study, const PlannedCell& planned, const StudyOptions& options, CellResult& result);

/// Of a cell that is not pictured: takes away what figures are made of, and its folder unless it is kept or red.
void drop_pictures(const StudyOptions& options, bool keeps_folder, CellResult& cell);

} // namespace fernlicht
