// The play loop: the only loop over time. Moments are drawn, measured and, some of them, stored.
#pragma once

#include "runner/capture.h"

#include <limits>

namespace fernlicht {

/// Whatever draws a view of a moment: the renderer, or in tests any callable.
using Draw = std::function<Pending(const Moment&, const View&, const Wanted&)>;

/// Ticks first..last, both included.
struct TickRange {
    int first = 0, last = std::numeric_limits<int>::max();
};

struct PlayOptions {
    TickRange ticks;
    std::filesystem::path folder;                                   ///< of the report; frames go below it
    int warm_up = 3;                                                ///< frames whose times are dropped
    std::function<bool(int done)> go_on = [](int) { return true; }; ///< called after each moment; false stops with what was done
};

/// Number of ticks of the drive that lie in the range.
int ticks_to_play(const Drive& drive, TickRange range);

/// Plays one lamp set of a drive. Readings and verdicts are left to the caller.
PlayedVariant play(const Drive& drive, const Route& route, const Variant& variant, const PlayOptions& options, const Draw& draw,
                   Writers& writers);

} // namespace fernlicht
