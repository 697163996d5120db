#include "metrics/statistics/random_order.h"

#include <numeric>
#include <stdexcept>
#include <utility>

namespace fernlicht {

std::uint64_t below(std::uint64_t n, std::mt19937_64& generator) {
    if (n == 0)
        throw std::invalid_argument("below: there is no number below 0");
    // 2^64 mod n numbers are refused: what is left is a multiple of n, so that no remainder comes more often than another.
    const std::uint64_t refused = (std::uint64_t{0} - n) % n;
    std::uint64_t drawn = generator();
    while (drawn < refused)
        drawn = generator();
    return drawn % n;
}

std::vector<std::size_t> random_order(std::size_t n, std::mt19937_64& generator) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i)
        std::swap(order[i - 1], order[below(i, generator)]);
    return order;
}

} // namespace fernlicht
