#include "metrics/strictness/error_histogram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace fernlicht {
namespace {

const std::array<double, ErrorHistogram::bins + 1>& edges() {
    static const auto all = [] {
        std::array<double, ErrorHistogram::bins + 1> values{};
        for (int i = 0; i <= ErrorHistogram::bins; ++i)
            values[static_cast<std::size_t>(i)] =
                std::pow(10.0, std::log10(ErrorHistogram::lowest) + static_cast<double>(i) / ErrorHistogram::bins_per_decade);
        return values;
    }();
    return all;
}

} // namespace

double ErrorHistogram::edge(int i) { return edges().at(static_cast<std::size_t>(i)); }

std::size_t ErrorHistogram::pixels() const { return std::accumulate(counts.begin(), counts.end(), equal); }

ErrorHistogram error_histogram(const std::vector<Image<float>>& tested, const std::vector<Image<float>>& reference) {
    if (tested.empty() || tested.size() != reference.size())
        throw std::invalid_argument("pictures of different channels cannot be compared");
    for (std::size_t c = 0; c < tested.size(); ++c)
        for (const Image<float>* image : {&tested[c], &reference[c]})
            if (image->width() != tested[0].width() || image->height() != tested[0].height())
                throw std::invalid_argument("pictures of different sizes cannot be compared");
    ErrorHistogram histogram;
    histogram.counts.assign(ErrorHistogram::bins, 0);
    for (std::size_t i = 0; i < tested[0].size(); ++i) {
        double difference = 0.0;
        for (std::size_t c = 0; c < tested.size(); ++c) {
            const double d = std::abs(static_cast<double>(tested[c].pixels()[i]) - static_cast<double>(reference[c].pixels()[i]));
            if (!std::isfinite(d))
                throw std::invalid_argument("a picture holds a value that is not finite");
            difference = std::max(difference, d);
        }
        if (difference == 0.0) {
            ++histogram.equal;
            continue;
        }
        const auto above = std::upper_bound(edges().begin(), edges().end(), difference);
        const auto bin = std::clamp<std::ptrdiff_t>(above - edges().begin() - 1, 0, ErrorHistogram::bins - 1);
        ++histogram.counts[static_cast<std::size_t>(bin)];
    }
    return histogram;
}

} // namespace fernlicht
