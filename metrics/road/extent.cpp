#include "metrics/road/extent.h"

#include "metrics/road/lit_road.h"

#include <cmath>

namespace fernlicht {
namespace {

/// A cut across the road, looked at by every lane.
struct AcrossCut {
    double at_m = 0.0;
    std::vector<double> lx; ///< one per column
};

/// The cut between two offsets, with samples on both.
std::vector<LineSample> part_of(const AcrossCut& cut, const std::vector<double>& offsets, const LaneSpan& span) {
    std::vector<LineSample> line{{span.right_m, lx_across(offsets, cut.lx.data(), span.right_m)}};
    for (std::size_t column = 0; column < offsets.size(); ++column)
        if (offsets[column] > span.right_m && offsets[column] < span.left_m)
            line.push_back({offsets[column], cut.lx[column]});
    line.push_back({span.left_m, lx_across(offsets, cut.lx.data(), span.left_m)});
    return line;
}

LaneExtent::Width width_of(const AcrossCut& cut, const std::vector<double>& offsets, const LaneSpan& span, double limit_lx) {
    const LitLine lit = lit_line(part_of(cut, offsets, span), limit_lx);
    return {cut.at_m, lit.last_m, lit.first_m, lit.lit_m};
}

/// Edges of a lane between rows; nullopt where it is not on both sides.
std::optional<LaneSpan> span_at(const LitRoad& road, const LaneSpans& spans, double ahead_m) {
    const auto [row, share] = road.place(ahead_m);
    if (share == 0.0)
        return spans[row];
    if (share == 1.0)
        return spans[row + 1];
    if (!spans[row] || !spans[row + 1])
        return std::nullopt;
    return LaneSpan{std::lerp(spans[row]->left_m, spans[row + 1]->left_m, share),
                    std::lerp(spans[row]->right_m, spans[row + 1]->right_m, share)};
}

/// A lane's lines of samples: the same for all limits.
struct LaneLines {
    std::vector<LineSample> centre, left_edge, right_edge;
};

LaneLines lines_of(const LitRoad& road, const LaneSpans& spans) {
    const auto follow = [&road, &spans](auto offset_in) {
        std::vector<std::optional<double>> offsets_m;
        for (const std::optional<LaneSpan>& span : spans)
            offsets_m.push_back(span ? std::optional<double>(offset_in(*span)) : std::nullopt);
        return road.along(offsets_m);
    };
    return {follow([](const LaneSpan& span) { return 0.5 * (span.left_m + span.right_m); }),
            follow([](const LaneSpan& span) { return span.left_m; }), follow([](const LaneSpan& span) { return span.right_m; })};
}

void set_reach(LaneExtent& extent, const LitLine& centre, const LitLine& left_edge, const LitLine& right_edge) {
    extent.reach_centre_m = centre.last_m;
    extent.unlit_before_reach_m = centre.unlit_before_last_m;
    extent.reach_is_cut_off = centre.lit_at_end;
    extent.reach_left_edge_m = left_edge.last_m;
    extent.left_edge_is_cut_off = left_edge.lit_at_end;
    extent.reach_right_edge_m = right_edge.last_m;
    extent.right_edge_is_cut_off = right_edge.lit_at_end;
}

LaneExtent extent_of_lane(const LitRoad& road, const LaneStrip& strip, const LaneLines& lines, const std::vector<AcrossCut>& cuts,
                          double limit_lx, const LitArea& area) {
    LaneExtent extent;
    extent.limit_lx = limit_lx;
    extent.lane = strip.name;
    extent.same_direction = strip.same_direction;
    set_reach(extent, lit_line(lines.centre, limit_lx), lit_line(lines.left_edge, limit_lx), lit_line(lines.right_edge, limit_lx));
    for (const AcrossCut& cut : cuts)
        if (const std::optional<LaneSpan> span = span_at(road, strip.spans, cut.at_m))
            extent.widths.push_back(width_of(cut, road.grid().offset_m, *span, limit_lx));
    extent.area_m2 = area.lane_m2(strip.spans);
    return extent;
}

LaneExtent extent_of_all(const LitRoad& road, const std::vector<AcrossCut>& cuts, double limit_lx, const LitArea& area) {
    const std::vector<double>& offsets = road.grid().offset_m;
    LaneExtent extent;
    extent.limit_lx = limit_lx;
    extent.lane = "all";
    set_reach(extent, road.farthest(limit_lx), road.column(offsets.size() - 1, limit_lx), road.column(0, limit_lx));
    for (const AcrossCut& cut : cuts) {
        LaneExtent::Width& width = extent.widths.emplace_back(width_of(cut, offsets, {offsets.back(), offsets.front()}, limit_lx));
        width.cut_off = width.width_m > 0.0 && (width.left_m >= offsets.back() || width.right_m <= offsets.front());
    }
    extent.area_m2 = area.all_m2();
    return extent;
}

} // namespace

std::vector<LaneExtent> measure_extent(const ExtentGrid& grid, const std::vector<double>& lx, ExtentPlane plane,
                                       const std::vector<double>& limits_lx, const std::vector<double>& width_at_m) {
    check_measurable(grid, lx, limits_lx);
    std::vector<LaneExtent> extents;
    if (grid.ahead_m.size() < 2 || grid.offset_m.size() < 2)
        return extents;
    const LitRoad road(grid, lx);
    std::vector<AcrossCut> cuts;
    for (const double at_m : width_at_m)
        if (road.looked_at(at_m))
            cuts.push_back({at_m, road.across(at_m)});
    std::vector<LitArea> areas;
    for (const double limit : limits_lx)
        areas.push_back(road.lit_area(limit));
    for (const LaneStrip& strip : lane_strips(grid)) {
        const LaneLines lines = lines_of(road, strip.spans);
        for (std::size_t i = 0; i < limits_lx.size(); ++i)
            extents.push_back(extent_of_lane(road, strip, lines, cuts, limits_lx[i], areas[i]));
    }
    for (std::size_t i = 0; i < limits_lx.size(); ++i)
        extents.push_back(extent_of_all(road, cuts, limits_lx[i], areas[i]));
    for (LaneExtent& extent : extents)
        extent.plane = plane;
    return extents;
}

} // namespace fernlicht
