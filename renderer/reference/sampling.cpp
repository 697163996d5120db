#include "renderer/reference/sampling.h"

#include <cmath>
#include <numbers>

namespace fernlicht::reference {
namespace {

constexpr std::uint32_t reversed(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00FF00FFU) << 8) | ((x & 0xFF00FF00U) >> 8);
    x = ((x & 0x0F0F0F0FU) << 4) | ((x & 0xF0F0F0F0U) >> 4);
    x = ((x & 0x33333333U) << 2) | ((x & 0xCCCCCCCCU) >> 2);
    return ((x & 0x55555555U) << 1) | ((x & 0xAAAAAAAAU) >> 1);
}

/// Each bit of the result depends on the bits below it alone: on reversed bits this is a nested uniform scramble.
constexpr std::uint32_t scrambled_upwards(std::uint32_t x, std::uint32_t key) {
    x ^= x * 0x3D20ADEAU;
    x += key;
    x *= (key >> 16) | 1U;
    x ^= x * 0x05526C56U;
    x ^= x * 0x53A22864U;
    return x;
}

/// Second dimension of Sobol's sequence (Sobol 1967, polynomial x + 1), bits reversed: Pascal's triangle modulo 2 over the bits of the
/// index, in the five factors that Lucas's theorem splits it into.
constexpr std::uint32_t second_sobol_reversed(std::uint32_t index) {
    index ^= index >> 16;
    index ^= (index & 0xFF00FF00U) >> 8;
    index ^= (index & 0xF0F0F0F0U) >> 4;
    index ^= (index & 0xCCCCCCCCU) >> 2;
    return index ^ ((index & 0xAAAAAAAAU) >> 1);
}

double unit(std::uint32_t bits) { return (static_cast<double>(bits) + 0.5) * 0x1p-32; }

} // namespace

glm::dvec2 PointNet::point(std::uint32_t index, std::uint32_t pair) const {
    const std::uint64_t order_key = mixed(key_, 2 * std::uint64_t{pair}), value_key = mixed(key_, 2 * std::uint64_t{pair} + 1);
    // Shuffling: the index's own bits, highest first, are scrambled; the first 2^k points stay a net.
    const std::uint32_t shuffled = reversed(scrambled_upwards(reversed(index), static_cast<std::uint32_t>(order_key)));
    // The radical inverse of the index is its bits reversed; reversed once more for the scramble, which goes upwards, they are the index.
    const std::uint32_t x = scrambled_upwards(shuffled, static_cast<std::uint32_t>(value_key)),
                        y = scrambled_upwards(second_sobol_reversed(shuffled), static_cast<std::uint32_t>(value_key >> 32));
    return {unit(reversed(x)), unit(reversed(y))};
}

glm::dvec2 on_disc(const glm::dvec2& square) {
    const double a = 2.0 * square.x - 1.0, b = 2.0 * square.y - 1.0;
    if (a == 0.0 && b == 0.0)
        return {0.0, 0.0};
    const bool wide = std::abs(a) > std::abs(b);
    const double radius = wide ? a : b,
                 angle = wide ? 0.25 * std::numbers::pi * b / a : 0.5 * std::numbers::pi - 0.25 * std::numbers::pi * a / b;
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

} // namespace fernlicht::reference
