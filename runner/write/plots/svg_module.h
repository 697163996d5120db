// What the module fernlicht-svg does: it alone is linked with librsvg and cairo.
#pragma once

#include "runner/findings/plots/colour.h"
#include "scenarios/values/image.h"

#include <string>

namespace fernlicht::plots {

/// The drawing at `scale` times its own size, over the picture in `pixels`, which is as large, or on white where it is empty. Throws
/// std::invalid_argument with librsvg's reason when it is no valid SVG.
extern "C" using DrawSvg = void(const std::string& svg, double scale, Image<Colour>& pixels);

/// The drawing `width_pt` points wide for print, as PDF or as SVG; letters are embedded as glyphs. The same drawing gives the same bytes.
/// Throws as above.
extern "C" using PrintSvg = void(const std::string& svg, double width_pt, bool as_pdf, std::string& printed);

} // namespace fernlicht::plots
