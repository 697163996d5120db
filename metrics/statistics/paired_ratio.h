// Is one way slower than another? Times taken in pairs, one pair a round, so that what slows a whole round down cancels.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace fernlicht {

enum class Difference { faster, slower, not_distinguishable };

struct PairedRatio {
    std::size_t rounds = 0;
    double median = 0.0, p05 = 0.0, p95 = 0.0; ///< of time / reference within a round; above 1: slower
    Difference difference = Difference::not_distinguishable;
};

/// Fewer rounds tell nothing: five ratios on one side of 1 come by chance in one case of 16, six in one of 32.
inline constexpr std::size_t fewest_rounds = 6;

/// Spread of the ratios over the rounds, and what they say. A difference is real only when it is larger than the spread: when 1 lies
/// outside p05 .. p95. Quantiles as those of spread_of, but of the ratios' logarithms, so that exchanging both ways inverts ratio and
/// spread and turns the verdict round. nullopt for no rounds. Throws std::invalid_argument when a time has no partner or is not finite and
/// above 0.
std::optional<PairedRatio> paired_ratio(const std::vector<double>& times, const std::vector<double>& reference);

} // namespace fernlicht
