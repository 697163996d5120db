// Pictures in formats other than PNG and EXR, read by OpenImageIO for comparison.
#pragma once

#include "runner/files/picture_file.h"

#include <string_view>

namespace fernlicht {

/// One of the two: codes of 8 bits, grey or RGB, or channels of numbers.
struct OtherPicture {
    Image<Rgb8> display;
    std::vector<PictureChannel> linear;
};

/// Extensions, in small letters, that OpenImageIO's formats have: .tif, .hdr, .tga ...
bool is_other_picture(const std::filesystem::path& path);

/// Throws InputError: missing, no picture, cut short, more than 2^28 values; DeviceError where the module is missing.
OtherPicture read_other_picture(const std::filesystem::path& path);

/// What the module fernlicht-openimageio does (runner/modules). Throws std::runtime_error with a reason.
extern "C" using ReadWithOpenImageIo = void(const std::filesystem::path& path, std::size_t max_values, OtherPicture& picture);

} // namespace fernlicht
