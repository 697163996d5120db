// Which storyboard a drive plays, and how it is read.
#pragma once

#include "scenarios/openscenario/read_storyboard.h"

namespace fernlicht {

struct StoryboardSource {
    std::filesystem::path file; ///< OpenSCENARIO XML
    std::string ego = "Ego";    ///< the entity that is the own car
    osc::StoryboardOptions options;
    double most_s = 60.0;                           ///< longest time played
    bool own_daylight = false, own_weather = false; ///< the drive says them, so that the environment does not
};

} // namespace fernlicht
