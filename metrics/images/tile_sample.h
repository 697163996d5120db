// Pictures compared by some of their tiles, drawn at random: which come next, and how many a precision takes.
#pragma once

#include "metrics/images/pixel_errors.h"

#include <cstdint>
#include <vector>

namespace fernlicht {

/// Of one of several pictures of one size.
struct SampledTile {
    int picture = 0, column = 0, row = 0;
};

/// All tiles of `pictures` pictures of `across` times `down`, in rounds of `down`: each round has one tile of each row, at random among all
/// pictures and without repeats. Rows, as what a picture of a road is off by changes with the distance that a row shows.
std::vector<SampledTile> sampling_order(int pictures, int across, int down, std::uint64_t seed);

/// How many of `all` rounds bring an interval of half width `now`, found with `rounds` of them, to `wanted`: it falls as
/// sqrt(1 / rounds - 1 / all). A tenth more than that, as `now` is an estimate; more than `rounds`, at most `all`.
int rounds_for(double now, double wanted, int rounds, int all);

/// How many of `all` rounds make the error that 95 % of the pixels do not exceed known: the half width of its interval at most `precision`
/// of it, or the reference's noise. `rounds` where that many did.
int rounds_wanted(const PixelErrors& errors, double precision, int rounds, int all);

} // namespace fernlicht
