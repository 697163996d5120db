// The play loop: the only loop over time. Moments are drawn, measured and, some of them, stored.
#pragma once

#include "runner/play/capture.h"

#include <iosfwd>
#include <limits>

namespace fernlicht {

/// Whatever draws a view of a moment: the renderer, or in tests any callable.
using Draw = std::function<Pending(const Moment&, const View&, const FrameOutputs&)>;

/// Ticks first..last, both included.
struct TickRange {
    int first = 0, last = std::numeric_limits<int>::max();
};

struct PlayOptions {
    std::ostream* log = nullptr; ///< takes the rows of every moment (drive_log.h)
    TickRange ticks;
    std::filesystem::path folder; ///< of the report; frames go below it
    std::string no_times;         ///< why none are taken, and nothing waits for one another to be timed; "": they are
    int warm_up = 3;              ///< moments whose times are dropped
    bool profile = false;         ///< nothing goes on beside the drawing, so that every time is its own
    std::function<bool(int done)> go_on = [](int) { return true; }; ///< called after each moment; false stops with what was done
};

/// What a stored frame of a view holds.
FrameOutputs stored_results(const View& view, const Capture& capture);

/// Number of ticks of the drive that lie in the range.
int ticks_to_play(const Drive& drive, TickRange range);

/// Plays one lamp set of a drive. Draws by the calling thread; measures and writes by others meanwhile, and waits for them in the end.
/// Holds as many pictures at a time for a long drive as for a short one. Where a frame comes without an illuminance that was asked for, the
/// technique computes none: there are no extents, lux maps and probes from it, and the reason stands in the result.
/// Of readings only the probes' are made here; verdicts are left to the caller. Throws what drawing, measuring or writing threw.
PlayedCell play(const Drive& drive, const Route& route, const LampSet& lamp_set, const PlayOptions& options, const Draw& draw,
                Writers& writers);

/// Why a reading of a technique without lux images is not measured.
std::string no_illuminance(const std::string& technique);

} // namespace fernlicht
