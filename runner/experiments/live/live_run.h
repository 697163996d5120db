// A drive against the clock: inputs from a bus, outputs to it, pictures when there is time for them, and a report of what was lost.
#pragma once

#include "runner/findings/report.h"
#include "runner/play/live/live_figures.h"

#include <functional>

namespace fernlicht {

struct LiveOptions {
    std::string interface;        ///< "can0"; "" where there is a log
    std::filesystem::path log;    ///< a recording at its own pace, instead of an interface
    bool wait = true;             ///< false: of a recording, as fast as it goes, without pictures
    std::string lamp_set;         ///< "": the only one
    double listen_s = 0.5;        ///< to the bus, before the drive's 0 s
    int receive_buffer_bytes = 0; ///< of the socket; 0: chosen
    std::filesystem::path record; ///< where the frames used are recorded; "": in the report's folder
    bool draw = true;
    std::string backend = "auto";
    std::filesystem::path folder;             ///< of the report
    std::function<void(const Report&)> write; ///< the report into the folder, also of what was stopped
    std::vector<std::string> command;
};

/// Plays `drive` and has the report written, also when interrupted (SIGINT, SIGTERM; `complete` says so) or stopped by an error, which is
/// thrown on. Throws InputError for a drive without `can` and what its mapping lacks, DeviceError for what bus and device lack.
Report run_live(Drive drive, const LiveOptions& options);

} // namespace fernlicht
