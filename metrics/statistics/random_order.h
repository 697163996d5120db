// Chance that is the same on every machine. std::mt19937_64 is specified to the bit; std::shuffle and the standard's distributions are not.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace fernlicht {

/// Evenly one of 0 .. n - 1. Throws std::invalid_argument for n = 0.
std::uint64_t below(std::uint64_t n, std::mt19937_64& generator);

/// 0 .. n - 1 in an order drawn evenly from all (Fisher and Yates 1938, in the form of Durstenfeld 1964, from the end).
std::vector<std::size_t> random_order(std::size_t n, std::mt19937_64& generator);

} // namespace fernlicht
