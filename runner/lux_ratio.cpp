#include "runner/lux_ratio.h"

#include "runner/lamp_against.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {

std::string lux_ratio_svg(const LuxMap& now, const LuxMap& before, const std::string& title) {
    constexpr double faintest_lx = 0.1;
    if (now.lx.width() != before.lx.width() || now.lx.height() != before.lx.height())
        return {};
    Image<float> ratio(now.lx.height(), now.lx.width());
    for (int y = 0; y < now.lx.height(); ++y)
        for (int x = 0; x < now.lx.width(); ++x) {
            const double a = static_cast<double>(now.lx.at(x, y)), b = static_cast<double>(before.lx.at(x, y));
            const bool lit = std::max(a, b) >= faintest_lx;
            ratio.at(now.lx.height() - 1 - y, x) =
                lit ? static_cast<float>(std::max(a, 1e-6) / std::max(b, 1e-6)) : std::numeric_limits<float>::quiet_NaN();
        }
    const plots::Axis axis = ratio_axis(ratio);
    plots::Figure figure;
    figure.title = title;
    figure.subtitle =
        fmt::format("after {:.2f} s; blue is less, orange more light; grey: below {:g} lx with both", now.time_s, faintest_lx);
    figure.x = {"ahead of the car's origin", "m", -now.behind_m, now.ahead_m};
    figure.y = {"to the left", "m", -now.right_m, now.left_m};
    figure.width_px = 1140.0;
    figure.height_px = std::clamp(130.0 + 990.0 * (now.left_m + now.right_m) / (now.ahead_m + now.behind_m), 300.0, 900.0);
    figure.equal_units = true;
    figure.colour_bar = plots::ColourBar{axis, true};
    figure.rasters.push_back({plots::difference_map(ratio, axis, {225, 225, 225}), -now.behind_m, now.ahead_m, now.left_m, -now.right_m});
    return plots::svg_of(figure);
}

} // namespace fernlicht
