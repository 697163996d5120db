// Pictures as a page embeds them: small enough for twelve moments of two lamps; the originals lie beside it.
#pragma once

#include "runner/findings/plots/colour.h"
#include "scenarios/values/image.h"

#include <cstdint>
#include <string>

namespace fernlicht {

/// The source of an <img>. A PNG of 8 bits in sRGB becomes a JPEG, at most `most_px` wide, pixels averaged as light; any other stays as it
/// is. Throws std::runtime_error for what is no PNG.
std::string embedded_picture(const std::string& png, int most_px = 640);

/// Lux codes (runner/findings/lux_codes.h) of up to three things in one PNG, in red, green and blue: base64. All of the first one's size.
std::string embedded_codes(const std::vector<const Image<std::uint8_t>*>& codes);

} // namespace fernlicht
