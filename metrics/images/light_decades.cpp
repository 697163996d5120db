#include "metrics/images/light_decades.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fernlicht {

Image<float> decades_of(const Image<float>& picture, double peak) {
    if (!(peak > 0.0 && std::isfinite(peak)))
        throw std::invalid_argument("decades of a picture need a peak above 0");
    const double darkest = peak * std::pow(10.0, -decades_below_peak);
    Image<float> out(picture.width(), picture.height());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto value = static_cast<double>(picture.pixels()[i]);
        out.pixels()[i] = value > darkest ? static_cast<float>(std::log10(value / peak) + decades_below_peak) : 0.0F;
    }
    return out;
}

double peak_of(const Image<float>& picture) {
    return picture.empty() ? 0.0 : std::max(0.0, static_cast<double>(*std::ranges::max_element(picture.pixels())));
}

} // namespace fernlicht
