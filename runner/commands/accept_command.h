// `fernlicht accept RUN_FOLDER [--baselines FOLDER]`: makes a run's results the baseline of later runs. Judges nothing.
#pragma once

#include "runner/judge/baseline.h"
#include "runner/judge/baseline_store.h"

namespace fernlicht {

/// A run's results as they would be accepted, one for each lamp set of each drive: readings (times left out) with their spread over the
/// run's repeats, and captured EXR frames. Of a study's folder: of all its cells. Of a folder of `fernlicht reference`: its one picture
/// with each pixel's variance. Throws InputError for a folder without a complete run.
std::vector<Baseline> read_run(const std::filesystem::path& run_folder);

struct Accepted {
    std::vector<Baseline> baselines;
    std::vector<Stored> stored;      ///< one for each baseline
    std::vector<std::string> others; ///< short ids of what was accepted for other inputs, a former lamp say: it stays
};
/// `readings_only` leaves the frames out. Throws as read_run and store_baselines; what was accepted before then still holds.
Accepted accept_run(const std::filesystem::path& run_folder, const std::filesystem::path& baselines_folder,
                    Acceptance how = Acceptance::first, const std::string& note = "", bool readings_only = false);

} // namespace fernlicht
