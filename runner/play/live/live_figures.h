// What a live run lost and how punctual it was.
#pragma once

#include "runner/files/described_json.h"
#include "runner/play/live/can_socket.h"
#include "runner/play/live/tick_clock.h"

#include <filesystem>

namespace fernlicht {

struct LiveFigures {
    std::string interface;     ///< "can0"; "": a recording, at its own pace
    std::filesystem::path log; ///< that recording
    bool waited = true;        ///< false: as fast as it went, which says nothing of lateness
    double period_s = 0.0;     ///< of the control ticks
    double listened_s = 0.0;   ///< before the drive's 0 s
    std::int64_t start_ns = 0; ///< stamp (since the epoch) of the drive's 0 s, in the recording and on the bus
    std::uint64_t ticks_planned = 0;
    std::vector<double> late_s; ///< by tick: begin of its work after its time
    std::vector<double> work_s; ///< by tick: reading, laws, actuators, sending
    std::uint64_t overruns = 0; ///< ticks whose work ended after the next one's time
    Punctuality punctuality;
    std::int64_t clock_set_by_ns = 0;

    std::uint64_t used = 0;        ///< frames that were handed to the mapping; they are what is recorded
    std::uint64_t late = 0;        ///< of them those that came after the tick of their stamp, and counted for the next
    double latest_s = 0.0;         ///< the largest time that one came behind its tick
    std::uint64_t from_future = 0; ///< stamped after they were read
    std::uint64_t unused = 0;      ///< came after the last tick
    CanSocketFigures socket;       ///< its outages in ns from the drive's 0 s
    std::uint64_t outputs = 0;     ///< frames that were due

    std::filesystem::path recording; ///< of what was used, as a path from the report's folder, or absolute
    std::uint64_t recorded = 0, not_recorded = 0;
    std::string replay; ///< the command that plays the same drive again

    bool drawing = true;
    int moments = 0, drawn = 0;     ///< of the drive until it ended
    int captures = 0, captured = 0; ///< of them those that the drive wants stored

    /// Of late_s or work_s; type 7. 0 without ticks.
    static double quantile(std::vector<double> samples, double share);
};

/// A stamp as candump writes it: "1436509052.249713".
std::string candump_stamp(std::int64_t time_ns);

/// Live figures for programs; times of outages from the drive's 0 s.
JsonMembers live_members(LiveFigures& live);
inline nlohmann::ordered_json live_json(const LiveFigures& live) { return as_json(live, live_members); }
/// For a terminal: a few lines.
std::string live_text(const LiveFigures& live);

} // namespace fernlicht
