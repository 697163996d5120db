// The beginning of a shipped drive with shadows of one's own, in a file of its own.
#pragma once

#include "tests/runner/program.h"

#include <regex>

namespace fernlicht {

/// 0.8 s of scenarios/library/drives/`drive`.yaml. `shadows`: the value of the key, which is the file's last line.
inline std::string short_drive(const TemporaryFolder& folder, const std::string& drive, const std::string& shadows) {
    std::string text = content_of(library_file("drives/" + drive + ".yaml"));
    for (std::size_t at = 0; (at = text.find("../", at)) != std::string::npos;)
        text.replace(at, 3, library_file(""));
    text = std::regex_replace(text, std::regex("\nduration_s: [0-9.]+"), "\nduration_s: 0.8");
    std::string path = folder / (drive + ".yaml");
    std::ofstream(path) << text << "shadows: " << shadows << "\n";
    return path;
}

} // namespace fernlicht
