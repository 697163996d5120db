// What happens to a mounted lamp at a time: switched, dimmed, aimed, replaced.
#pragma once

#include "scenarios/lamps/mounted_lamp.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// At `time_s` the named lamps change; what is not given stays.
struct LampChange {
    double time_s = 0.0;
    std::string lamp; ///< name of a mounted lamp
    std::optional<double> level;
    std::optional<double> pitch_rad, yaw_rad, roll_rad;
    std::shared_ptr<const LampFile> file;
    std::optional<LampColour> colour;
    std::optional<SourceKind> source;
};

void apply(const LampChange& change, MountedLamp& lamp);

} // namespace fernlicht
