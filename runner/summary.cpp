#include "runner/summary.h"

#include "runner/many_moments.h"
#include "runner/report/extent_summary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

constexpr double median = 0.5;

/// What all readings of one plane, lane and limit share.
struct Subject {
    ExtentKey key;
    std::string stem;      ///< "5lx_road_own"
    std::string where;     ///< "own lane on the road"
    std::string not_drawn; ///< why nothing of this plane was drawn, if so
};

Subject subject_of(const ExtentKey& key, const PlayedVariant& played) {
    const std::string place = key.lane == "all" ? "whole width" : key.lane + " lane";
    return {key, fmt::format("{}lx_{}_{}", key.limit_lx, plane_name(key.plane), name_part(key.lane)),
            place + (key.plane == ExtentPlane::road ? ", on the road" : ", on a target"),
            key.plane == ExtentPlane::road ? played.no_road_lx : played.no_target_lx};
}

void add_quantile(Readings& readings, const std::string& name, const ManyMoments& moments, double share, const std::string& unit,
                  const std::string& where) {
    const std::optional<double> value = moments.quantile(share);
    readings.push_back({name, value, unit, fmt::format("{}; {}", where, moments.account()), -1, value ? "" : moments.why_not()});
}

/// Median without a suffix, then minimum and 5th percentile. `name` without its unit.
void add_quantiles(Readings& readings, const std::string& name, const ManyMoments& moments, const std::string& unit,
                   const std::string& where) {
    add_quantile(readings, name + "_" + unit, moments, median, unit, where + ", median");
    add_quantile(readings, name + "_min_" + unit, moments, 0.0, unit, where + ", smallest");
    add_quantile(readings, name + "_p05_" + unit, moments, 0.05, unit, where + ", 5th percentile");
}

/// Everything that the moments' extents of one subject add up to.
struct ExtentFold {
    ManyMoments centre, left_edge, right_edge, unlit, area, twin_difference;
    std::map<double, ManyMoments> widths;
};

class Folding {
  public:
    Folding(const ExtentParameters& parameters, const std::string& not_drawn)
        : ahead_m_(parameters.ahead_m), last_row_m_(parameters.ahead_m - parameters.cell_m) {
        const auto moments = [&](double looked_ahead_m) {
            return not_drawn.empty() ? ManyMoments(looked_ahead_m) : ManyMoments(looked_ahead_m, not_drawn);
        };
        const ManyMoments reach = moments(ahead_m_), other = moments(0.0);
        fold_ = {reach, reach, reach, other, other, other, {}};
        for (const double at_m : parameters.width_at_m)
            fold_.widths.emplace(at_m, other);
    }

    void add(const LaneExtent& extent) {
        for (const LaneExtent::Width& width : extent.widths)
            fold_.widths[width.at_m].add(width.width_m);
        const bool ends_early = extent.reach_is_cut_off && extent.reach_centre_m < last_row_m_;
        add_reach(fold_.centre, extent.reach_centre_m, ends_early);
        add_reach(fold_.left_edge, extent.reach_left_edge_m, ends_early);
        add_reach(fold_.right_edge, extent.reach_right_edge_m, ends_early);
        ends_early ? fold_.unlit.leave_out() : fold_.unlit.add(extent.unlit_before_reach_m);
        ends_early ? fold_.area.leave_out() : fold_.area.add(extent.area_m2);
    }

    void compare(const LaneExtent& rendered, const LaneExtent& twin) {
        if (rendered.reach_is_cut_off || twin.reach_is_cut_off)
            fold_.twin_difference.leave_out();
        else
            fold_.twin_difference.add(std::abs(rendered.reach_centre_m - twin.reach_centre_m));
    }

    const ExtentFold& finish() const { return fold_; }

  private:
    void add_reach(ManyMoments& moments, double reach_m, bool ends_early) const {
        if (ends_early)
            moments.leave_out();
        else if (reach_m > last_row_m_)
            moments.add_beyond();
        else
            moments.add(reach_m);
    }

    double ahead_m_, last_row_m_;
    ExtentFold fold_;
};

ExtentFold fold_of(const PlayedVariant& played, const Subject& subject, const ExtentParameters& parameters) {
    const ExtentKey& key = subject.key;
    Folding folding(parameters, subject.not_drawn);
    for (const ExtentRow& row : played.extents) {
        const LaneExtent* rendered = find_extent(row.rendered, key);
        const LaneExtent* twin = find_extent(row.twin, key);
        if (rendered)
            folding.add(*rendered);
        if (rendered && twin)
            folding.compare(*rendered, *twin);
    }
    return folding.finish();
}

void add_extent(Readings& readings, const Subject& subject, const ExtentFold& fold) {
    const std::string& stem = subject.stem;
    const std::string& where = subject.where;
    const bool all = subject.key.lane == "all"; // has no centre line and no edges of its own
    const char* const centre = all ? ", line that reaches farthest" : ", centre";
    const char *const left = all ? ", leftmost line looked at" : ", left edge", *const right =
                                                                                    all ? ", rightmost line looked at" : ", right edge";
    add_quantiles(readings, "reach_" + stem, fold.centre, "m", where + centre);
    add_quantile(readings, "reach_" + stem + "_left_edge_m", fold.left_edge, median, "m", fmt::format("{}{}, median", where, left));
    add_quantile(readings, "reach_" + stem + "_right_edge_m", fold.right_edge, median, "m", fmt::format("{}{}, median", where, right));
    add_quantile(readings, "unlit_before_reach_" + stem + "_m", fold.unlit, median, "m", fmt::format("{}{}, median", where, centre));
    for (const auto& [at_m, width] : fold.widths)
        add_quantiles(readings, fmt::format("width_{}_at_{}m", stem, at_m), width, "m", fmt::format("{}, {} m ahead", where, at_m));
    add_quantiles(readings, "area_" + stem, fold.area, "m2", where);
    add_quantile(readings, "reach_" + stem + "_twin_difference_m", fold.twin_difference, median, "m",
                 where + ", |rendered - twin|, median");
    add_quantile(readings, "reach_" + stem + "_twin_difference_worst_m", fold.twin_difference, 1.0, "m",
                 where + ", |rendered - twin|, largest");
}

/// Median over the moments of one member of the entries of this subject's plane and limit.
template <class Entry>
ManyMoments of_entries(const PlayedVariant& played, const ExtentKey& key, std::vector<Entry> ExtentRow::*entries, double Entry::*figure) {
    ManyMoments moments;
    for (const ExtentRow& row : played.extents)
        for (const Entry& entry : row.*entries)
            if (entry.plane == key.plane && entry.limit_lx == key.limit_lx)
                moments.add(entry.*figure);
    return moments;
}

/// How far the own lane's reach can be trusted.
void add_trust(Readings& readings, const PlayedVariant& played, const Subject& subject) {
    const auto add = [&](const std::string& suffix, const ManyMoments& moments, const std::string& what) {
        add_quantile(readings, "reach_" + subject.stem + suffix, moments, median, "m", subject.where + what);
    };
    add("_per_tenth_degree_m", of_entries(played, subject.key, &ExtentRow::sensitivity, &ReachSensitivity::metres_per_tenth_degree),
        ", gained by 0.1 degrees more pitch of all lamps, median");
    add("_per_tenth_flux_m", of_entries(played, subject.key, &ExtentRow::sensitivity, &ReachSensitivity::metres_per_tenth_flux),
        ", gained by 10 % more flux, median");
    add("_grid_error_m", of_entries(played, subject.key, &ExtentRow::grid_errors, &GridError::reach_m),
        ", grid of half the samples, median");
}

/// How far extents beside the own lane's reach and the whole width's area can be trusted: the grid's error in each of them.
void add_lane_trust(Readings& readings, const PlayedVariant& played, const Subject& subject) {
    const auto add = [&](const std::string& name, const std::string& unit, double LaneGridError::*figure) {
        ManyMoments moments;
        for (const ExtentRow& row : played.extents)
            for (const LaneGridError& error : row.lane_grid_errors)
                if (error.plane == subject.key.plane && error.limit_lx == subject.key.limit_lx && error.lane == subject.key.lane)
                    moments.add(error.*figure);
        add_quantile(readings, name, moments, median, unit, subject.where + ", grid of half the samples, median");
    };
    if (subject.key.lane != "own")
        add("reach_" + subject.stem + "_grid_error_m", "m", &LaneGridError::reach_m);
    add("reach_" + subject.stem + "_edge_grid_error_m", "m", &LaneGridError::edge_m);
    add("unlit_before_reach_" + subject.stem + "_grid_error_m", "m", &LaneGridError::unlit_m);
    if (subject.key.lane != "all")
        add("area_" + subject.stem + "_grid_error_m2", "m2", &LaneGridError::area_m2);
}

void add_area_trust(Readings& readings, const PlayedVariant& played, const Subject& subject) {
    add_quantile(readings, "area_" + subject.stem + "_grid_error_m2",
                 of_entries(played, subject.key, &ExtentRow::grid_errors, &GridError::area_m2), median, "m2",
                 subject.where + ", grid of half the samples, median");
}

void add_times(Readings& readings, const PassTime& pass) {
    const std::optional<Spread> spread = spread_of(pass.seconds);
    const std::string stem = name_part(pass.name) + "_time_";
    const auto add = [&](const std::string& statistic, const std::string& what, double seconds) {
        readings.push_back({stem + statistic + "_ms", spread ? std::optional(1e3 * seconds) : std::nullopt, "ms", pass.name + ", " + what,
                            -1, spread ? "" : "no samples after the warm-up"});
    };
    const Spread figures = spread.value_or(Spread{});
    add("median", "median", figures.median);
    add("p95", "95th percentile", figures.p95);
    add("spread", "95th less 5th percentile", figures.p95 - figures.p05);
}

} // namespace

Readings summarise(const PlayedVariant& played, const Drive& drive) {
    Readings readings;
    if (drive.extent)
        for (const ExtentKey& key : extent_keys(played)) {
            const Subject subject = subject_of(key, played);
            add_extent(readings, subject, fold_of(played, subject, *drive.extent));
            if (key.lane == "own")
                add_trust(readings, played, subject);
            if (key.lane == "all")
                add_area_trust(readings, played, subject);
            add_lane_trust(readings, played, subject);
        }
    return readings;
}

Readings times(const PlayedVariant& played) {
    Readings readings;
    for (const PassTime& pass : played.passes)
        add_times(readings, pass);
    return readings;
}

std::string name_part(const std::string& text) {
    std::string part;
    for (const char c : text) {
        const bool upper = c >= 'A' && c <= 'Z';
        const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || upper;
        part += !plain ? '_' : upper ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return part;
}

bool is_unit_of_time(const std::string& unit) { return unit == "ms"; }

} // namespace fernlicht
