#include "runner/experiments/run/page_parts.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

constexpr const char* nothing = "\u2013";

std::string text_or_dash(const Value& value, int decimals) {
    return value.measured() ? with_bound(value, figure(*value.figure(), decimals)) : nothing;
}

/// A measured figure of a lamp set and how far it is from the first lamp set's: medians.
data compared(const ManyMoments& own, const ManyMoments& first, bool is_first, int decimals) {
    data cell;
    const Value now = own.quantile(0.5), change = difference(now, first.quantile(0.5), "");
    cell.set("figure", text_or_dash(now, decimals));
    if (is_first)
        cell.set("difference", false);
    else
        cell.set("difference", change.measured() ? with_bound(change, signed_figure(*change.figure(), decimals)) : nothing);
    return cell;
}

ManyMoments width_at(const ExtentSummary& summary, double at_m) {
    const auto found = summary.widths.find(at_m);
    return found == summary.widths.end() ? ManyMoments() : found->second;
}

std::string range(const ManyMoments& moments) {
    return moments.count() > 0 ? text_or_dash(moments.quantile(0.0), 1) + "\u2009\u2026\u2009" + text_or_dash(moments.quantile(1.0), 1)
                               : nothing;
}

data table_row(const ExtentSummary& summary, const ExtentSummary& first, bool is_first, const std::vector<double>& widths_at_m) {
    data row, cells{List::list};
    cells.push_back(compared(summary.reach, first.reach, is_first, 1));
    for (const double at_m : widths_at_m)
        cells.push_back(compared(width_at(summary, at_m), width_at(first, at_m), is_first, 1));
    cells.push_back(compared(summary.area, first.area, is_first, 0));
    row.set("cells", cells);
    row.set("range", range(summary.reach));
    row.set("per_degree", text_or_dash(summary.per_tenth_degree.quantile(0.5), 1));
    row.set("per_flux", text_or_dash(summary.per_tenth_flux.quantile(0.5), 1));
    row.set("twin", text_or_dash(summary.twin_difference.quantile(1.0), 2));
    row.set("grid", text_or_dash(summary.grid_error.quantile(0.5), 2));
    return row;
}

/// What all lamp sets of a drive have together: (plane, lane) in order of sight, limits and width distances ascending.
struct Axes {
    std::vector<std::pair<ExtentPlane, std::string>> places;
    std::vector<double> limits_lx, widths_at_m;
};

void insert_sorted(std::vector<double>& values, double value) {
    const auto place = std::lower_bound(values.begin(), values.end(), value);
    if (place == values.end() || *place != value)
        values.insert(place, value);
}

Axes axes_of(const ComparedDrive& drive, const std::vector<std::vector<ExtentSummary>>& summaries) {
    Axes axes;
    for (std::size_t i = 0; i < drive.variants.size(); ++i)
        for (const ExtentSummary& summary : summaries[i]) {
            const std::pair place(summary.key.plane, summary.key.lane);
            if (std::find(axes.places.begin(), axes.places.end(), place) == axes.places.end())
                axes.places.push_back(place);
            insert_sorted(axes.limits_lx, summary.key.limit_lx);
            for (const auto& [at_m, moments] : summary.widths)
                insert_sorted(axes.widths_at_m, at_m);
        }
    const auto rank = [](const auto& place) { return std::tuple(place.second != "own", place.first); };
    std::stable_sort(axes.places.begin(), axes.places.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    return axes;
}

std::string lane_title(const std::string& lane) {
    return lane == "own" ? "Own lane" : lane == "all" ? "Whole width that was looked at" : "Lane \u201c" + short_text(lane, 60) + "\u201d";
}

data table(const ComparedDrive& drive, const std::vector<std::vector<ExtentSummary>>& summaries, const Axes& axes, ExtentPlane plane,
           const std::string& lane) {
    data part, limits{List::list}, heads{List::list};
    for (const double at_m : axes.widths_at_m)
        heads.push_back(fmt::format("{:g}", at_m));
    for (const double limit_lx : axes.limits_lx) {
        const ExtentKey key{plane, lane, limit_lx};
        data rows{List::list};
        ExtentSummary first;
        for (std::size_t i = 0; i < drive.variants.size(); ++i) {
            const auto found =
                std::find_if(summaries[i].begin(), summaries[i].end(), [&](const auto& summary) { return summary.key == key; });
            ExtentSummary summary;
            if (found != summaries[i].end())
                summary = *found;
            if (i == 0)
                first = summary;
            data row = table_row(summary, first, i == 0, axes.widths_at_m);
            row.set("lamp", short_text(drive.variants[i]->variant, 40));
            row.set("colour", variant_colour(i));
            row.set("first", i == 0);
            row.set("limit", fmt::format("{:g}", limit_lx));
            row.set("rows", fmt::format("{}", drive.variants.size()));
            rows.push_back(row);
        }
        data limit;
        limit.set("limit_rows", rows);
        limits.push_back(limit);
    }
    part.set("title",
             lane_title(lane) + (plane == ExtentPlane::road ? ", on the road\u2019s surface" : ", on a target that faces the lamps"));
    part.set("own", lane == "own");
    part.set("widths", heads);
    part.set("limits", limits);
    return part;
}

} // namespace

data extent_tables(const ComparedDrive& drive) {
    std::vector<std::vector<ExtentSummary>> summaries;
    for (const PlayedVariant* const played : drive.variants)
        summaries.push_back(played->extent_summaries);
    const Axes axes = axes_of(drive, summaries);
    data own{List::list}, others{List::list};
    bool has_own = false, has_others = false;
    for (const auto& [plane, lane] : axes.places) {
        (lane == "own" ? own : others).push_back(table(drive, summaries, axes, plane, lane));
        (lane == "own" ? has_own : has_others) = true;
    }
    data part;
    part.set("has_extents", has_own || has_others);
    part.set("own_tables", own);
    part.set("has_other_tables", has_others);
    part.set("other_tables", others);
    part.set("compares", drive.variants.size() > 1);
    part.set("first_lamp", drive.variants.empty() ? "" : short_text(drive.variants.front()->variant, 40));
    return part;
}

data headline_reaches(const ComparedDrive& drive) {
    data cards{List::list};
    for (const double limit_lx : {1.0, 5.0}) {
        ManyMoments first;
        for (std::size_t i = 0; i < drive.variants.size(); ++i) {
            const auto& all = drive.variants[i]->extent_summaries;
            const auto found = std::ranges::find(all, ExtentKey{ExtentPlane::road, "own", limit_lx}, &ExtentSummary::key);
            if (found == all.end())
                continue;
            const ExtentSummary& summary = *found;
            if (i == 0)
                first = summary.reach;
            if (summary.reach.count() == 0)
                continue;
            data card;
            card.set("lamp", short_text(drive.variants[i]->variant, 30));
            card.set("colour", variant_colour(i));
            card.set("limit", fmt::format("{:g}", limit_lx));
            card.set("reach", compared(summary.reach, first, i == 0, 1));
            const Value by_aim = summary.per_tenth_degree.quantile(0.5);
            card.set("aim", text_or_dash(by_aim, 1));
            card.set("has_aim", by_aim.measured());
            cards.push_back(card);
        }
    }
    return cards;
}

} // namespace fernlicht
