// Which storyboard a drive plays, and how it is read.
#pragma once

#include "scenarios/openscenario/reader/read_storyboard.h"

namespace fernlicht {

/// Where the sky of a storyboard is looked at: its time of day has no place of its own.
struct SkySite {
    double latitude_deg = 0.0, longitude_deg = 0.0; ///< north and east positive
    std::optional<double> utc_offset_h;             ///< of times without one; nullopt: the longitude's, in whole hours

    bool operator==(const SkySite&) const = default;
};

struct StoryboardSource {
    std::filesystem::path file; ///< OpenSCENARIO XML
    std::string ego = "Ego";    ///< the entity that is the own car
    osc::StoryboardOptions options;
    double most_s = 60.0;                           ///< longest time played
    bool own_daylight = false, own_weather = false; ///< the drive says them, so that the environment does not
    std::optional<SkySite> site;                    ///< nullopt: the road's geoReference, else a place of ours
    double day_rate = 1.0;                          ///< seconds of an animated time of day for a second of the drive
};

} // namespace fernlicht
