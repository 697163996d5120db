// A run's folder, read back to be compared with another.
#pragma once

#include "runner/experiments/compare/runs/played_report.h"
#include "scenarios/drives/drive.h"
#include "scenarios/yaml/yaml_tree.h"

#include <map>

namespace fernlicht {

/// One drive with one lamp set.
struct RunDrive : PlayedResult {
    std::filesystem::path folder; ///< of the run
    std::string technique, title;
    std::vector<double> time_s; ///< of the moments played
    YamlValue resolved;         ///< the drive as it was played
    std::vector<View> views;
    ToneMapper tone_mapper;
    std::string road_hash;                             ///< of the road's file; "" where the report does not tell
    std::map<std::string, std::vector<double>> pass_s; ///< samples by pass, warm-up dropped
    std::map<std::string, std::string> hashes;         ///< of every file that the run opened, by path
};

struct RunFolder {
    std::filesystem::path folder;
    std::string command, started_utc, version, backend, gl_renderer, cpu;
    std::vector<RunDrive> drives;
};

/// Throws InputError: no folder of a run, a run that did not end, a report or a resolved drive that is missing or damaged.
RunFolder read_run_folder(const std::filesystem::path& folder);

} // namespace fernlicht
