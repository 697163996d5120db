#include "runner/experiments/run/page_parts.h"
#include "runner/experiments/run/page_plots.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"
#include "runner/findings/figures.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

std::string percent(double share, double floor) { return share < floor ? "< " + two_digits(100.0 * floor) : two_digits(100.0 * share); }

data error_row(const char* where, const PixelErrors& errors) {
    data row;
    row.set("why_not", false);
    const ErrorQuantiles &e = errors.error, &f = errors.floor;
    row.set("where", where);
    row.set("median", percent(e.median, f.median));
    row.set("p95", percent(e.p95, f.p95));
    row.set("p99", percent(e.p99, f.p99));
    row.set("floor", two_digits(100.0 * f.p95));
    row.set("mean", signed_figure(100.0 * errors.mean, 2));
    return row;
}

data missing_row(const char* where, const std::string& why_not) {
    data row;
    row.set("where", where);
    row.set("why_not", "not measured: " + clean_text(why_not));
    return row;
}

data error_rows(const DriveError& error) {
    data rows{List::list};
    const auto add = [&](const char* where, const std::optional<PixelErrors>& errors, const std::string& why_not) {
        if (errors && errors->pixels > 0)
            rows.push_back(error_row(where, *errors));
        else
            rows.push_back(missing_row(where, why_not.empty() ? "no light there" : why_not));
    };
    add("illuminance, road", error.road, "");
    add("illuminance, targets above it", error.target, error.no_target);
    add("illuminance, whole view", error.whole, "");
    add("luminance, whole view", error.luminance, error.no_luminance);
    return rows;
}

/// A row a plane, a cell a limit.
data reach_rows(const DriveError& error) {
    data rows{List::list};
    for (const ExtentPlane plane : {ExtentPlane::road, ExtentPlane::target}) {
        data row, cells{List::list};
        row.set("plane", plane_name(plane));
        for (const ReachError& reach : error.reach)
            if (reach.plane == plane)
                cells.push_back(reach.why_not.empty() ? signed_figure(reach.median_m, 2) + " / " + signed_figure(reach.worst_m, 2)
                                                      : clean_text(reach.why_not));
        row.set("cells", cells);
        if (!error.reach.empty())
            rows.push_back(row);
    }
    return rows;
}

/// Where lamps of the reference are no points.
std::string lamp_discs(const DriveError& error) {
    return error.lamp_radius_m > 0.0
               ? fmt::format(", with lamps that are discs of {:g} cm radius, as soft-map draws them (for reach, points)",
                             100.0 * error.lamp_radius_m)
               : "";
}

} // namespace

data error_part(const ComparedDrive& drive) {
    data part, sets{List::list}, limits{List::list};
    bool said = false, measured = false;
    for (std::size_t i = 0; i < drive.variants.size(); ++i) {
        const PlayedVariant& played = *drive.variants[i];
        const DriveError& error = played.error;
        if (!error.measured() && error.not_measured.empty())
            continue; // the run ended before, or was told to leave it out
        data set, rows{List::list};
        set.set("lamp", short_text(played.variant, 40));
        set.set("colour", variant_colour(i));
        if (error.measured()) {
            set.set("sentence",
                    fmt::format("{} against {} moment{} at {} × {} pixels{}{}, which took {} s; {}", clean_text(played.technique),
                                error.ticks.size(), error.ticks.size() == 1 ? "" : "s", error.width_px, error.height_px,
                                error.ticks.size() > 1 ? ", targets and luminance in the middle one" : "", lamp_discs(error),
                                figure(error.seconds, 1),
                                played.throughput.view_s ? fmt::format("a frame of the run takes {}", time_text(*played.throughput.view_s))
                                                         : "too few moments were played to time a frame"));
            rows = error_rows(error);
            set.set("reach", reach_rows(error));
            if (limits.is_empty_list())
                for (const ReachError& reach : error.reach)
                    if (reach.plane == ExtentPlane::road)
                        limits.push_back(fmt::format("{:g} lx", reach.limit_lx));
            measured = true;
        } else {
            set.set("sentence", "not measured: " + clean_text(error.not_measured));
        }
        set.set("rows", rows);
        sets.push_back(set);
        said = true;
    }
    part.set("said", said);
    part.set("measured", measured);
    part.set("sets", sets);
    part.set("has_reach", !limits.is_empty_list());
    part.set("limits", limits);
    const std::string plot = error_svg(drive);
    part.set("has_plot", !plot.empty());
    part.set("plot", plot);
    return part;
}

} // namespace fernlicht
