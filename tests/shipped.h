// Where the files that ship with the program lie.
#pragma once

#include <filesystem>

namespace fernlicht {

inline const std::filesystem::path shipped_library = FERNLICHT_SOURCE_DIR "/scenarios/library", shipped_drives = shipped_library / "drives";

} // namespace fernlicht
