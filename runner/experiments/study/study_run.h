// Plays a study: each cell by the same door as `fernlicht run`, into a run's folder of its own below the study's.
#pragma once

#include "runner/experiments/run/run_drives.h"
#include "runner/experiments/study/study_result.h"

#include <functional>

namespace fernlicht {

struct StudyOptions {
    std::filesystem::path folder;
    std::vector<std::string> only;      ///< cells whose name fits one of these, * and ? allowed; empty: all
    std::optional<KnownFailures> known; ///< over all cells
    bool strict = false;                ///< refuse lamp files with which readings are meaningless
    bool resume = false;                ///< go on in the study's folder; finished cells are kept, the report is written anew
    RunOptions run; ///< backend, moments, baselines, repeats, day, quiet, accuracy, command; the folder is each cell's own
    std::function<void(const StudyResult&)> write; ///< into the folder, before it is marked as complete
};

/// Those of a study's cells whose names fit one of the patterns, all where there is none. Throws InputError for one that fits no cell.
std::vector<StudyCell> chosen_cells(const Study& study, const std::vector<std::string>& only);

/// Reads all drives and lamps first, plays the cells in the order of cells_of, reads their reports back, compares. A cell that fails is
/// noted and the next one played; SIGINT ends the study after the moment at hand. Throws InputError and DeviceError where nothing can be
/// played, or where a folder to go on in holds cells of another study.
StudyResult run_study(const Study& study, const StudyOptions& options);

/// Throws InputError with the lamp's line in the study's file where `aim: auto` stands beside a file that has nothing to aim by. run_study
/// asks for it, too.
void refuse_unaimable(const Study& study);

} // namespace fernlicht
