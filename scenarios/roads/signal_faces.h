// What an OpenDRIVE file says of the faces of its signals: needed to draw signs, but for no measurement.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace fernlicht {

/// Of a country's catalogue of signs, as the file has it.
struct SignalFace {
    std::string country, type, subtype, value, text;
};

/// By road and signal id. A file that read_opendrive() has read.
std::map<std::pair<std::string, std::string>, SignalFace> read_signal_faces(const std::filesystem::path& path);

} // namespace fernlicht
