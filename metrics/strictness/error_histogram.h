// How many pixels differ by how much: bins of a third of a decade, and apart from them those that do not differ at all.
#pragma once

#include "scenarios/values/image.h"

#include <cstddef>
#include <vector>

namespace fernlicht {

struct ErrorHistogram {
    /// Bin i holds differences from edge(i) up to below edge(i + 1); what is smaller or larger than all of them is in the end bins.
    static constexpr double lowest = 1e-6, highest = 1e6;
    static constexpr int bins_per_decade = 3, bins = 36;
    static double edge(int i); ///< lowest * 10^(i / 3); 0 <= i <= bins

    std::size_t equal = 0;           ///< pixels that do not differ
    std::vector<std::size_t> counts; ///< `bins` of them
    std::size_t pixels() const;      ///< all together
};

/// Of |tested - reference|; of several channels that of the worst. Throws std::invalid_argument for sizes or numbers of channels that
/// differ, and values that are not finite.
ErrorHistogram error_histogram(const std::vector<Image<float>>& tested, const std::vector<Image<float>>& reference);

} // namespace fernlicht
