#include "runner/findings/summary.h"

#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace fernlicht {
namespace {

/// A lane's extent in one moment; nullptr: not there.
struct LaneMoment {
    const LaneExtent *rendered, *twin;
    const GridError* grid_error;
};

/// Light that goes on where the grid ends is "at least so far"; what the road's or the lane's end cuts off nearer says nothing of the
/// lamps.
Value in_picture(const ExtentFigure& figure, const LaneExtent& extent, double last_row_m) {
    const auto ends_early = [&](const ExtentFigure& of) {
        return of.line && extent.*of.line->is_cut_off && extent.*of.line->reach_m < last_row_m;
    };
    if (figure.line ? ends_early(figure) : std::ranges::any_of(extent_figures(), ends_early))
        return Value::not_measured("cut off by the end of the road or lane");
    const bool goes_on = figure.line ? extent.*figure.line->is_cut_off : extent.area_is_cut_off();
    return goes_on ? Value::at_least(extent.*figure.member) : Value(extent.*figure.member);
}

Value width_at(const LaneExtent& extent, double at_m) {
    const auto width = std::ranges::find(extent.widths, at_m, &LaneExtent::Width::at_m);
    return width == extent.widths.end() ? Value() : width->cut_off ? Value::at_least(width->width_m) : Value(width->width_m);
}

/// Not measured without a reason: the moment says nothing of it.
Value in_moment(const ExtentFigure& figure, const LaneMoment& moment, double last_row_m, const std::optional<double>& distance_m) {
    const auto& [rendered, twin, grid_error] = moment;
    if (figure.grid_error)
        return grid_error ? grid_error->*figure.grid_error : Value();
    if (!rendered || (figure.aspect == Aspect::twin_difference && !twin))
        return {};
    if (distance_m)
        return width_at(*rendered, *distance_m);
    Value value = in_picture(figure, *rendered, last_row_m);
    if (figure.aspect == Aspect::value)
        return value;
    const Value gap = difference(value, in_picture(figure, *twin, last_row_m), row_of(figure.quantity).unit);
    return gap.number()     ? Value(std::abs(*gap.number()))
           : gap.censored() ? Value::at_least(std::max(0.0, std::max(gap.low(), -gap.high())))
                            : gap;
}

/// The twin's figure in all moments: as the lamps are, and nudged.
std::array<CensoredSamples, 1 + nudge_kinds> nudged_moments(const PlayedCell& played, const ExtentKey& key, const ExtentFigure& figure,
                                                            double last_row_m, const std::optional<double>& distance_m) {
    std::array<CensoredSamples, 1 + nudge_kinds> moments;
    for (const ExtentRow& row : played.extents)
        for (std::size_t i = 0; i < moments.size(); ++i)
            if (const LaneExtent* const extent = find_extent(i == 0 ? row.nudged.as_is : row.nudged.nudged[i - 1], key))
                if (const Value value = distance_m ? width_at(*extent, *distance_m) : in_picture(figure, *extent, last_row_m);
                    value.measured() || !value.reason().empty())
                    moments[i].add(value);
    return moments;
}

/// Beside the pavement the twin's ground is not the rendered one: its moves are taken as shares of its figure.
Sensitivity sensitivity_of(const std::array<CensoredSamples, 1 + nudge_kinds>& nudged, const Value& rendered, double share) {
    const Value as_is = nudged.front().quantile(share);
    const double scale =
        as_is.number().value_or(0.0) > 0.0 && rendered.number().value_or(0.0) > 0.0 ? *rendered.number() / *as_is.number() : 1.0;
    Sensitivity moves;
    for (std::size_t kind = 0; kind < nudge_kinds; ++kind)
        if (const auto move = move_of(nudged[1 + kind].quantile(share), as_is))
            moves.*sensitivity_rows[kind].member = scale * *move;
    return moves;
}

void add_extent(Readings& readings, const ExtentSummary& summary, const ExtentFigure& figure) {
    static constexpr std::tuple<Statistic, double, const char*> quantiles[] = {{Statistic::median, 0.5, "median"},
                                                                               {Statistic::minimum, 0.0, "smallest"},
                                                                               {Statistic::p05, 0.05, "5th percentile"},
                                                                               {Statistic::p95, 0.95, "95th percentile"},
                                                                               {Statistic::maximum, 1.0, "largest"}};
    const auto& [surface, lane, threshold_lx] = summary.key;
    const bool all = lane == "all";
    const std::string place =
        fmt::format("{}, {}{}", all ? "whole width" : lane + " lane", surface == Surface::road ? "on the road" : "on a target",
                    all && figure.where_of_all ? figure.where_of_all : figure.where);
    for (const auto& [reading, moments] : summary.moments) {
        ReadingKey key = reading;
        if (std::tie(key.quantity, key.place, key.aspect) != std::tie(figure.quantity, figure.place, figure.aspect))
            continue;
        const std::string where = place + (key.distance_m ? fmt::format(", {} m ahead", *key.distance_m) : "");
        for (const auto& [statistic, share, words] : quantiles)
            if (std::ranges::count(figure.statistics, statistic) > 0) {
                key.statistic = statistic;
                readings.push_back({key, moments.quantile(share), fmt::format("{}, {}; {}", where, words, moments.account())});
                if (const auto nudged = summary.nudged.find(reading); nudged != summary.nudged.end())
                    readings.back().sensitivity = sensitivity_of(nudged->second, readings.back().value, share);
            }
    }
}

void add_times(Readings& readings, const PassTime& pass) {
    const std::optional<Spread> spread = spread_of(pass.seconds);
    const auto add = [&](Statistic statistic, const std::string& what, double seconds) {
        readings.push_back({{.quantity = Quantity::pass_time, .subject = pass_subject(pass.name), .statistic = statistic},
                            spread ? Value(1e3 * seconds) : Value::not_measured("no samples after the warm-up"),
                            pass.name + ", " + what});
    };
    const Spread figures = spread.value_or(Spread{});
    add(Statistic::median, "median", figures.median);
    add(Statistic::p95, "95th percentile", figures.p95);
    add(Statistic::spread, "95th less 5th percentile", figures.p95 - figures.p05);
}

} // namespace

std::vector<ExtentSummary> summarise_extents(const PlayedCell& played, const ExtentParameters& parameters) {
    const std::vector<std::optional<double>> nowhere{std::nullopt}, ahead_m(parameters.width_at_m.begin(), parameters.width_at_m.end());
    const double last_row_m = parameters.ahead_m - parameters.cell_m;
    std::vector<ExtentSummary> summaries;
    for (const ExtentKey& key : extent_keys(played)) {
        ExtentSummary& summary = summaries.emplace_back(ExtentSummary{key});
        std::vector<LaneMoment> moments;
        for (const ExtentRow& row : played.extents) {
            moments.push_back({find_extent(row.rendered, key), find_extent(row.twin, key), find_extent(row.grid_errors, key)});
            if (const LaneExtent* const lane = moments.back().rendered ? moments.back().rendered : moments.back().twin)
                summary.same_direction = lane->same_direction;
            summary.cut_off += moments.back().rendered && moments.back().rendered->reach_is_cut_off ? 1U : 0U;
        }
        const std::string& not_drawn = key.surface == Surface::road ? played.no_road_lx : played.no_target_lx;
        for (const ExtentFigure& figure : extent_figures()) {
            const bool drawn = !figure.grid_error;
            if (figure.is_of(key.lane))
                for (const std::optional<double>& distance_m : figure.quantity == Quantity::width ? ahead_m : nowhere) {
                    CensoredSamples samples = drawn && !not_drawn.empty() ? CensoredSamples(not_drawn) : CensoredSamples();
                    for (const LaneMoment& moment : moments)
                        if (const Value value = in_moment(figure, moment, last_row_m, distance_m);
                            value.measured() || !value.reason().empty())
                            samples.add(value);
                    const ReadingKey reading = extent_reading(key, figure.quantity, figure.place, figure.aspect, distance_m);
                    summary.moments.emplace(reading, samples);
                    if (figure.aspect == Aspect::value)
                        summary.nudged.emplace(reading, nudged_moments(played, key, figure, last_row_m, distance_m));
                }
        }
    }
    return summaries;
}

Value reach_moved_m(const ExtentSummary& summary, std::optional<double> (*by)(const Sensitivity&), ReadingPlace place) {
    const ReadingKey reading = extent_reading(summary.key, Quantity::reach, place);
    const auto nudged = summary.nudged.find(reading);
    const auto moments = summary.moments.find(reading);
    return Value::of(
        nudged == summary.nudged.end()
            ? std::nullopt
            : by(sensitivity_of(nudged->second, moments == summary.moments.end() ? Value() : moments->second.quantile(0.5), 0.5)),
        "no reach on both sides of the change");
}

Readings extent_readings(const PlayedCell& played) {
    Readings readings;
    for (const ExtentSummary& summary : played.extent_summaries)
        for (const ExtentFigure& figure : extent_figures())
            if (figure.is_of(summary.key.lane))
                add_extent(readings, summary, figure);
    return readings;
}

Readings times(const PlayedCell& played) {
    Readings readings;
    for (const PassTime& pass : played.passes)
        add_times(readings, pass);
    return readings;
}

} // namespace fernlicht
