#include "scenarios/studies/sobol.h"

#include "scenarios/values/mixed_bits.h"

#include <array>
#include <bit>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr unsigned sobol_bits = 32;

/// Of a primitive polynomial: degree, inner coefficients as bits, first direction numbers.
struct SobolRow {
    unsigned degree;
    std::uint32_t inner;
    std::array<std::uint32_t, 6> first;
};

/// Dimensions 2 to 16 of new-joe-kuo-6.
constexpr std::array<SobolRow, max_sobol_dimensions - 1> sobol_rows{{{1, 0, {1}},
                                                                     {2, 1, {1, 3}},
                                                                     {3, 1, {1, 3, 1}},
                                                                     {3, 2, {1, 1, 1}},
                                                                     {4, 1, {1, 1, 3, 3}},
                                                                     {4, 4, {1, 3, 5, 13}},
                                                                     {5, 2, {1, 1, 5, 5, 17}},
                                                                     {5, 4, {1, 1, 5, 5, 5}},
                                                                     {5, 7, {1, 1, 7, 11, 19}},
                                                                     {5, 11, {1, 1, 5, 1, 1}},
                                                                     {5, 13, {1, 1, 1, 3, 11}},
                                                                     {5, 14, {1, 3, 5, 5, 31}},
                                                                     {6, 1, {1, 3, 3, 9, 7, 49}},
                                                                     {6, 13, {1, 1, 1, 15, 21, 21}},
                                                                     {6, 16, {1, 3, 1, 13, 27, 49}}}};

using Directions = std::array<std::uint32_t, sobol_bits>;

Directions directions_of(std::size_t dimension) {
    Directions v{};
    if (dimension == 0) {
        for (unsigned k = 0; k < sobol_bits; ++k)
            v[k] = std::uint32_t{1} << (sobol_bits - 1 - k);
        return v;
    }
    const SobolRow& row = sobol_rows[dimension - 1];
    for (unsigned k = 0; k < sobol_bits; ++k) {
        if (k < row.degree) {
            v[k] = row.first[k] << (sobol_bits - 1 - k);
            continue;
        }
        v[k] = v[k - row.degree] ^ (v[k - row.degree] >> row.degree);
        for (unsigned j = 1; j < row.degree; ++j)
            if (row.inner >> (row.degree - 1 - j) & 1U)
                v[k] ^= v[k - j];
    }
    return v;
}

} // namespace

std::vector<std::vector<double>> sobol_points(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
    if (dimensions == 0 || dimensions > max_sobol_dimensions)
        throw std::invalid_argument(fmt::format("sobol_points: {} dimensions, not 1 to {}", dimensions, max_sobol_dimensions));
    std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
    std::uint64_t state = seed;
    for (std::size_t d = 0; d < dimensions; ++d) {
        const Directions v = directions_of(d);
        std::uint32_t x = seed == 0 ? 0U : static_cast<std::uint32_t>(next_mixed(state) >> 32);
        for (std::size_t i = 0; i < count; ++i) {
            points[i][d] = static_cast<double>(x) / 4294967296.0; // 2^32
            x ^= v[static_cast<std::size_t>(std::countr_one(i)) % sobol_bits];
        }
    }
    return points;
}

} // namespace fernlicht
