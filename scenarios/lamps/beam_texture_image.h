// Pictures in memory as PNG or EXR bytes: the only door to OpenImageIO for lamps.
#pragma once

#include "scenarios/values/image.h"

#include <filesystem>
#include <map>
#include <string>

namespace fernlicht {

struct TextureImage {
    Image<float> value;                            ///< one channel, or the luminance of three; not checked for NaN
    bool was_coloured = false;                     ///< the three differed somewhere
    std::string pixel_type;                        ///< "uint8", "half" ...
    std::map<std::string, std::string> attributes; ///< string metadata
};

/// Throws InputError: not decodable, or more than `max_pixels`.
TextureImage decode_texture(const std::filesystem::path& path, const std::string& bytes, std::size_t max_pixels);

/// A float EXR with one channel. Throws std::runtime_error when the library cannot.
std::string encode_texture(const Image<float>& value, const std::string& channel, const std::map<std::string, std::string>& attributes);

} // namespace fernlicht
