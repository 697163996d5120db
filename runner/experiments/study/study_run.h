// Plays a study: each cell in the same way as `fernlicht run`, in a process of its own, into the store; then collects what lies there into
// a folder, and reports on it.
#pragma once

#include "runner/experiments/study/study_plan.h"
#include "runner/experiments/study/study_result.h"

#include <functional>

namespace fernlicht {

enum class StudyExecutor { local, slurm };

struct StudyOptions {
    std::filesystem::path folder;
    std::filesystem::path store;        ///< where cells are kept
    std::vector<std::string> only;      ///< cells whose name fits one of these, * and ? allowed; empty: all
    std::optional<KnownFailures> known; ///< over all cells
    bool strict = false;                ///< refuse lamp files with which readings are meaningless
    bool resume = false;                ///< go on in the study's folder
    bool timed = false;                 ///< play cells one after another by themselves, and time them; none is taken from the store
    bool times_too = false;             ///< play the study's timed_cells by themselves, too, when all others are there
    int jobs = 0;                       ///< cells at a time on this machine; 0: as jobs_for() says
    std::vector<std::pair<std::string, std::string>> expected; ///< with play_into_store: cells and the keys that a plan gave them
    StudyResources resources;                                  ///< of each cell: the study's, but for what flags say
    StudyExecutor executor = StudyExecutor::local;
    int per = 1;    ///< cells for each command of a plan, and for each task of a cluster
    RunOptions run; ///< backend, moments, baselines, repeats, day, quiet, accuracy, command; the folder is each cell's own
    std::function<void(const Report&, const std::filesystem::path&)> judge_cell; ///< a cell's files become those of what it was judged
    std::function<void(StudyResult&)> write; ///< into the folder, before it is marked as complete; may add verdicts
};

/// Those of a study's cells whose names fit one of the patterns, all where there is none. Throws InputError for one that fits no cell.
std::vector<StudyCell> chosen_cells(const Study& study, const std::vector<std::string>& only);

/// Reads all drives and lamps first, plays the cells that the store lacks, collects all, compares. A cell that fails, hangs, runs out of
/// memory or crashes is noted and the others go on; SIGINT and SIGTERM end the study. Throws InputError and DeviceError where nothing can
/// be played, or where a folder to go on in holds another study.
StudyResult run_study(const Study& study, const StudyOptions& options);

/// Collects what lies in the store, and plays nothing: a cell that it lacks is red, with its command.
StudyResult collect_study(const Study& study, const StudyOptions& options);

/// In this process, one after another, into the store, those of the chosen cells that it lacks. What fails is told on standard error and
/// kept in the store as the reason. True where all are there.
bool play_into_store(const Study& study, const StudyOptions& options);

/// The command that does so for one cell or for several (places in the plan), on any machine that sees the files and the store.
std::vector<std::string> playing_command(const Study& study, const StudyPlan& plan, const std::vector<std::size_t>& cells,
                                         const StudyOptions& options);

/// Throws InputError with the lamp's line in the study's file where `aim: auto` stands beside a file that has nothing to aim by. run_study
/// asks for it, too.
void refuse_unaimable(const Study& study);

} // namespace fernlicht
