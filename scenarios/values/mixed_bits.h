// Random bits by their number alone: the same on every machine, whichever thread asks.
#pragma once

#include <cstdint>

namespace fernlicht {

/// What SplitMix64 (Steele, Lea and Flood 2014) adds to its state before each number.
constexpr std::uint64_t mixing_step = 0x9E3779B97F4A7C15ULL;

/// Its finaliser: 64 well-mixed bits of 64.
constexpr std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
}

/// Its next number.
constexpr std::uint64_t next_mixed(std::uint64_t& state) { return mixed(state += mixing_step); }

} // namespace fernlicht
