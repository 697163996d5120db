// The filters of FLIP along one axis. Each two-dimensional filter of the papers is a product, or a sum of two products, of these.
#pragma once

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

} // namespace fernlicht::flip
