#include "runner/findings/plots/axes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>
#include <utility>

namespace fernlicht::plots {
namespace {

/// 1, 2 or 5 times a power of ten, at least `x`.
double round_step(double x) {
    const double decade = std::pow(10.0, std::floor(std::log10(x)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (digit * decade >= x * (1.0 - 1e-9))
            return digit * decade;
    return 10.0 * decade;
}

std::vector<Tick> linear_ticks(double low, double high, int most) {
    std::vector<Tick> ticks;
    if (!(high > low))
        return {{low, number(low)}};
    const double step = round_step((high - low) / most);
    const double slack = 1e-9 * step; // an end that is a multiple of the step up to rounding gets its tick
    for (double k = std::ceil((low - slack) / step); k * step <= high + slack && ticks.size() < 1000; k += 1.0)
        ticks.push_back({k * step, number(k * step)});
    return ticks;
}

std::vector<Tick> logarithmic_ticks(double low, double high, int most) {
    const double decades = std::log10(high / low);
    const int stride = std::max(1, static_cast<int>(std::ceil(decades / most)));
    const bool label_2_and_5 = 3.0 * decades <= most;
    std::vector<Tick> ticks;
    const int last = static_cast<int>(std::ceil(std::log10(high) - 1e-9));
    for (int e = static_cast<int>(std::floor(std::log10(low) + 1e-9)); e <= last; ++e) {
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * std::pow(10.0, e);
            if (value < low * (1.0 - 1e-9) || value > high * (1.0 + 1e-9))
                continue;
            const bool decade = digit == 1 && e % stride == 0;
            const bool labelled = decade || (label_2_and_5 && (digit == 2 || digit == 5));
            if (labelled || stride == 1)
                ticks.push_back({value, labelled ? number(value) : std::string{}});
        }
    }
    return ticks;
}

bool has_place(double value, Scale scale) { return std::isfinite(value) && (scale != Scale::logarithmic || value > 0.0); }

/// The ends, a tenth and a hundredth of them, and 0.
std::vector<Tick> signed_ticks(double top) {
    std::vector<Tick> ticks;
    for (const double share : {1.0, 0.1, 0.01}) {
        ticks.push_back({-share * top, number(-share * top)});
        ticks.push_back({share * top, "+" + number(share * top)});
    }
    ticks.push_back({0.0, "0 \u00b1 " + number(top * std::pow(10.0, -signed_decades))});
    std::ranges::sort(ticks, {}, &Tick::value);
    return ticks;
}

} // namespace

double position(const Axis& axis, double value) {
    if (!has_place(value, axis.scale))
        return std::numeric_limits<double>::quiet_NaN();
    if (axis.scale == Scale::logarithmic)
        return std::log(value / axis.from) / std::log(axis.to / axis.from);
    if (axis.scale == Scale::signed_logarithmic) {
        const double size = std::abs(value / axis.to);
        const double along = size > 0.0 ? std::clamp(1.0 + std::log10(size) / signed_decades, 0.0, 1.0) : 0.0;
        return value / axis.to < 0.0 ? 0.5 - 0.5 * along : 0.5 + 0.5 * along;
    }
    return (value - axis.from) / (axis.to - axis.from);
}

std::vector<Tick> ticks_of(const Axis& axis, int most) {
    const auto [low, high] = std::minmax(axis.from, axis.to);
    if (!axis.ticks.empty()) {
        std::vector<Tick> given;
        for (const double value : axis.ticks)
            if (value >= low && value <= high)
                given.push_back({value, number(value)});
        return given;
    }
    if (axis.scale == Scale::signed_logarithmic)
        return signed_ticks(high);
    most = std::max(most, 1);
    return axis.scale == Scale::logarithmic ? logarithmic_ticks(low, high, most) : linear_ticks(low, high, most);
}

Axis axis_around(std::string label, std::string unit, const std::vector<double>& values, Scale scale, bool include_zero) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double v : values) {
        if (has_place(v, scale)) {
            low = std::min(low, v);
            high = std::max(high, v);
        }
    }
    if (scale == Scale::logarithmic) {
        if (low > high)
            return {std::move(label), std::move(unit), 0.1, 1.0, scale, {}};
        low = std::pow(10.0, std::floor(std::log10(low) + 1e-9));
        high = std::pow(10.0, std::ceil(std::log10(high) - 1e-9));
        return {std::move(label), std::move(unit), low, high > low ? high : 10.0 * low, scale, {}};
    }
    if (include_zero || low > high) {
        low = std::min(low, 0.0);
        high = std::max(1.05 * high, 0.0); // a line must not lie on the frame
    }
    if (!(high > low)) // one value only: some room round it
        high = low + std::max(std::abs(low) * 0.1, 1.0);
    const double step = round_step((high - low) / 8.0);
    return {std::move(label), std::move(unit), step * std::floor(low / step + 1e-9), step * std::ceil(high / step - 1e-9), scale, {}};
}

std::string number(double value) {
    if (value == 0.0)
        return "0";
    const double size = std::abs(value);
    if (size >= 1e6 || size < 1e-4) {
        const std::string text = fmt::format("{:.3e}", value); // 2.500e+06 -> 2.5e6
        const std::size_t e = text.find('e');
        std::string digits = text.substr(0, e);
        digits.erase(digits.find_last_not_of('0') + 1);
        if (digits.back() == '.')
            digits.pop_back();
        return digits + "e" + std::to_string(std::stoi(text.substr(e + 1)));
    }
    return fmt::format("{:.6g}", value);
}

} // namespace fernlicht::plots
