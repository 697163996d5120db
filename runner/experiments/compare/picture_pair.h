// Two pictures to be compared, read from disk.
#pragma once

#include "scenarios/drives/play/frame.h"
#include "scenarios/values/files.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fernlicht {

/// One quantity of two linear pictures.
struct LinearPair {
    std::string name; ///< the channel's: illuminance.lx, luminance.cdm2 ...
    std::string unit; ///< lx, cd/m2, m; the name's end otherwise, "" where it has none
    Image<float> reference, tested;
};

/// Either display pictures (PNG; 8 bits) or linear ones (EXR), of one size.
struct PicturePair {
    std::filesystem::path reference, tested;
    int width = 0, height = 0;
    Image<Rgb8> reference_display, tested_display; ///< empty for linear pictures
    std::vector<LinearPair> linear;                ///< empty for display pictures
    std::vector<std::string> alone;                ///< channels that one file alone has, where that is allowed
    std::vector<std::string> notes;                ///< what is not known of the pair, one sentence each
    bool is_display() const { return !reference_display.empty(); }
};

/// PNG and EXR are told by their first bytes, others by their extension. Throws InputError naming the file: missing, no picture, cut short,
/// one of each kind, other sizes, other channels, values that are not finite. With `common_alone`, channels that one EXR alone has are left
/// out and named instead.
PicturePair read_picture_pair(const std::filesystem::path& reference, const std::filesystem::path& tested, bool common_alone = false);

/// Whether a file begins like a PNG or an EXR, or has the extension of another format that OpenImageIO reads. Throws InputError where it
/// cannot be read.
bool is_picture(const std::filesystem::path& path);

} // namespace fernlicht
