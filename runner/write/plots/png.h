// Pixels and drawings to PNG bytes, in memory.
#pragma once

#include "runner/findings/plots/colour.h"
#include "scenarios/values/image.h"

#include <string>

namespace fernlicht::plots {

/// 8-bit RGB, sRGB encoded. The same pixels give the same bytes. Throws std::runtime_error when the image is empty or too large (32767).
inline constexpr int drawing_zlib = 4; ///< drawings and maps have large areas of one colour
std::string png_of_pixels(const Image<Colour>& pixels, int zlib = drawing_zlib);

/// The drawing at `scale` times its own size in pixels. Throws std::invalid_argument with librsvg's reason when it is no valid SVG,
/// DeviceError where the module is missing.
std::string png_of_svg(const std::string& svg, double scale = 1.0);

/// The drawing over a picture of its size. Throws as png_of_svg does.
void draw_over(Image<Colour>& picture, const std::string& svg);

/// RFC 4648, with padding.
std::string base64(const std::string& bytes);

} // namespace fernlicht::plots
