// The flags that are the same for `run` and `study`: which moments are played, and by what results are judged.
#pragma once

#include "runner/experiments/run/run_drives.h"

namespace CLI {
class App;
}

namespace fernlicht {

/// "FIRST:LAST", "FIRST:" or ":LAST" of --frames; all for "". Throws InputError naming the flag.
TickRange tick_range(const std::string& frames);

/// As typed.
struct JudgingFlags {
    std::string references, known, today;
    int repeats = 1;
    bool across_devices = false;
};

void add_judging_flags(CLI::App& command, JudgingFlags& flags);

/// Sets references, across_devices, repeats and today of `options`, and reads the list of known failures, where there is one. The only
/// place that asks the clock for the day. Throws InputError for flags without effect, what is no date, and a list that cannot be read.
std::optional<KnownFailures> take(const JudgingFlags& flags, RunOptions& options);

} // namespace fernlicht
