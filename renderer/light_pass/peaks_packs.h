// Loops that ask a core for one thing alone, over packs. What they return depends on all that they did.
#pragma once

#include "scenarios/packs/level.h"

#include <cstddef>

namespace fernlicht::packs {

AT_EACH_LEVEL(
    /// to = a + b of `count` numbers, a multiple of most_lanes.
    void stream(const float* a, const float* b, float* to, std::size_t count);
    /// `steps` packs of look-ups of two neighbours, along a table of `count` numbers, more than most_lanes, and again.
    float look_up(const float* table, std::size_t count, std::size_t steps);
    /// Of each of chains_of_sums packs, `steps` times: x a + b.
    float multiply_and_add(float a, float b, std::size_t steps);
    /// Of each of chains_of_quotients packs, `steps` times: a / x.
    float divide(float a, std::size_t steps);)

/// Independent of one another: more than an operation takes cycles.
inline constexpr std::size_t chains_of_sums = 12, chains_of_quotients = 8;

} // namespace fernlicht::packs
