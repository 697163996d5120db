// JPEG in memory, by libjpeg.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

struct JpegPicture {
    int width = 0, height = 0;
    int channels = 0;                ///< grey, or RGB; CMYK becomes RGB, and an orientation in EXIF turns nothing
    std::vector<std::uint8_t> bytes; ///< rows from the top
};

/// `check` sees the picture before there is memory for pixels, and throws where it is not wanted. Throws std::runtime_error with a reason
/// for what is no JPEG or damaged. Where pixels lack they are grey: libjpeg goes on.
JpegPicture decode_jpeg(std::string_view bytes, const std::function<void(const JpegPicture&)>& check);

/// Of an RGB picture, with as many samples of colour as of light; `quality` from 1 to 100. The same pixels give the same bytes. Throws
/// std::runtime_error.
std::string encode_jpeg(const JpegPicture& picture, int quality);

} // namespace fernlicht
