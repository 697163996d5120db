// What of a block of a picture is a symmetric filter of another picture, by weighted least squares.
#pragma once

#include "scenarios/values/image.h"

#include <vector>

namespace fernlicht {

inline constexpr int block_side_px = 32; ///< power of 2; neighbours overlap by half

/// Values of a block, row after row.
using Block = std::vector<double>;

/// The block whose top left pixel is (left, top); beyond its edges the picture is mirrored. The picture is not empty.
Block block_at(const Image<double>& picture, int left, int top);

/// sin(pi (x + 1/2) / side) along x times the same along y; the squares of those of half-overlapping blocks add to 1.
const Block& block_window();

/// One value for each pair of points (dx, dy) and (-dx, -dy) with |dx|, |dy| <= reach: the mean of the picture at both. A filter made of
/// them is symmetric, so its transfer function is real: it blurs or sharpens and moves nothing.
std::vector<Block> symmetric_shifts(const Image<double>& picture, int left, int top, int reach);

/// `block` less its level and slope, weighted by the squared window.
void remove_slope(Block& block);

/// Sum of squares, weighted by the squared window.
double energy_of(const Block& block);

/// The combination of `parts` nearest to `target`, both without slope, in squares weighted by the squared window. A coefficient of 1 costs
/// `price` (ridge regression, Hoerl and Kennard 1970), so that next to nothing is not blown up to explain something; 0 gives zeros.
Block nearest_combination(const Block& target, const std::vector<Block>& parts, double price);

} // namespace fernlicht
