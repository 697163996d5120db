// Plots as SVG. No scripts, no outside resources, all text escaped; the same value gives the same bytes. Several may be put into one HTML
// page: there are no ids to clash.
#pragma once

#include "runner/findings/document.h"
#include "runner/write/plots/png.h"

namespace fernlicht::plots {

/// `zlib`: the level of pictures within; 0 for an SVG that is drawn and gone.
std::string svg_of(const Drawing& drawing, int zlib = drawing_zlib);

/// Complete and of the figure's size. Throws std::invalid_argument when an axis is empty (from == to, not finite, or not above 0 on a
/// logarithmic scale).
std::string svg_of(const Figure& figure, int zlib = drawing_zlib);
std::string svg_of(const FiguresBeside& figures, int zlib = drawing_zlib);

/// Small pictures are magnified by whole numbers without smoothing, large ones shrunk to 1024 pixels across.
std::string svg_of(const Sheet& sheet, int zlib = drawing_zlib);
/// Three tiles across.
std::string svg_of(const TileSheet& sheet, int zlib = drawing_zlib);

/// Error over run time, both logarithmic: rows with their bars, the front as a line, the floor shaded, dominated rows hollow.
std::string svg_of(const WorkPrecision& diagram, int zlib = drawing_zlib);

} // namespace fernlicht::plots
