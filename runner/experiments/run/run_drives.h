// A whole run: each drive with each of its lamp sets, on one device, into one report.
#pragma once

#include "renderer/renderer.h"
#include "runner/findings/document.h"
#include "runner/judge/known_failures.h"
#include "runner/play/play.h"

#include <functional>

namespace fernlicht {

struct RunOptions {
    std::string backend = "auto";
    std::filesystem::path folder; ///< for the report; made when all input is read and the device is found sane
    LightPass light_pass = LightPass::automatic;
    TickRange ticks;
    bool quiet = false;
    bool profile = false;            ///< time each pass by finishing after it; frame times are then not representative
    std::filesystem::path baselines; ///< accepted results to judge against; "" for none
    bool across_devices = false;     ///< where this device class has none, by those of others
    int repeats = 1;                 ///< plays of each lamp set; all must agree
    std::optional<KnownFailures> known;
    std::string today;          ///< 2026-12-31: by which known failures expire
    bool strict = false;        ///< refuse lamp files with which readings are meaningless
    std::string no_times;       ///< why no times are taken; "": they are
    bool judged = true;         ///< false: verdicts are left to who reads the results, but for those of repeats
    bool accuracy = true;       ///< hold a few moments of each lamp set against the reference
    bool contact_sheet = false; ///< add one moment of each lamp set, drawn in every technique
    std::vector<std::string> command;
    std::vector<std::string> choice; ///< what the command needs at its end to play these drives alone: "--only", "straight_xenon"
    std::function<void(const Report&, const std::filesystem::path& folder)> write; ///< at the end, or what was done until then
    TakePlot write_plot;                                                           ///< takes contact sheets
};

/// Plays the drives and hands the report over to be written, also when interrupted (SIGINT, SIGTERM) or stopped by an error, in which case
/// what was done is kept, marked incomplete, and the error is thrown on.
Report run_drives(const std::vector<Drive>& drives, const RunOptions& options);

/// Reports and folders tell drives apart by their names. Throws InputError for two of one name.
void refuse_equal_names(const std::vector<Drive>& drives);

} // namespace fernlicht
