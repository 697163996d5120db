#include "metrics/road/lit_road.h"

#include "metrics/road/crossing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {

void check_measurable(const ExtentGrid& grid, const std::vector<double>& lx, const std::vector<double>& limits_lx) {
    const std::size_t points = grid.ahead_m.size() * grid.offset_m.size();
    if (lx.size() != points || grid.surface.size() != points || grid.sections.size() != grid.ahead_m.size())
        throw std::invalid_argument(fmt::format("a grid of {} x {} points has {} values, {} places and {} sections", grid.ahead_m.size(),
                                                grid.offset_m.size(), lx.size(), grid.surface.size(), grid.sections.size()));
    if (!std::ranges::all_of(lx, [](double value) { return std::isfinite(value); }))
        throw std::invalid_argument("an illuminance on the grid is not finite");
    for (const double limit : limits_lx)
        if (!(limit > 0.0 && std::isfinite(limit)))
            throw std::invalid_argument(fmt::format("a limit of {} lx is not above 0", limit));
}

std::vector<LaneStrip> lane_strips(const ExtentGrid& grid) {
    std::vector<LaneStrip> strips;
    for (std::size_t row = 0; row < grid.sections.size(); ++row)
        for (const RouteLane& lane : grid.sections[row].lanes) {
            const bool seen_whole =
                lane.left_m <= grid.offset_m.back() && lane.right_m >= grid.offset_m.front() && lane.left_m > lane.right_m;
            if (!seen_whole)
                continue;
            auto strip = std::ranges::find(strips, lane.name, &LaneStrip::name);
            if (strip == strips.end())
                strip = strips.insert(strips.end(), {lane.name, lane.same_direction, LaneSpans(grid.sections.size())});
            strip->spans[row] = LaneSpan{lane.left_m, lane.right_m};
        }
    return strips;
}

std::size_t column_left_of(const std::vector<double>& offsets_m, double offset_m) {
    const auto above = std::ranges::upper_bound(offsets_m, offset_m) - offsets_m.begin();
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, std::ssize(offsets_m) - 1));
}

double lx_across(const std::vector<double>& offsets_m, const double* row, double offset_m) {
    const std::size_t left = column_left_of(offsets_m, offset_m);
    const double share = (offset_m - offsets_m[left - 1]) / (offsets_m[left] - offsets_m[left - 1]);
    return share == 0.0 ? row[left - 1] : between_samples(row[left - 1], row[left], share);
}

LitRoad::LitRoad(const ExtentGrid& grid, const std::vector<double>& lx)
    : grid_(grid), lx_(lx), own_cell_m2_(grid.cell_m2.empty() ? cell_areas_m2(grid) : std::vector<CellArea>{}),
      cell_m2_(grid.cell_m2.empty() ? own_cell_m2_ : grid.cell_m2) {
    for (std::size_t i = 0; i < grid.ahead_m.size(); ++i)
        brightest_lx_.push_back(*std::max_element(row(i), row(i) + grid.offset_m.size()));
}

std::vector<LineSample> LitRoad::along(const std::vector<std::optional<double>>& offsets_m) const {
    std::vector<LineSample> line;
    line.reserve(grid_.ahead_m.size());
    for (std::size_t i = 0; i < grid_.ahead_m.size(); ++i)
        line.push_back({grid_.ahead_m[i], offsets_m[i] ? std::optional(lx_across(grid_.offset_m, row(i), *offsets_m[i])) : std::nullopt});
    return line;
}

LitLine LitRoad::column(std::size_t index, double limit_lx) const {
    std::vector<LineSample> line;
    line.reserve(grid_.ahead_m.size());
    for (std::size_t i = 0; i < grid_.ahead_m.size(); ++i)
        line.push_back({grid_.ahead_m[i], row(i)[index]});
    return lit_line(line, limit_lx);
}

LitLine LitRoad::farthest(double limit_lx) const {
    std::size_t last = brightest_lx_.size();
    while (last > 0 && brightest_lx_[last - 1] < limit_lx)
        --last;
    if (last == 0)
        return {};
    // Only a column that is lit in the last lit row can reach farthest, and it does so by how far it goes on from there.
    std::size_t best = 0;
    double best_share = -1.0;
    for (std::size_t i = 0; i < grid_.offset_m.size(); ++i) {
        const double lx = row(last - 1)[i];
        if (lx < limit_lx)
            continue;
        const double share = last < brightest_lx_.size() ? crossing_share(lx, row(last)[i], limit_lx) : 0.0;
        if (share > best_share) {
            best = i;
            best_share = share;
        }
    }
    return column(best, limit_lx);
}

std::pair<std::size_t, double> LitRoad::place(double ahead_m) const {
    const auto above = std::ranges::upper_bound(grid_.ahead_m, ahead_m) - grid_.ahead_m.begin();
    const auto before = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ssize(grid_.ahead_m) - 2));
    return {before, (ahead_m - grid_.ahead_m[before]) / (grid_.ahead_m[before + 1] - grid_.ahead_m[before])};
}

std::vector<double> LitRoad::across(double ahead_m) const {
    const auto [before, share] = place(ahead_m);
    std::vector<double> values(grid_.offset_m.size());
    for (std::size_t column = 0; column < values.size(); ++column) {
        const double near = row(before)[column];
        values[column] = share == 0.0 ? near : between_samples(near, row(before + 1)[column], share);
    }
    return values;
}

} // namespace fernlicht
