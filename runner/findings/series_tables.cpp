#include "metrics/readings/reading_labels.h"
#include "runner/findings/figures.h"
#include "runner/findings/series.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::string degrees_or(const char* unit) { return std::string(unit) == "deg" ? "°" : std::string(" ") + unit; }

std::string distribution_words(const CarPart& part) {
    const Tolerance& t = part.tolerance;
    const std::string unit = degrees_or(unit_of(part.kind));
    if (t.from)
        return fmt::format("evenly from {} to {}{}", four_digits(*t.from), four_digits(*t.to), unit);
    return fmt::format("normal, standard deviation {:g}{}{}", t.sigma, unit,
                       t.mean != 0.0 ? fmt::format(", mean {}{}", four_digits(t.mean), unit) : std::string());
}

Cell cars_value_cell(const Value& value) {
    return value.measured() ? Cell(with_bound(value, four_digits(*value.figure())), *value.figure()) : Cell("not measured");
}

/// The part with the largest share of the variance, and that share.
std::string mover_words(const ReadingOfCars& of, const std::vector<CarPart>& parts) {
    const auto most = std::ranges::max_element(of.variance_shares);
    if (most == of.variance_shares.end() || *most == 0.0)
        return "";
    return fmt::format("{}, {:.0f} %", name_of(parts[static_cast<std::size_t>(most - of.variance_shares.begin())]), 100.0 * *most);
}

Cell slope_cell(const ReadingOfCars& of) {
    if (!of.slope_error || !(*of.spread > 0.0))
        return "";
    const double percent = 100.0 * *of.slope_error / *of.spread;
    return {two_digits(percent), percent};
}

} // namespace

std::string limit_words(const Limit& limit) {
    if (limit.reading == "all")
        return "";
    const auto key = key_of(limit.reading);
    const std::string unit = key ? unit_suffix(unit_of(*key)) : "";
    std::string words = limit.at_least ? fmt::format("at least {:g}", *limit.at_least) : "";
    if (limit.at_most)
        words += fmt::format("{}at most {:g}", limit.at_least ? " and " : "", *limit.at_most);
    return words + unit;
}

namespace {

Cell share_cell(const Value& share, double low_percent, double high_percent) {
    if (!share.measured())
        return share.reason().empty() ? "" : "not measured: " + share.reason();
    return {fmt::format("{} ({} … {})", with_bound(share, figure(*share.figure(), 1)), figure(low_percent, 1), figure(high_percent, 1)),
            *share.figure()};
}

} // namespace

Cell within_cell(const CarsWithin& within) { return share_cell(within.share_percent, within.low_percent, within.high_percent); }

Cell cars_cell(const ReadingOfCars& of) {
    const double size = std::abs(of.as_designed.figure().value_or(0.0));
    const int decimals = size > 0.0 ? std::clamp(3 - static_cast<int>(std::floor(std::log10(size))), 0, 6) : 2; // four digits of it
    const auto text = [&](const Value& value) {
        return value.measured() ? with_bound(value, figure(*value.figure(), decimals)) : std::string("not measured");
    };
    return {fmt::format("{} ({} … {})", text(of.as_designed), text(of.p05), text(of.p95)), of.as_designed.figure().value_or(0.0)};
}

Table tolerances_table(const SeriesFindings& series, const std::string& name) {
    Table table{name, "What varies from car to car", columns_of("what<|of<|how<|stated by<"), {}};
    for (std::size_t i = 0; i < tolerance_kinds; ++i) {
        const auto kind = static_cast<ToleranceKind>(i);
        const auto part = std::ranges::find(series.parts, kind, &CarPart::kind);
        if (part != series.parts.end())
            table.rows.push_back({name_of(kind), is_of_each_lamp(kind) ? "each lamp by itself" : "the car", distribution_words(*part),
                                  part->tolerance.source.empty() ? "assumed" : part->tolerance.source});
    }
    return table;
}

Table cars_table(const SeriesFindings& series, const std::string& name, const std::vector<std::string>* names) {
    Table table{name,
                fmt::format("{} drawn cars, by slopes where these miss {} cars in full by at most {:g} % of their spread (r.m.s.), else "
                            "those in full alone",
                            series.draws, series.cars, 100.0 * most_slope_error),
                columns_of("reading`|unit<|as designed|5th percentile|median|95th percentile|from<|slopes miss [% of the spread]|moved "
                           "most by<"),
                {}};
    for (const ReadingOfCars& of : series.readings)
        if (!names || place_among(of.key, *names))
            table.rows.push_back({name_of(of.key), unit_label(unit_of(of.key)), cars_value_cell(of.as_designed), cars_value_cell(of.p05),
                                  cars_value_cell(of.median), cars_value_cell(of.p95), of.by_slopes ? "slopes" : "cars in full",
                                  slope_cell(of), mover_words(of, series.parts)});
    return table;
}

Table within_table(const SeriesFindings& series, const std::string& name) {
    Table table{name,
                "Cars within each limit. Intervals are those of chance among the cars counted, 95 %; what slopes miss shows beside it, in "
                "the cars in full",
                columns_of("reading`|limit<|share of cars [%]|cars|in full [%]"),
                {}};
    for (const CarsWithin& within : series.within)
        table.rows.push_back({within.limit.reading, limit_words(within.limit), within_cell(within),
                              within.open > 0 ? fmt::format("{}, {} open", within.of, within.open) : fmt::format("{}", within.of),
                              share_cell(within.in_full_percent, within.in_full_low_percent, within.in_full_high_percent)});
    return table;
}

} // namespace fernlicht
