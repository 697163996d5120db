#include "runner/findings/summary.h"

#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr const char* cut_off = "cut off by the end of the road or lane";
constexpr const char* reach_beyond = "the reach lies beyond the end of grid, road or lane";

/// What all readings of one plane, lane and limit share.
struct Subject {
    ExtentKey key;
    std::string where; ///< "own lane on the road"

    ReadingKey of(Quantity quantity, ReadingPlace place = ReadingPlace::none, Aspect aspect = Aspect::value) const {
        return extent_reading(key, quantity, place, aspect);
    }
};

Subject subject_of(const ExtentKey& key) {
    const std::string place = key.lane == "all" ? "whole width" : key.lane + " lane";
    return {key, place + (key.surface == Surface::road ? ", on the road" : ", on a target")};
}

void add_quantile(Readings& readings, ReadingKey key, Statistic statistic, const CensoredSamples& moments, double share,
                  const std::string& where) {
    key.statistic = statistic;
    readings.push_back({std::move(key), moments.quantile(share), fmt::format("{}; {}", where, moments.account())});
}

void add_median(Readings& readings, const ReadingKey& key, const CensoredSamples& moments, const std::string& where) {
    add_quantile(readings, key, Statistic::median, moments, 0.5, where + ", median");
}

void add_quantiles(Readings& readings, const ReadingKey& key, const CensoredSamples& moments, const std::string& where) {
    add_median(readings, key, moments, where);
    add_quantile(readings, key, Statistic::minimum, moments, 0.0, where + ", smallest");
    add_quantile(readings, key, Statistic::p05, moments, 0.05, where + ", 5th percentile");
}

/// Folds the extents of one key. Light that goes on where the grid ends is "at least so far"; what the road's or the lane's end cuts off
/// nearer says nothing of the lamps and is left out.
class Folding {
  public:
    Folding(const ExtentKey& key, const ExtentParameters& parameters, const std::string& not_drawn)
        : last_row_m_(parameters.ahead_m - parameters.cell_m) {
        const CensoredSamples moments = not_drawn.empty() ? CensoredSamples() : CensoredSamples(not_drawn);
        summary_.key = key;
        for (CensoredSamples* each : {&summary_.reach, &summary_.left_edge, &summary_.right_edge, &summary_.unlit_before_reach,
                                      &summary_.area, &summary_.twin_difference})
            *each = moments;
        for (const double at_m : parameters.width_at_m)
            summary_.widths.emplace(at_m, moments);
    }

    void add(const LaneExtent& extent) {
        for (const LaneExtent::Width& width : extent.widths)
            summary_.widths[width.at_m].add(width.cut_off ? Value::at_least(width.width_m) : Value(width.width_m));
        const Value reach = reach_of(extent.reach_centre_m, extent.reach_is_cut_off);
        const Value left = reach_of(extent.reach_left_edge_m, extent.left_edge_is_cut_off),
                    right = reach_of(extent.reach_right_edge_m, extent.right_edge_is_cut_off);
        summary_.cut_off += extent.reach_is_cut_off ? 1U : 0U;
        summary_.reach.add(reach);
        summary_.left_edge.add(left);
        summary_.right_edge.add(right);
        summary_.unlit_before_reach.add(!reach.measured()  ? reach
                                        : reach.censored() ? Value::at_least(extent.unlit_before_reach_m)
                                                           : Value(extent.unlit_before_reach_m));
        const bool ends_early = !reach.measured() || !left.measured() || !right.measured();
        summary_.area.add(ends_early                 ? Value::not_measured(cut_off)
                          : extent.area_is_cut_off() ? Value::at_least(extent.area_m2)
                                                     : Value(extent.area_m2));
    }

    void compare(const LaneExtent& rendered, const LaneExtent& twin) {
        const Value gap = difference(reach_of(rendered.reach_centre_m, rendered.reach_is_cut_off),
                                     reach_of(twin.reach_centre_m, twin.reach_is_cut_off), "m");
        summary_.twin_difference.add(gap.number()     ? Value(std::abs(*gap.number()))
                                     : gap.censored() ? Value::at_least(std::max(0.0, std::max(gap.low(), -gap.high())))
                                                      : gap);
    }

    /// `own`: the twin's extent of this moment.
    void add_uncertainty(const ExtentRow& row, const LaneExtent* own) {
        const auto of_key = [&](const auto& entries) {
            return std::ranges::find_if(entries, [&](const auto& entry) {
                return entry.surface == summary_.key.surface && entry.threshold_lx == summary_.key.threshold_lx;
            });
        };
        if (const auto found = of_key(row.sensitivity); found != row.sensitivity.end()) {
            summary_.per_tenth_degree.add(found->metres_per_tenth_degree);
            summary_.per_tenth_flux.add(found->metres_per_tenth_flux);
        } else if (own) {
            const Value none = Value::not_measured(own->reach_is_cut_off ? reach_beyond : "no reach on both sides of the change");
            summary_.per_tenth_degree.add(none);
            summary_.per_tenth_flux.add(none);
        }
        if (const auto found = of_key(row.grid_errors); found != row.grid_errors.end())
            summary_.grid_error.add(Value::of(found->reach_m, reach_beyond));
    }

    const ExtentSummary& finish() const { return summary_; }

  private:
    Value reach_of(double reach_m, bool lit_at_end) const {
        return !lit_at_end ? Value(reach_m) : reach_m < last_row_m_ ? Value::not_measured(cut_off) : Value::at_least(reach_m);
    }

    double last_row_m_;
    ExtentSummary summary_;
};

void add_extent(Readings& readings, const ExtentSummary& summary) {
    const Subject subject = subject_of(summary.key);
    const std::string& where = subject.where;
    const bool all = subject.key.lane == "all"; // has no centre line and no edges of its own
    const std::string centre = where + (all ? ", line that reaches farthest" : ", centre"),
                      left = where + (all ? ", leftmost line looked at" : ", left edge"),
                      right = where + (all ? ", rightmost line looked at" : ", right edge");
    add_quantiles(readings, subject.of(Quantity::reach), summary.reach, centre);
    add_median(readings, subject.of(Quantity::reach, ReadingPlace::left_edge), summary.left_edge, left);
    add_median(readings, subject.of(Quantity::reach, ReadingPlace::right_edge), summary.right_edge, right);
    add_median(readings, subject.of(Quantity::unlit_before_reach), summary.unlit_before_reach, centre);
    for (const auto& [at_m, width] : summary.widths) {
        ReadingKey key = subject.of(Quantity::width);
        key.distance_m = at_m;
        add_quantiles(readings, key, width, fmt::format("{}, {} m ahead", where, at_m));
    }
    add_quantiles(readings, subject.of(Quantity::area), summary.area, where);
    const ReadingKey twin = subject.of(Quantity::reach, ReadingPlace::none, Aspect::twin_difference);
    add_median(readings, twin, summary.twin_difference, where + ", |rendered - twin|");
    add_quantile(readings, twin, Statistic::maximum, summary.twin_difference, 1.0, where + ", |rendered - twin|, largest");
    if (subject.key.lane != "own")
        return;
    add_median(readings, subject.of(Quantity::reach, ReadingPlace::none, Aspect::per_tenth_degree), summary.per_tenth_degree,
               where + ", gained by 0.1 degrees more pitch of all lamps");
    add_median(readings, subject.of(Quantity::reach, ReadingPlace::none, Aspect::per_tenth_flux), summary.per_tenth_flux,
               where + ", gained by 10 % more flux");
    add_median(readings, subject.of(Quantity::reach, ReadingPlace::none, Aspect::grid_error), summary.grid_error,
               where + ", grid of half the samples");
}

/// How far extents beside the own lane's reach and the whole width's area can be trusted: the grid's error in each of them.
void add_lane_uncertainty(Readings& readings, const PlayedCell& played, const Subject& subject) {
    const auto add = [&](Quantity quantity, ReadingPlace place, double LaneGridError::*figure) {
        CensoredSamples moments;
        for (const ExtentRow& row : played.extents) {
            const auto found = std::ranges::find_if(row.lane_grid_errors, [&](const LaneGridError& error) {
                return error.surface == subject.key.surface && error.threshold_lx == subject.key.threshold_lx &&
                       error.lane == subject.key.lane;
            });
            if (found != row.lane_grid_errors.end())
                moments.add((*found).*figure);
            else if (const LaneExtent* const twin = find_extent(row.twin, subject.key); twin && twin->reach_is_cut_off)
                moments.add(Value::not_measured(reach_beyond));
        }
        add_median(readings, subject.of(quantity, place, Aspect::grid_error), moments, subject.where + ", grid of half the samples");
    };
    if (subject.key.lane != "own")
        add(Quantity::reach, ReadingPlace::none, &LaneGridError::reach_m);
    add(Quantity::reach, ReadingPlace::edges, &LaneGridError::edge_m);
    add(Quantity::unlit_before_reach, ReadingPlace::none, &LaneGridError::unlit_m);
    if (subject.key.lane != "all")
        add(Quantity::area, ReadingPlace::none, &LaneGridError::area_m2);
}

void add_area_trust(Readings& readings, const PlayedCell& played, const Subject& subject) {
    CensoredSamples moments;
    for (const ExtentRow& row : played.extents)
        for (const GridError& error : row.grid_errors)
            if (error.surface == subject.key.surface && error.threshold_lx == subject.key.threshold_lx)
                moments.add(error.area_m2);
    add_median(readings, subject.of(Quantity::area, ReadingPlace::none, Aspect::grid_error), moments,
               subject.where + ", grid of half the samples");
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
    std::vector<ExtentSummary> summaries;
    for (const ExtentKey& key : extent_keys(played)) {
        Folding folding(key, parameters, key.surface == Surface::road ? played.no_road_lx : played.no_target_lx);
        bool same_direction = true;
        for (const ExtentRow& row : played.extents) {
            const LaneExtent* const rendered = find_extent(row.rendered, key);
            const LaneExtent* const twin = find_extent(row.twin, key);
            if (const LaneExtent* const lane = rendered ? rendered : twin)
                same_direction = lane->same_direction;
            if (rendered)
                folding.add(*rendered);
            if (rendered && twin)
                folding.compare(*rendered, *twin);
            if (key.lane == "own")
                folding.add_uncertainty(row, twin);
        }
        summaries.push_back(folding.finish());
        summaries.back().same_direction = same_direction;
    }
    return summaries;
}

Readings extent_readings(const PlayedCell& played) {
    Readings readings;
    for (const ExtentSummary& summary : played.extent_summaries) {
        const Subject subject = subject_of(summary.key);
        add_extent(readings, summary);
        if (subject.key.lane == "all")
            add_area_trust(readings, played, subject);
        add_lane_uncertainty(readings, played, subject);
    }
    return readings;
}

Readings times(const PlayedCell& played) {
    Readings readings;
    for (const PassTime& pass : played.passes)
        add_times(readings, pass);
    return readings;
}

} // namespace fernlicht
