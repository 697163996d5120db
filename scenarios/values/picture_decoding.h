// Pictures in memory as PNG, JPEG or EXR bytes, as lamps and models want them.
#pragma once

#include "scenarios/values/image.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fernlicht {

struct TextureImage {
    Image<float> value;                            ///< one channel, or the luminance of three; not checked for NaN
    bool was_coloured = false;                     ///< the three differed somewhere
    std::string pixel_type;                        ///< "uint8", "half" ...
    std::map<std::string, std::string> attributes; ///< string metadata
    std::vector<std::string> channels = {};        ///< of an EXR: the names of those that were taken
};

/// Eight bits a channel as they stand in the file; grey as colour, opaque where there is no alpha (which is not multiplied in).
struct DecodedPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba; ///< rows from the top
};

/// PNG or JPEG within a file; `key` says where in it. Throws InputError: not decodable, or more than `max_pixels`.
DecodedPicture decode_picture(const std::filesystem::path& file, const std::string& key, const std::string& bytes, std::size_t max_pixels);

/// Throws InputError: not decodable, fewer than `least_side` pixels to a side, or more than `max_pixels`.
TextureImage decode_texture(const std::filesystem::path& path, const std::string& bytes, std::size_t max_pixels, int least_side = 2);

/// A float EXR with one channel. Throws std::runtime_error when the library cannot.
std::string encode_texture(const Image<float>& value, const std::string& channel, const std::map<std::string, std::string>& attributes);

} // namespace fernlicht
