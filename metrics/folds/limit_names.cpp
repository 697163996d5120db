#include "metrics/folds/limit_names.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <regex>

namespace fernlicht {

void check_limit_names(const Drive& drive, const Readings& others) {
    static const std::regex extent(
        R"((reach|unlit_before_reach|width|area)_[0-9a-z_.-]+lx_(road|target)_(own|all|(left|right)_\d+)(_\w+)?_(m|m2))");
    static const std::regex time(R"(\w+_time_(median|p95|spread)_ms)");
    for (const Limit& limit : drive.limits) {
        bool known = std::regex_match(limit.reading, extent) || std::regex_match(limit.reading, time);
        for (const Probe& probe : drive.probes)
            for (const char* suffix : {"_lx", "_min_lx", "_max_lx", "_twin_lx"})
                known = known || limit.reading == "probe_" + probe.name + suffix;
        known = known || std::ranges::any_of(others, [&](const Reading& reading) { return reading.name == limit.reading; });
        if (!known)
            throw InputError({drive.file, 0, 0, "limits"}, "found reading '" + printable(limit.reading) + "'",
                             "a name as reach_5lx_road_own_m, width_3lx_target_all_at_50m_m, probe_NAME_lx of a probe of this drive or "
                             "frame_time_median_ms");
    }
}

} // namespace fernlicht
