#include "runner/findings/figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {

std::string figure(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-')
        text.erase(0, 1); // minus nothing
    if (text.front() == '-')
        text.replace(0, 1, "\u2212");
    return text;
}

std::string signed_figure(double value, int decimals) {
    const std::string text = figure(value, decimals);
    const bool negative = text.starts_with("\u2212"), nothing = text.find_first_not_of("0.") == std::string::npos;
    return negative || nothing ? text : "+" + text;
}

std::string four_digits(double value) {
    std::string text = fmt::format("{:.4g}", value + 0.0);
    if (text.find("e+") != std::string::npos)
        text = fmt::format("{:.0f}", std::stod(text));
    if (text.front() == '-')
        text.replace(0, 1, "\u2212");
    return text;
}

std::string two_digits(double value) {
    const double size = std::abs(value);
    if (size == 0.0)
        return "0";
    if (size < 1e-3 || size >= 1e5)
        return fmt::format("{:.1e}", value);
    const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(size))));
    return fmt::format("{:.{}f}", value, decimals);
}

std::string open_figure(double open, double of) {
    if (!(open > 0.0))
        return "0";
    const auto fixed = [](double value, int digits) {
        const int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(value)));
        return fmt::format("{:.{}f}", value, std::clamp(decimals, 0, 12));
    };
    const double least = of != 0.0 ? std::pow(10.0, std::floor(std::log10(1e-3 * std::abs(of)))) : 0.0;
    return open < least ? "< " + fixed(least, 1) : fixed(open, 2);
}

std::string open_words(double open, double of, const std::string& behind) {
    const std::string text = open_figure(open, of);
    return text.starts_with("< ") ? "±" + text.substr(2) + behind + " at most" : "±" + text + behind;
}

std::string claimed_text(const WorkPrecisionRow& row, const std::string& unit) {
    if (!row.error)
        return "not measured";
    const std::string text = two_digits(row.claimed_error()) + (unit.empty() ? "" : " " + unit);
    return row.below_floor() ? "< " + text : text;
}

std::string mib_text(std::uint64_t bytes) { return fmt::format("{:.1f}", static_cast<double>(bytes) / (1 << 20)); }

std::string time_text(double seconds) {
    return seconds < 1e-3  ? fmt::format("{:.1f} us", 1e6 * seconds)
           : seconds < 0.1 ? fmt::format("{:.2f} ms", 1e3 * seconds)
           : seconds < 1.0 ? fmt::format("{:.0f} ms", 1e3 * seconds)
                           : fmt::format("{:.1f} s", seconds);
}

std::string counted(std::size_t count, const std::string& what) { return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"); }

std::string interval_name(const Interval& time) {
    if (time.samples == 0)
        return "";
    return time.samples == 1 ? "one timing" : time.of_median ? "95 % interval of the median" : "min to max";
}

std::string timings_text(const Interval& time) {
    if (time.samples <= 1)
        return "of one round, whose spread is unknown: nobody is surely faster";
    if (time.of_median)
        return fmt::format("medians of {} rounds with their 95 % intervals", time.samples);
    return fmt::format("medians of {} rounds, bars from min to max{}", time.samples,
                       time.samples < fewest_timings ? ": too few for anybody to be surely faster" : "");
}

std::string standing_text(const Standing& standing) {
    if (standing.on_front)
        return "front";
    return standing.dominated_by ? fmt::format("{} by {}", standing.surely ? "beaten" : "perhaps", *standing.dominated_by + 1) : "";
}

std::string shadow_figure(double value, double least) {
    if (std::abs(value) < least)
        return "0";
    return std::abs(value) < 99.5 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

std::string shadow_percent(double share) { return shadow_figure(100.0 * share, min_shadow_percent); }
std::string shadow_m2(double m2) { return shadow_figure(m2, min_shadow_m2); }
std::string shadow_cm(double cm) { return shadow_figure(cm, min_shadow_cm); }

} // namespace fernlicht
