// PNG in memory, by libpng.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fernlicht {

struct PngHead {
    int width = 0, height = 0;
    int channels = 0; ///< grey; grey and alpha; RGB; RGB and alpha, which is not multiplied in. Palettes are colours
    int bits = 8;     ///< 8 or 16; fewer are stretched to 8
    std::map<std::string, std::string> texts;
    std::string icc; ///< the profile, "" where there is none
};

struct PngPicture {
    PngHead head;
    std::vector<std::uint8_t> bytes; ///< samples of all channels, rows from the top; of 16 bits as this machine keeps them
};

/// Whether the chunks follow one another up to IEND.
bool is_whole_png(std::string_view bytes);

/// What stands before the pixels. Throws std::runtime_error with a reason for what is no PNG or is damaged there.
PngHead decode_png_head(std::string_view bytes);
/// `check` sees the head before there is memory for pixels, and throws where the picture is not wanted.
PngPicture decode_png(std::string_view bytes, const std::function<void(const PngHead&)>& check);

/// RGB in `bits` of 8 or 16, rows from the top, without libpng's filters, which are for photographs. Throws std::runtime_error.
struct PngPixels {
    int width = 0, height = 0, bits = 8;
    const void* rgb = nullptr;
};
std::string encode_png(const PngPixels& pixels, int zlib_level);
/// The same for pictures that say what they are: an ICC profile or, without one, sRGB; and texts.
std::string encode_png(const PngPixels& pixels, int zlib_level, const std::string& icc,
                       const std::vector<std::pair<std::string, std::string>>& texts);

} // namespace fernlicht
