// The first-light drive two seconds in, with its first lamps: what the benchmarks measure on.
#pragma once

#include "scenarios/drives/play/advance.h"

#include <fstream>
#include <iterator>
#include <string>

namespace fernlicht {

inline std::string library_path(const std::string& below) { return std::string(FERNLICHT_SOURCE_DIR "/scenarios/library/") + below; }

inline std::string text_of(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct CountryRoad {
    Drive drive = read_drive(library_path("drives/first-light.yaml"));
    RoadNetwork network = read_opendrive(drive.road_file);
    Route route{network, drive.start, drive.via};
    Moment moment = at(2.0);

    Moment at(double time_s) const {
        State state = start(drive);
        while (state.time_s < time_s)
            state = advance(state, drive);
        return moment_at(state, drive, route, drive.lamp_sets.front());
    }
};

/// Read once, when it is first asked for.
inline const CountryRoad& country_road() {
    static const CountryRoad road;
    return road;
}

} // namespace fernlicht
