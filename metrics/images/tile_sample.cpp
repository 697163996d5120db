#include "metrics/images/tile_sample.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

std::vector<SampledTile> sampling_order(int pictures, int across, int down, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    const auto of_row = static_cast<std::size_t>(pictures * across), rows = static_cast<std::size_t>(down);
    std::vector<SampledTile> order(of_row * rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::vector<std::size_t> shuffled = random_order(of_row, generator);
        for (std::size_t round = 0; round < of_row; ++round) {
            const auto place = static_cast<int>(shuffled[round]);
            order[round * rows + row] = {place / across, place % across, static_cast<int>(row)};
        }
    }
    return order;
}

int rounds_for(double now, double wanted, int rounds, int all) {
    const double finite = 1.0 / all, ratio = wanted / now, needed = 1.1 / (ratio * ratio * (1.0 / rounds - finite) + finite);
    return std::min(all, std::max(rounds + 1, static_cast<int>(std::ceil(std::min(needed, static_cast<double>(all))))));
}

int rounds_wanted(const PixelErrors& errors, double precision, int rounds, int all) {
    if (rounds == all || errors.pixels == 0)
        return rounds;
    if (!errors.p95_between)
        return std::min(all, 2 * rounds);
    const double half_width = 0.5 * (errors.p95_between->high - errors.p95_between->low),
                 enough = std::max(precision * errors.error.p95, errors.floor.p95);
    if (half_width <= enough)
        return rounds;
    return enough > 0.0 ? rounds_for(half_width, enough, rounds, all) : all;
}

} // namespace fernlicht
