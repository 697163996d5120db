#include "runner/experiments/run/run_plots.h"

#include "metrics/readings/reading_labels.h"
#include "metrics/statistics/statistics.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace fernlicht {
namespace {

constexpr double still_deg = 0.01; ///< a tenth of what the aim of lamps is known to

/// How far body and levelling turn the cut-off up.
double cut_off_up_deg(const CarRow& row) { return row.pitch_deg + row.levelling_deg.value_or(0.0); }

CensoredSamples of_car(const PlayedCell& played, const std::function<std::optional<double>(const CarRow&)>& of) {
    CensoredSamples samples;
    for (const CarRow& row : played.car)
        if (const std::optional<double> value = of(row))
            samples.add(*value);
    return samples;
}

bool sways(const PlayedCell& played) {
    const auto swings = [&](const std::function<std::optional<double>(const CarRow&)>& of) {
        const CensoredSamples samples = of_car(played, of);
        return samples.count() > 0 && *samples.quantile(1.0).number() - *samples.quantile(0.0).number() > still_deg;
    };
    return swings(cut_off_up_deg) || swings([](const CarRow& row) { return row.roll_deg; });
}

/// Value over the share of the moments below it, in per cent: the very quantiles that readings tell.
plots::Series share_below(std::string name, const CensoredSamples& samples, plots::Colour colour, const char* dash = "") {
    constexpr std::size_t most_points = 200;
    plots::Series series{std::move(name), {}, colour, 2.0, dash, samples.count() == 1};
    const std::size_t points = std::min(samples.count(), most_points);
    for (std::size_t i = 0; i < points; ++i) {
        const double share = points == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(points - 1);
        series.points.push_back({samples.quantile(share).number().value_or(std::numeric_limits<double>::quiet_NaN()), 100.0 * share});
    }
    return series;
}

std::optional<plots::Figure> share_figure(std::string title, std::string x_label, std::string x_unit, std::vector<plots::Series> series) {
    std::vector<double> x;
    for (const plots::Series& one : series)
        for (const plots::Point& point : one.points)
            if (std::isfinite(point.x))
                x.push_back(point.x);
    if (x.empty())
        return std::nullopt;
    plots::Figure figure;
    figure.title = std::move(title);
    figure.width_px = 640.0;
    figure.height_px = 300.0;
    figure.x = plots::axis_around(std::move(x_label), std::move(x_unit), x);
    figure.y = {.label = "moments below", .unit = "%", .from = 0.0, .to = 100.0, .ticks = {5.0, 25.0, 50.0, 75.0, 95.0}};
    figure.series = std::move(series);
    return figure;
}

std::optional<plots::Figure> swing_figure(const ComparedDrive& drive) {
    constexpr plots::Colour of_body{60, 60, 60};
    const auto has_levelling = [](const PlayedCell* played) { return !played->car.empty() && played->car.front().levelling_deg; };
    const bool alike = std::ranges::none_of(drive.lamp_sets, has_levelling); // lamps do not act on the car
    std::vector<plots::Series> series;
    for (std::size_t i = 0; i < (alike ? 1 : drive.lamp_sets.size()); ++i)
        series.push_back(share_below(alike ? "up" : short_text(drive.lamp_sets[i]->lamp_set, 24) + ", up",
                                     of_car(*drive.lamp_sets[i], cut_off_up_deg), alike ? of_body : plots::lamp_colour(i)));
    if (const CensoredSamples roll = of_car(*drive.lamp_sets.front(), [](const CarRow& row) { return row.roll_deg; }); roll.count() > 0)
        series.push_back(share_below("roll, left side up", roll, of_body, "5 3"));
    return share_figure("Swing of the cut-off", "angle against the road", "deg", std::move(series));
}

std::optional<plots::Figure> reach_spread_figure(const ComparedDrive& drive) {
    const std::vector<double> thresholds_lx = plotted_thresholds_lx(drive);
    if (thresholds_lx.empty())
        return std::nullopt;
    const ExtentKey key{Surface::target, "own", thresholds_lx.back()};
    std::vector<plots::Series> series;
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        const auto& all = drive.lamp_sets[i]->extent_summaries;
        if (const auto found = std::ranges::find(all, key, &ExtentSummary::key); found != all.end())
            series.push_back(
                share_below(short_text(drive.lamp_sets[i]->lamp_set, 24), moments_of(*found, Quantity::reach), plots::lamp_colour(i)));
    }
    return share_figure(fmt::format("Reach at {:g} lx on a facing target", key.threshold_lx), "reach, own lane", "m", std::move(series));
}

/// Of one figure in a range of distances: what each lamp set has in the moments there.
struct Strip {
    double from_m = 0.0, to_m = 0.0;
    std::map<std::size_t, Spread> by_lamp_set = {};
};

/// Lamp sets stand beside each other in each strip. Distances are logarithmic.
std::optional<plots::Figure> strip_figure(const ComparedDrive& drive, std::string title, const char* x_label, std::vector<double> x_ticks,
                                          const std::vector<Strip>& strips) {
    std::vector<double> x, y;
    for (const Strip& strip : strips)
        for (const auto& [i, spread] : strip.by_lamp_set) {
            x.insert(x.end(), {strip.from_m, strip.to_m});
            y.insert(y.end(), {spread.p05, spread.median, spread.maximum});
        }
    if (y.empty() || *std::ranges::max_element(y) <= 0.0)
        return std::nullopt;
    plots::Figure figure;
    figure.title = std::move(title);
    figure.subtitle = "bar: 5 to 95 % of the moments; line: median; dot: largest";
    figure.width_px = 640.0;
    figure.height_px = 300.0;
    const auto [nearest_m, farthest_m] = std::ranges::minmax(x);
    figure.x = {x_label, "m", nearest_m, farthest_m, plots::Scale::logarithmic, std::move(x_ticks)};
    figure.y = plots::axis_around("facing illuminance", "lx", y, plots::Scale::logarithmic);
    const double sets = static_cast<double>(drive.lamp_sets.size());
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        std::string name = short_text(drive.lamp_sets[i]->lamp_set, 24);
        for (const Strip& strip : strips) {
            const auto found = strip.by_lamp_set.find(i);
            if (found == strip.by_lamp_set.end())
                continue;
            const auto at = [&](double share) {
                return strip.from_m * std::pow(strip.to_m / strip.from_m, (static_cast<double>(i) + share) / sets);
            };
            const double left = at(0.15), right = at(0.85);
            const Spread& spread = found->second;
            const double low = std::max(spread.p05, figure.y.from), high = std::max(spread.p95, figure.y.from); // dark has no place
            figure.bands.push_back({"", {left, right}, {low, low}, {high, high}, plots::lamp_colour(i), 0.35});
            figure.series.push_back({std::exchange(name, ""), {{left, spread.median}, {right, spread.median}}, plots::lamp_colour(i), 2.4});
            figure.series.push_back({"", {{at(0.5), spread.maximum}}, plots::lamp_colour(i), 2.0, "", true});
        }
    }
    return figure;
}

/// What reaches the eye of this series in the moments from and to these distances.
std::optional<Spread> facing_between(const SeeingSeries& series, double from_m, double to_m) {
    const auto column = std::ranges::find(series.columns, "facing_lx", &SeeingSeries::Column::name);
    std::vector<double> lx;
    for (std::size_t i = 0; column != series.columns.end() && i < series.at_m.size(); ++i)
        if (const auto value = column->values[i].number(); value && series.at_m[i] >= from_m && series.at_m[i] <= to_m)
            lx.push_back(*value);
    return spread_of(std::move(lx));
}

/// The ranges before this eye that the drive passes as a whole, as its readings tell them.
std::vector<Strip> ranges_before(const PlayedCell& played, const ReadingKey& eye) {
    std::vector<Strip> strips;
    for (const Reading& reading : played.readings)
        if (reading.key.quantity == Quantity::glare_facing && reading.key.subject == eye.subject && reading.key.to_m &&
            reading.key.statistic == Statistic::p95 && reading.value.measured())
            strips.push_back({*reading.key.distance_m, *reading.key.to_m});
    return strips;
}

/// Adds what each lamp set has of `subject` in the strip, between these values of its distance.
void fill(const ComparedDrive& drive, const std::string& subject, double from_m, double to_m, Strip& strip) {
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        const auto& seeing = drive.lamp_sets[i]->seeing;
        if (const auto series = std::ranges::find(seeing, subject, &SeeingSeries::subject); series != seeing.end())
            if (const auto spread = facing_between(*series, from_m, to_m))
                strip.by_lamp_set.emplace(i, *spread);
    }
}

std::vector<plots::Figure> glare_spread_figures(const ComparedDrive& drive) {
    constexpr double endless = std::numeric_limits<double>::infinity(), half_a_strip = 1.12;
    std::vector<plots::Figure> figures;
    std::vector<Strip> mirrors;
    std::vector<double> gaps_m;
    for (const SeeingSeries& series : drive.lamp_sets.front()->seeing) {
        const std::optional<ReadingKey> eye = eye_of(series.subject);
        if (eye && eye->place == ReadingPlace::mirrors) {
            gaps_m.push_back(eye->distance_m.value_or(1.0));
            fill(drive, series.subject, -endless, endless,
                 mirrors.emplace_back(Strip{gaps_m.back() / half_a_strip, gaps_m.back() * half_a_strip}));
        } else if (eye) {
            std::vector<Strip> strips = ranges_before(*drive.lamp_sets.front(), *eye);
            std::set<double> edges_m;
            for (Strip& strip : strips) {
                fill(drive, series.subject, strip.from_m, strip.to_m, strip);
                edges_m.insert({strip.from_m, strip.to_m});
            }
            if (auto figure = strip_figure(drive, "Light in the " + short_text(eye_label(*eye), 60), "distance from the bumper to the eye",
                                           {edges_m.begin(), edges_m.end()}, strips))
                figures.push_back(std::move(*figure));
        }
    }
    if (auto figure = strip_figure(drive, "Light on the mirrors of a car ahead, the most lit one", "gap", std::move(gaps_m), mirrors))
        figures.push_back(std::move(*figure));
    return figures;
}

} // namespace

std::vector<plots::Figure> spread_figures(const ComparedDrive& drive) {
    std::vector<plots::Figure> figures;
    if (std::ranges::none_of(drive.lamp_sets, [](const PlayedCell* played) { return sways(*played); }))
        return figures;
    for (auto& figure : {swing_figure(drive), reach_spread_figure(drive)})
        if (figure)
            figures.push_back(*figure);
    std::ranges::move(glare_spread_figures(drive), std::back_inserter(figures));
    return figures;
}

} // namespace fernlicht
