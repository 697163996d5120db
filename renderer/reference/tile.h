// A square of pixels, drawn by one thread. What it gives depends on the shot and its place alone.
#pragma once

#include "renderer/reference/shot.h"

namespace fernlicht::reference {

inline constexpr int tile_px = 16;

/// Draws the tile whose first pixel is (x0, y0) into `image`. Returns the rays cast; none for a tile that was left because a stop was asked
/// for, whose pixels are as if never drawn.
std::uint64_t draw_tile(const Shot& shot, int x0, int y0, ReferenceImage& image);

} // namespace fernlicht::reference
