// A study's night as the history keeps it.
#pragma once

#include "runner/experiments/study/study_result.h"
#include "runner/history/history.h"

namespace fernlicht {

/// What a cell read of its whole drive, without times of the machine.
NightReadings night_readings(const ReadingsOfCell& cell);

/// Readings of whole drives, without times of the machine; frame times of cells that were played this night. `folder` is where the study's
/// report lies.
Night night_of_study(const StudyResult& result, const std::filesystem::path& folder);

/// The same of a study's folder, and what was left out of the study that night, "" for nothing. Throws InputError for what is no folder of
/// a complete study.
Night read_night(const std::filesystem::path& folder, std::string* played_in_part = nullptr);

/// What cells read when they were played again, by name, to the night.
void take_replays(Night& tonight, const std::map<std::string, NightReadings>& replays);

} // namespace fernlicht
