// Playing what a study's store lacks: in this process, or in a process of its own for each cell.
#pragma once

#include "runner/experiments/study/study_run.h"

#include <map>

namespace fernlicht {

/// Of a cell that was not timed.
inline constexpr const char* no_times_beside_others = "cells beside it";

/// What an exception says, in words where it is a bare name of the runtime's.
std::string sentence_of_failure(const std::string& what);

/// Plays the cell and keeps it; false where it was interrupted. Throws InputError and DeviceError.
bool play_into(const CellStore& store, const Study& study, const StudyPlan& plan, const PlannedCell& planned, const StudyOptions& options);

/// Plays the cell by itself into its folder, and takes its times; false where it was interrupted.
bool play_timed(const Study& study, const PlannedCell& planned, const StudyOptions& options, const std::filesystem::path& folder);

/// Seconds a frame of the driver's view takes when the cell is played once more, in a process of its own, with nothing beside it. Throws
/// what kept it from being timed.
double frame_s_by_itself(const Study& study, const std::string& cell, const CellStore& store, const StudyOptions& options);

/// How many cells to play at a time, and how many cores each has. One a core where the CPU draws, at most four cells where a GPU
/// does (not measured there); as many as the memory holds.
struct Jobs {
    int at_once = 1;
    int cores = 1;
};
Jobs jobs_for(int asked, const RunContext& context, const StudyResources& resources);

/// What became of one cell that was to be played.
struct PlayedInWorker {
    std::string failed; ///< why it has no results; "" where it has
    double seconds = 0.0, cpu_s = 0.0, peak_memory_mib = 0.0;
};

/// Plays these of the plan's cells (places in it), the longest first, each in a process of its own; logs of those that fail stay in
/// `options.folder`/logs. The places of cells that were not reached are left out.
std::map<std::size_t, PlayedInWorker> play_in_workers(const CellStore& store, const Study& study, const StudyPlan& plan,
                                                      const std::vector<std::size_t>& cells, const Jobs& jobs, const StudyOptions& options);

} // namespace fernlicht
