// Frames that others drew, as luminance: a folder of PNG or EXR files with numbers in their names.
#pragma once

#include "scenarios/values/files.h"
#include "scenarios/values/image.h"

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace fernlicht {

struct SequenceFrames {
    std::vector<int> numbers;                 ///< rising by 1
    std::vector<Image<float>> luminance_cdm2; ///< of one size, finite, at least 0
    bool displayed = false;                   ///< PNG: on the reference display of sRGB, white 80 cd/m2. EXR: as the file has it
    FilesRead opened;
    std::filesystem::path first;    ///< its file
    std::vector<std::string> notes; ///< what is not known of how PNGs were shown, one sentence
};

inline constexpr int fewest_sequence_frames = 8, most_sequence_frames = 64;

/// The frames of a folder, or of its files whose names fit a last part with one '*' (frames/driver-*.exr), from number `first` to `last`,
/// nullopt: all. A file's number is the last run of digits before its extension;
/// other files are left alone. PNG: 8 bits, grey or RGB, decoded by IEC 61966-2-1. EXR: luminance.cdm2, else Y, else R, G and B weighed by
/// BT.709; below 0, which sharpening filters leave, counts as 0. Throws InputError: no such folder, PNG and EXR mixed, a number twice or
/// missing, fewer than 8 or more than 64, other sizes, less than 32 pixels each way, no channel of brightness, values that are not finite,
/// PNGs that were shown in different ways or for another display than sRGB.
SequenceFrames read_sequence(const std::filesystem::path& path_or_pattern, const std::optional<std::pair<int, int>>& range);

} // namespace fernlicht
