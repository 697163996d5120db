// FLIP of one tile of a picture: small enough to stay in a core's cache, written so that a compiler's vectors do the work.
// The filters of FLIP along one axis. Each two-dimensional filter of the papers is a product, or a sum of two products, of these.
#pragma once

#include <functional>
#include <vector>

namespace fernlicht::flip {

/// Weights at 0, 1 .. radius; the other side is the same (even) or its negative (odd).
struct HalfFilter {
    std::vector<float> weights;
    int radius() const { return static_cast<int>(weights.size()) - 1; }
};

struct Filters {
    // What the eye resolves in an opponent colour space (Andersson et al. 2020, section 4.1.1, table 1): a Gaussian for the lightness Y and
    // for the red-green Cx, the sum of a wide and a narrow one for the blue-yellow Cz. Each share is in the weights across; those down sum
    // to 1.
    HalfFilter y, cx;
    HalfFilter cz_wide_across, cz_wide_down, cz_narrow_across, cz_narrow_down;
    // Edges and points (section 4.2): a Gaussian and its first and second derivative, positive and negative weights summing to 1 each.
    HalfFilter gaussian; ///< even
    HalfFilter edge;     ///< odd
    HalfFilter point;    ///< even
    int radius = 0;      ///< the largest of all
};

/// For a view of `pixels_per_degree`, 1 to 1000. The colour filters end where the paper ends them, at three standard deviations
/// of the widest, or earlier where all that is left weighs less than 2^-26, which a float's sum does not see.
Filters filters_for(double pixels_per_degree);

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
