// Where samples lie: nets of points that a seed scrambles, the same on every machine and for any number of threads.
//
// Points are the first two dimensions of Sobol's sequence, with Owen's nested scrambling done by a hash (Laine and Karras 2011, constants
// of Vegdahl 2021) and the order of points shuffled by the same means, a pair of dimensions at a time (Burley 2020, "Practical Hash-based
// Owen Scrambling"). The first 2^k points of a net are a (0, k, 2)-net in base 2: one in each elementary interval. Each single point is
// uniform over the unit square, because a uniform 32-bit key is added in the hash: means are unbiased. Nets of different keys are
// independent as far as the hash (finaliser of MurmurHash3 in its 64-bit form "mix13" of Stafford 2011) is.
#pragma once

#include "scenarios/values/mixed_bits.h"

#include <cstdint>
#include <glm/vec2.hpp>

namespace fernlicht::reference {

/// 64 well-mixed bits of a key and a number. Chains: mixed(mixed(seed, pixel), replicate).
constexpr std::uint64_t mixed(std::uint64_t key, std::uint64_t number) { return fernlicht::mixed(key + mixing_step * (number + 1)); }

/// A scrambled sequence of points in as many dimensions as are asked for, two at a time.
class PointNet {
  public:
    explicit PointNet(std::uint64_t key) : key_(key) {}

    /// Coordinates 2 * pair and 2 * pair + 1 of a point, each in (0, 1).
    glm::dvec2 point(std::uint32_t index, std::uint32_t pair) const;

  private:
    std::uint64_t key_;
};

/// Uniform over the unit disc, area-preserving (Shirley and Chiu 1997).
glm::dvec2 on_disc(const glm::dvec2& square);

} // namespace fernlicht::reference
