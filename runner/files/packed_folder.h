// The files of a folder as one text, and back: one line of JSON with their names and sizes, then their bytes one after another.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace fernlicht {

using PackedFiles = std::map<std::string, std::string>; ///< contents by names below the folder: "frames/a.png"

/// All regular files below the folder. Throws InputError where one cannot be read.
PackedFiles files_below(const std::filesystem::path& folder);

std::string packed(const PackedFiles& files);

/// `from` only for messages. Throws InputError for a text that packed() did not make, and for names that lead out of the folder.
PackedFiles unpacked(const std::string& text, const std::filesystem::path& from);

/// Below the folder, which is made. Throws DeviceError.
void write_files(const PackedFiles& files, const std::filesystem::path& folder);

} // namespace fernlicht
