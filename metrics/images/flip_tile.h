// FLIP of one tile of a picture: small enough to stay in a core's cache, written so that a compiler's vectors do the work.
#pragma once

#include "metrics/images/flip_filters.h"

#include <functional>
#include <vector>

namespace fernlicht::flip {

/// Where a tile's rows come from: linear RGB, 0..1, of `count` pixels of row `y` from column `x` on, all inside the picture.
using Rows = std::function<void(int y, int x, int count, float* r, float* g, float* b)>;

struct Tile {
    int x = 0, y = 0, width = 0, height = 0;
};

inline constexpr int tile_px = 128; ///< widest and highest

/// Buffers of one thread, kept from tile to tile.
struct TileMemory {
    std::vector<float> linear, opponent, across, reference, tested;
};

/// Whether pictures have colours at all: without, two thirds of the filters are left out, and r, g, b are the same row.
enum class Colours { all, grey };

/// Errors 0..1 of the tile's pixels, rows of tile_px. Beyond the picture's edges its last row or column goes on, as in the published tool.
/// The same bytes for any cut into tiles: each pixel is calculated in one order from the same neighbours.
void flip_of_tile(const Tile& tile, int picture_width, int picture_height, const Rows& tested, const Rows& reference,
                  const Filters& filters, Colours colours, TileMemory& memory, float* errors);

} // namespace fernlicht::flip
