// A comparison as text for a terminal, as JSON (compare.schema.json), and as pictures in a folder.
#pragma once

#include "runner/experiments/compare/picture_comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fernlicht {

std::string comparison_text(const PictureComparison& comparison, const PicturePair& pair);
/// `pictures`: names of the files beside it.
std::string comparison_json(const PictureComparison& comparison, const PicturePair& pair, const std::vector<std::string>& pictures);

/// PNG files that show the difference, and SVG files of what is made of lines, in `folder`, which exists; their names. Throws DeviceError
/// where they cannot be written.
std::vector<std::string> write_comparison_pictures(const PictureComparison& comparison, const PicturePair& pair,
                                                   const std::filesystem::path& folder);

} // namespace fernlicht
