// Judges results, just played or read back, by limits, baselines and known failures. No drive is played for it.
#pragma once

#include "runner/experiments/run/run_drives.h"

namespace fernlicht {

/// Of the drive's own limits, times included; of a technique that is not ours they say whose light it is.
std::vector<Verdict> limit_verdicts(const Drive& drive, const PlayedCell& played);

/// The drive's title; of a technique that is not ours with its name.
std::string lit_title(const std::string& title, const std::string& technique);

/// Adds the verdicts that need all of the run, by its baselines and its list of known failures.
void judge_whole(Report& report, const RunOptions& options);

} // namespace fernlicht
