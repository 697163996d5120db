// Reading an OpenSCENARIO XML file, version 1.0 to 1.3; which one a drive plays, and how.
#pragma once

#include "scenarios/openscenario/storyboard.h"

namespace fernlicht::osc {

struct StoryboardOptions {
    bool lenient = false;                                 ///< what is not supported is left out, each with a note
    std::vector<std::filesystem::path> road_folders = {}; ///< where a road is looked for that is not where the file says
    std::map<std::string, std::string> parameters = {};   ///< values for parameters that the file declares
    std::filesystem::path road = {};                      ///< in place of the road that the file names, which need not be there
};

/// Throws InputError, file and line first: not XML, no scenario (a catalog, a distribution), another version, unknown references, values
/// out of range; and, unless lenient, what is not supported, with the number of further places.
Storyboard read_storyboard(const std::filesystem::path& path, const StoryboardOptions& options = {});

/// The road file as the scenario names it, from its own folder; or, in each folder, the longest tail of that path that leads to a file:
/// for /a/b/road.xodr and folder /r, /r/a/b/road.xodr, then /r/b/road.xodr, then /r/road.xodr. Empty where nothing is found.
std::filesystem::path find_road(const std::filesystem::path& named, const std::vector<std::filesystem::path>& folders);

/// One value for each parameter, as a variation file (ParameterValueDistribution) gives them.
struct Variations {
    std::filesystem::path scenario;
    std::vector<std::map<std::string, std::string>> cases;
};
/// Deterministic distributions: single parameters are crossed with each other, the last one fastest. Throws InputError for stochastic ones
/// and for more than 10 000 cases.
Variations read_variations(const std::filesystem::path& path, FilesRead& opened);

} // namespace fernlicht::osc

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
    double max_s = 60.0;                            ///< longest time played
    bool own_daylight = false, own_weather = false; ///< the drive says them, so that the environment does not
    std::optional<SkySite> site;                    ///< nullopt: the road's geoReference, else a place of ours
    double day_rate = 1.0;                          ///< seconds of an animated time of day for a second of the drive
};

} // namespace fernlicht
