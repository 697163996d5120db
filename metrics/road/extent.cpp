#include "metrics/road/extent.h"

#include "metrics/road/lit_road.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <stdexcept>

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

LaneExtent::Width width_of(const AcrossCut& cut, const std::vector<double>& offsets, const LaneSpan& span, double threshold_lx) {
    const LitLine lit = lit_line(part_of(cut, offsets, span), threshold_lx);
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
                          double threshold_lx, const LitArea& area, LitArea::CutCells& cut_cells) {
    LaneExtent extent;
    extent.threshold_lx = threshold_lx;
    extent.lane = strip.name;
    extent.same_direction = strip.same_direction;
    set_reach(extent, lit_line(lines.centre, threshold_lx), lit_line(lines.left_edge, threshold_lx),
              lit_line(lines.right_edge, threshold_lx));
    for (const AcrossCut& cut : cuts)
        if (const std::optional<LaneSpan> span = span_at(road, strip.spans, cut.at_m))
            extent.widths.push_back(width_of(cut, road.grid().offset_m, *span, threshold_lx));
    extent.area_m2 = area.lane_m2(strip.spans, cut_cells);
    return extent;
}

LaneExtent extent_of_all(const LitRoad& road, const std::vector<AcrossCut>& cuts, double threshold_lx, const LitArea& area) {
    const std::vector<double>& offsets = road.grid().offset_m;
    LaneExtent extent;
    extent.threshold_lx = threshold_lx;
    extent.lane = "all";
    set_reach(extent, road.farthest(threshold_lx), road.column(offsets.size() - 1, threshold_lx), road.column(0, threshold_lx));
    for (const AcrossCut& cut : cuts) {
        LaneExtent::Width& width = extent.widths.emplace_back(width_of(cut, offsets, {offsets.back(), offsets.front()}, threshold_lx));
        width.cut_off = width.width_m > 0.0 && (width.left_m >= offsets.back() || width.right_m <= offsets.front());
    }
    extent.area_m2 = area.all_m2();
    return extent;
}

} // namespace

std::vector<LaneExtent> measure_extent(const ExtentGrid& grid, const std::vector<double>& lx, Surface surface,
                                       const std::vector<double>& thresholds_lx, const std::vector<double>& width_at_m) {
    check_measurable(grid, lx, thresholds_lx);
    std::vector<LaneExtent> extents;
    if (grid.ahead_m.size() < 2 || grid.offset_m.size() < 2)
        return extents;
    const LitRoad road(grid, lx);
    std::vector<AcrossCut> cuts;
    for (const double at_m : width_at_m)
        if (road.looked_at(at_m))
            cuts.push_back({at_m, road.across(at_m)});
    std::vector<LitArea> areas;
    for (const double limit : thresholds_lx)
        areas.emplace_back(road, limit);
    const std::vector<LaneStrip> own = grid.strips.empty() ? lane_strips(grid) : std::vector<LaneStrip>{};
    for (const LaneStrip& strip : grid.strips.empty() ? own : grid.strips) {
        const LaneLines lines = lines_of(road, strip.spans);
        LitArea::CutCells cut_cells = LitArea::no_cut_cells(grid.ahead_m.size());
        for (std::size_t i = 0; i < thresholds_lx.size(); ++i)
            extents.push_back(extent_of_lane(road, strip, lines, cuts, thresholds_lx[i], areas[i], cut_cells));
    }
    for (std::size_t i = 0; i < thresholds_lx.size(); ++i)
        extents.push_back(extent_of_all(road, cuts, thresholds_lx[i], areas[i]));
    for (LaneExtent& extent : extents)
        extent.surface = surface;
    return extents;
}

namespace {

struct PickedGrid {
    ExtentGrid grid;
    std::vector<double> lx;
};

/// Every `step`th of the first `rows` and `columns`: without sections and surface.
PickedGrid picked(const ExtentGrid& grid, const std::vector<double>& lx, std::size_t step, std::size_t rows, std::size_t columns) {
    PickedGrid result;
    for (std::size_t column = 0; column < columns; column += step)
        result.grid.offset_m.push_back(grid.offset_m[column]);
    for (std::size_t row = 0; row < rows; row += step) {
        result.grid.ahead_m.push_back(grid.ahead_m[row]);
        for (std::size_t column = 0; column < columns; column += step)
            result.lx.push_back(lx[row * grid.offset_m.size() + column]);
    }
    if (step == 2 && !grid.coarse_cell_m2.empty()) {
        result.grid.cell_m2 = grid.coarse_cell_m2;
        return result;
    }
    if (step > 1 || grid.cell_m2.empty()) {
        result.grid.cell_m2 = cell_areas_m2(grid, step, rows, columns);
        return result;
    }
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        const auto first = grid.cell_m2.begin() + static_cast<std::ptrdiff_t>(row * (grid.offset_m.size() - 1));
        result.grid.cell_m2.insert(result.grid.cell_m2.end(), first, first + static_cast<std::ptrdiff_t>(columns - 1));
    }
    return result;
}

/// Whole steps in a length, one more where rounding took it away.
int steps_in(double length_m, double step_m) { return static_cast<int>(std::floor(length_m / step_m * (1.0 + 1e-12))); }

void check(const ExtentParameters& parameters) {
    constexpr double max_points = 4e7;
    const double rows = parameters.ahead_m / parameters.cell_m + 1.0;
    const double columns = 8.0 * parameters.beside_m / parameters.cell_m + 1.0;
    if (!(std::isfinite(parameters.cell_m) && parameters.cell_m > 0.0 && parameters.ahead_m > 0.0 && parameters.beside_m > 0.0 &&
          rows * columns <= max_points))
        throw std::invalid_argument(fmt::format("a grid of {} m cells over {} m ahead and {} m to each side cannot be made",
                                                parameters.cell_m, parameters.ahead_m, parameters.beside_m));
}

/// Every cell_m / 4 where lanes may be paved, and a cell beside them; every cell_m farther out, where only light on grass is looked at.
std::vector<double> columns_of(const ExtentGrid& grid, const ExtentParameters& parameters) {
    double left_m = 0.0, right_m = 0.0;
    for (const CrossSection& section : grid.sections) {
        left_m = std::max(left_m, section.paved_left_m + parameters.cell_m);
        right_m = std::min(right_m, section.paved_right_m - parameters.cell_m);
    }
    const double across_m = parameters.cell_m / 4.0;
    const int beside = steps_in(parameters.beside_m, across_m);
    std::vector<double> offsets_m;
    for (int i = -beside; i <= beside; ++i) {
        const double offset_m = i * across_m;
        const bool fine = offset_m >= right_m && offset_m <= left_m;
        if (fine || i % 4 == 0 || std::abs(i) == beside)
            offsets_m.push_back(offset_m);
    }
    return offsets_m;
}

} // namespace

ExtentGrid make_extent_grid(const Route& route, const Moment& moment, double bumper_m, const ExtentParameters& parameters) {
    check(parameters);
    ExtentGrid grid;
    grid.target_height_m = parameters.target_height_m;
    const double bumper_at_m = moment.distance_m + bumper_m;
    const double ahead_m = std::min(parameters.ahead_m, route.length_m() - bumper_at_m);
    for (int i = 0; ahead_m >= 0.0 && i <= steps_in(ahead_m, parameters.cell_m); ++i)
        grid.ahead_m.push_back(i * parameters.cell_m);
    for (const double row_m : grid.ahead_m)
        grid.sections.push_back(route.cross_section(bumper_at_m + row_m));
    grid.offset_m = columns_of(grid, parameters);
    const std::size_t columns = grid.offset_m.size();
    grid.surface.resize(grid.ahead_m.size() * columns);
    grid.places = SurfacePlaces(grid.surface.size());
    oneapi::tbb::parallel_for(std::size_t{0}, grid.ahead_m.size(), [&](std::size_t row) {
        const std::span<Pose> surface(&grid.surface[row * columns], columns);
        route.poses(bumper_at_m + grid.ahead_m[row], grid.offset_m, surface);
        grid.places.put(row * columns, surface);
    });
    grid.cell_m2 = cell_areas_m2(grid);
    grid.strips = lane_strips(grid);
    grid.coarse_strips = lane_strips(grid, 2);
    grid.coarse_cell_m2 = cell_areas_m2(grid, 2, grid.ahead_m.size(), columns);
    return grid;
}

namespace {

struct ReachAndArea {
    std::optional<double> reach_m; ///< nullopt: lit where the grid, road or lane ends
    double area_m2 = 0.0;
};

/// `measured`: extents of this very grid, where they are known.
std::vector<ReachAndArea> reach_and_area(const ExtentGrid& grid, const std::vector<double>& lx, const std::vector<double>& thresholds_lx,
                                         const std::vector<LaneExtent>& measured) {
    const LitRoad road(grid, lx);
    const bool has_centre = grid.offset_m.front() <= 0.0 && grid.offset_m.back() >= 0.0;
    const std::optional<double> centre_m = has_centre ? std::optional(0.0) : std::nullopt;
    const std::vector<LineSample> centre = road.along(std::vector(grid.ahead_m.size(), centre_m));
    std::vector<ReachAndArea> results;
    for (const double limit : thresholds_lx) {
        const LitLine reach = lit_line(centre, limit);
        const auto all =
            std::ranges::find_if(measured, [&](const LaneExtent& extent) { return extent.lane == "all" && extent.threshold_lx == limit; });
        results.push_back({reach.lit_at_end ? std::nullopt : std::optional(reach.last_m),
                           all != measured.end() ? all->area_m2 : LitArea(road, limit).all_m2()});
    }
    return results;
}

} // namespace

std::vector<GridError> grid_errors(const ExtentGrid& grid, const std::vector<double>& lx, Surface surface,
                                   const std::vector<double>& thresholds_lx, const std::vector<LaneExtent>& measured) {
    std::vector<GridError> errors;
    std::vector<LaneExtent> other;
    const std::size_t rows = grid.ahead_m.size(), columns = grid.offset_m.size();
    if (rows >= 3 && columns >= 3) {
        PickedGrid coarse = picked(grid, lx, 2, rows, columns);
        coarse.grid.surface.resize(coarse.lx.size()); // whose areas are known
        coarse.grid.strips = grid.coarse_strips.empty() ? lane_strips(grid, 2) : grid.coarse_strips;
        coarse.grid.sections.resize(coarse.grid.ahead_m.size()); // whose lanes are known
        other = measure_extent(coarse.grid, coarse.lx, surface, thresholds_lx, {});
        // An odd number of both, so that the coarse grid covers what the fine one covers and only the cell differs.
        const bool odd = rows % 2 == 1 && columns % 2 == 1;
        const PickedGrid trimmed = odd ? PickedGrid{} : picked(grid, lx, 1, rows - 1 + rows % 2, columns - 1 + columns % 2);
        const std::vector<ReachAndArea> by_fine =
            odd ? reach_and_area(grid, lx, thresholds_lx, measured) : reach_and_area(trimmed.grid, trimmed.lx, thresholds_lx, {});
        const std::vector<ReachAndArea> by_coarse = reach_and_area(coarse.grid, coarse.lx, thresholds_lx, other);
        for (std::size_t i = 0; i < thresholds_lx.size(); ++i) {
            const std::optional<double>&fine_m = by_fine[i].reach_m, &coarse_m = by_coarse[i].reach_m;
            const Value reach = fine_m && coarse_m ? Value(std::abs(*fine_m - *coarse_m)) : Value::not_measured(reach_beyond);
            errors.push_back({thresholds_lx[i], surface, "own", reach});
            errors.push_back({thresholds_lx[i], surface, "all", {}, {}, {}, std::abs(by_fine[i].area_m2 - by_coarse[i].area_m2)});
        }
    }
    for (const LaneExtent& fine : measured) {
        const auto is_it = [&](const auto& entry) { return entry.lane == fine.lane && entry.threshold_lx == fine.threshold_lx; };
        const auto found = std::ranges::find_if(other, is_it);
        const auto known = std::ranges::find_if(errors, is_it);
        GridError& error = known != errors.end() ? *known : errors.emplace_back(GridError{fine.threshold_lx, surface, fine.lane});
        const bool ends = found != other.end() && !fine.reach_is_cut_off && !found->reach_is_cut_off;
        const auto gap = [&](double LaneExtent::*figure) {
            return ends                    ? Value(std::abs(fine.*figure - (*found).*figure))
                   : fine.reach_is_cut_off ? Value::not_measured(reach_beyond)
                                           : Value();
        };
        if (fine.lane != "own")
            error.reach = gap(&LaneExtent::reach_centre_m);
        const Value left = gap(&LaneExtent::reach_left_edge_m), right = gap(&LaneExtent::reach_right_edge_m);
        error.edge = left.low() < right.low() ? right : left;
        error.unlit = gap(&LaneExtent::unlit_before_reach_m);
        if (fine.lane != "all")
            error.area = gap(&LaneExtent::area_m2);
    }
    return errors;
}

} // namespace fernlicht
