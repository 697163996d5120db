#include "runner/findings/plots/sheets.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

Image<plots::Colour> pixels_of(const Image<Rgb8>& picture) {
    Image<plots::Colour> out(picture.width(), picture.height());
    std::ranges::transform(picture.pixels(), out.data(), [](const Rgb8& p) { return plots::Colour{p.r, p.g, p.b}; });
    return out;
}

Image<plots::Colour> enlarged(const Image<plots::Colour>& picture, int factor) {
    Image<plots::Colour> out(picture.width() * factor, picture.height() * factor);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) = picture.at(x / factor, y / factor);
    return out;
}

double rounded_up(double value) {
    if (!(value > 0.0))
        return 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (value <= digit * power * (1.0 + 1e-12))
            return digit * power;
    return 10.0 * power;
}

SheetLegend legend_of(const plots::Axis& axis) {
    SheetLegend legend{axis.unit.empty() ? axis.label : axis.label + " [" + axis.unit + "]", false, {}};
    for (const plots::Tick& tick : plots::ticks_of(axis, 12))
        legend.ticks.emplace_back(plots::position(axis, tick.value), tick.label);
    return legend;
}

double SignedScale::position(double difference) const {
    const double size = std::abs(difference) / top;
    const double t = size > 0.0 ? std::clamp(1.0 + std::log10(size) / plots::signed_decades, 0.0, 1.0) : 0.0;
    return difference < 0.0 ? -t : t;
}

plots::Colour SignedScale::colour(double difference) const { return plots::diverging(position(difference)); }

SheetLegend SignedScale::legend(const std::string& label, const std::string& unit) const {
    SheetLegend legend{label + " [" + unit + "], log scale", true, {}};
    for (const double decade : {1.0, 0.1, 0.01}) {
        legend.ticks.emplace_back(0.5 + 0.5 * position(decade * top), "+" + plots::number(decade * top));
        legend.ticks.emplace_back(0.5 - 0.5 * position(decade * top), "-" + plots::number(decade * top));
    }
    legend.ticks.emplace_back(0.5, "0 \u00b1 " + plots::number(top * std::pow(10.0, -plots::signed_decades)));
    return legend;
}

} // namespace fernlicht
