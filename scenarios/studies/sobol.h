// Points that fill a box evenly from the first one on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fernlicht {

inline constexpr std::size_t max_sobol_dimensions = 16;

/// The first `count` points of Sobol's sequence in [0, 1) to the power of `dimensions` (1 to 16), in the order of the Gray code, the
/// corner 0 first: S. Joe, F. Y. Kuo, "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30
/// (2008), 2635-2654, with their direction numbers new-joe-kuo-6. Powers of two fill the box best. A `seed` other than 0 moves all
/// points by one digital shift (exclusive or of their bits with bits of splitmix64), which keeps how evenly they lie. Throws
/// std::invalid_argument for other numbers of dimensions.
std::vector<std::vector<double>> sobol_points(std::size_t count, std::size_t dimensions, std::uint64_t seed = 0);

} // namespace fernlicht
