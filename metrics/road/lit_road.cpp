#include "metrics/road/lit_road.h"

#include "scenarios/packs/level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace fernlicht {

void check_measurable(const ExtentGrid& grid, const std::vector<double>& lx, const std::vector<double>& thresholds_lx) {
    const std::size_t points = grid.ahead_m.size() * grid.offset_m.size();
    if (lx.size() != points || grid.surface.size() != points || grid.sections.size() != grid.ahead_m.size())
        throw std::invalid_argument(fmt::format("a grid of {} x {} points has {} values, {} places and {} sections", grid.ahead_m.size(),
                                                grid.offset_m.size(), lx.size(), grid.surface.size(), grid.sections.size()));
    if (!std::ranges::all_of(lx, [](double value) { return std::isfinite(value); }))
        throw std::invalid_argument("an illuminance on the grid is not finite");
    for (const double limit : thresholds_lx)
        if (!(limit > 0.0 && std::isfinite(limit)))
            throw std::invalid_argument(fmt::format("a limit of {} lx is not above 0", limit));
}

std::vector<LaneStrip> lane_strips(const ExtentGrid& grid, std::size_t step) {
    std::vector<LaneStrip> strips;
    const std::size_t rows = (grid.sections.size() + step - 1) / step;
    for (std::size_t row = 0; row < rows; ++row) {
        auto next = strips.begin(); // the lanes of a row are mostly those of the row before, in their order
        for (const RouteLane& lane : grid.sections[row * step].lanes) {
            const bool seen_whole =
                lane.left_m <= grid.offset_m.back() && lane.right_m >= grid.offset_m.front() && lane.left_m > lane.right_m;
            if (!seen_whole)
                continue;
            auto strip = next != strips.end() && next->name == lane.name ? next : std::ranges::find(strips, lane.name, &LaneStrip::name);
            if (strip == strips.end())
                strip = strips.insert(strips.end(), {lane.name, lane.same_direction, LaneSpans(rows)});
            strip->spans[row] = LaneSpan{lane.left_m, lane.right_m};
            next = strip + 1;
        }
    }
    return strips;
}

std::size_t column_left_of(const std::vector<double>& offsets_m, double offset_m, std::size_t guess) {
    if (guess > 0 && guess < offsets_m.size() && offsets_m[guess - 1] <= offset_m && offset_m < offsets_m[guess])
        return guess;
    const auto above = std::ranges::upper_bound(offsets_m, offset_m) - offsets_m.begin();
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, std::ssize(offsets_m) - 1));
}

double lx_across(const std::vector<double>& offsets_m, const double* row, double offset_m, std::size_t* guess) {
    const std::size_t left = column_left_of(offsets_m, offset_m, guess ? *guess : 0);
    if (guess)
        *guess = left;
    const double share = (offset_m - offsets_m[left - 1]) / (offsets_m[left] - offsets_m[left - 1]);
    return share == 0.0 ? row[left - 1] : between_samples(row[left - 1], row[left], share);
}

namespace {

/// Of at least one finite value.
FERNLICHT_WIDEST double largest_of(const double* values, std::size_t count) {
    constexpr std::size_t side_by_side = 8;
    double largest[side_by_side];
    std::fill_n(largest, side_by_side, values[0]);
    std::size_t i = 0;
    for (; i + side_by_side <= count; i += side_by_side)
        for (std::size_t k = 0; k < side_by_side; ++k)
            largest[k] = largest[k] < values[i + k] ? values[i + k] : largest[k];
    return std::max(*std::max_element(largest, largest + side_by_side), *std::max_element(values + std::min(i, count - 1), values + count));
}

} // namespace

LitRoad::LitRoad(const ExtentGrid& grid, const std::vector<double>& lx)
    : grid_(grid), lx_(lx), own_cell_m2_(grid.cell_m2.empty() ? cell_areas_m2(grid) : std::vector<CellArea>{}),
      cell_m2_(grid.cell_m2.empty() ? own_cell_m2_ : grid.cell_m2) {
    for (std::size_t i = 0; i < grid.ahead_m.size(); ++i)
        brightest_lx_.push_back(largest_of(row(i), grid.offset_m.size()));
}

std::vector<LineSample> LitRoad::along(const std::vector<std::optional<double>>& offsets_m) const {
    std::vector<LineSample> line;
    line.reserve(grid_.ahead_m.size());
    std::size_t column = 0;
    for (std::size_t i = 0; i < grid_.ahead_m.size(); ++i)
        line.push_back(
            {grid_.ahead_m[i], offsets_m[i] ? std::optional(lx_across(grid_.offset_m, row(i), *offsets_m[i], &column)) : std::nullopt});
    return line;
}

LitLine LitRoad::column(std::size_t index, double threshold_lx) const {
    std::vector<LineSample> line;
    line.reserve(grid_.ahead_m.size());
    for (std::size_t i = 0; i < grid_.ahead_m.size(); ++i)
        line.push_back({grid_.ahead_m[i], row(i)[index]});
    return lit_line(line, threshold_lx);
}

LitLine LitRoad::farthest(double threshold_lx) const {
    std::size_t last = brightest_lx_.size();
    while (last > 0 && brightest_lx_[last - 1] < threshold_lx)
        --last;
    if (last == 0)
        return {};
    // Only a column that is lit in the last lit row can reach farthest, and it does so by how far it goes on from there.
    std::size_t best = 0;
    double best_share = -1.0;
    for (std::size_t i = 0; i < grid_.offset_m.size(); ++i) {
        const double lx = row(last - 1)[i];
        if (lx < threshold_lx)
            continue;
        const double share = last < brightest_lx_.size() ? crossing_share(lx, row(last)[i], threshold_lx) : 0.0;
        if (share > best_share) {
            best = i;
            best_share = share;
        }
    }
    return column(best, threshold_lx);
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

namespace {

/// A number with what it answers to the light at a triangle's three corners.
struct Graded {
    double value = 0.0;
    std::array<double, 3> by{};
    Graded(double of = 0.0) : value(of) {}
    Graded(double of, const Graded& a, double by_a, const Graded& b, double by_b) : value(of) {
        for (std::size_t i = 0; i < by.size(); ++i)
            by[i] = by_a * a.by[i] + by_b * b.by[i];
    }
    friend Graded operator+(const Graded& a, const Graded& b) { return {a.value + b.value, a, 1.0, b, 1.0}; }
    friend Graded operator-(const Graded& a, const Graded& b) { return {a.value - b.value, a, 1.0, b, -1.0}; }
    friend Graded operator*(const Graded& a, const Graded& b) { return {a.value * b.value, a, b.value, b, a.value}; }
    friend Graded operator/(const Graded& a, const Graded& b) {
        return {a.value / b.value, a, 1.0 / b.value, b, -a.value / (b.value * b.value)};
    }
    friend Graded log(const Graded& a) { return {std::log(a.value), a, 1.0 / a.value, a, 0.0}; }
    friend bool operator>=(const Graded& a, double limit) { return a.value >= limit; }
    friend bool operator>(const Graded& a, double limit) { return a.value > limit; }
};

template <class Number> struct Corner { Number ahead_m = 0.0, offset_m = 0.0, lx = 0.0; };

/// A convex part of a triangle: three corners, and one more for each of at most three cuts.
template <class Number> struct Polygon {
    std::array<Corner<Number>, 8> corners;
    std::size_t count = 0;
    void add(const Corner<Number>& corner) { corners[count++] = corner; }
};

template <class Number> Number signed_area(const Polygon<Number>& polygon) {
    Number twice = 0.0;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Corner<Number>& a = polygon.corners[i];
        const Corner<Number>& b = polygon.corners[(i + 1) % polygon.count];
        twice = twice + (a.ahead_m * b.offset_m - b.ahead_m * a.offset_m);
    }
    return 0.5 * twice;
}

/// Sutherland and Hodgman: keeps the corners that `inside` keeps and cuts the sides that leave it at `share(a, b)` of their length.
template <class Number, class Inside, class Share> Polygon<Number> clipped(const Polygon<Number>& polygon, Inside inside, Share share) {
    Polygon<Number> result;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Corner<Number>& a = polygon.corners[i];
        const Corner<Number>& b = polygon.corners[(i + 1) % polygon.count];
        if (inside(a))
            result.add(a);
        if (inside(a) != inside(b)) {
            const Number f = share(a, b);
            result.add({a.ahead_m + (b.ahead_m - a.ahead_m) * f, a.offset_m + (b.offset_m - a.offset_m) * f, a.lx + (b.lx - a.lx) * f});
        }
    }
    return result;
}

template <class Number> Polygon<Number> lit_part(const Polygon<Number>& polygon, double threshold_lx) {
    return clipped(
        polygon, [threshold_lx](const Corner<Number>& c) { return c.lx >= threshold_lx; },
        [threshold_lx](const Corner<Number>& a, const Corner<Number>& b) { return crossing_share(a.lx, b.lx, threshold_lx); });
}

/// What lies on the side of a straight lane edge where `sign * (offset - edge)` is not negative.
template <class Number>
Polygon<Number> beside(const Polygon<Number>& polygon, double from_ahead_m, double from_offset_m, double slope, double sign) {
    const auto side = [=](const Corner<Number>& c) { return sign * (c.offset_m - (from_offset_m + slope * (c.ahead_m - from_ahead_m))); };
    return clipped(
        polygon, [side](const Corner<Number>& c) { return side(c) >= 0.0; },
        [side](const Corner<Number>& a, const Corner<Number>& b) { return side(a) / (side(a) - side(b)); });
}

/// What lies between the edges of a lane, which run straight from row to row.
template <class Number>
Polygon<Number> in_lane(const Polygon<Number>& part, double ahead_m, double length_m, const LaneSpan& near, const LaneSpan& far) {
    const Polygon<Number> right_of_left_edge = beside(part, ahead_m, near.left_m, (far.left_m - near.left_m) / length_m, -1.0);
    return beside(right_of_left_edge, ahead_m, near.right_m, (far.right_m - near.right_m) / length_m, 1.0);
}

/// A cell's two triangles, between its near and far row and its right and left column.
std::array<Polygon<double>, 2> triangles_of(const ExtentGrid& grid, const std::vector<double>& lx, std::size_t row, std::size_t column) {
    const auto corner = [&](std::size_t r, std::size_t c) {
        return Corner<double>{grid.ahead_m[r], grid.offset_m[c], lx[r * grid.offset_m.size() + c]};
    };
    const Corner<double> near_right = corner(row, column), far_left = corner(row + 1, column + 1);
    return {Polygon<double>{{near_right, corner(row + 1, column), far_left}, 3},
            Polygon<double>{{near_right, far_left, corner(row, column + 1)}, 3}};
}

/// With each corner's light as what is answered to.
Polygon<Graded> graded(const Polygon<double>& triangle) {
    Polygon<Graded> result;
    for (std::size_t i = 0; i < triangle.count; ++i) {
        const Corner<double>& corner = triangle.corners[i];
        result.add({corner.ahead_m, corner.offset_m, corner.lx});
        result.corners[i].lx.by[i] = 1.0;
    }
    return result;
}

/// Area of the part that `cut` leaves of the lit part of each of the cell's triangles.
template <class Cut>
double lit_part_m2(const std::array<Polygon<double>, 2>& triangles, const CellArea& areas_m2, double threshold_lx, Cut cut) {
    double lit_m2 = 0.0;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        lit_m2 += areas_m2[i] * (signed_area(cut(lit_part(triangles[i], threshold_lx))) / signed_area(triangles[i]));
    return lit_m2;
}

} // namespace

namespace {

/// Places of a row of a grid, one after the other.
struct RowPlaces {
    const double *x_m, *y_m, *z_m;
};

/// Squares of twice the areas of the two triangles of each cell between two rows.
FERNLICHT_WIDEST void strip_areas(const RowPlaces& near, const RowPlaces& far, std::size_t cells, double* __restrict right_m4,
                                  double* __restrict left_m4) {
    for (std::size_t i = 0; i < cells; ++i) {
        const double ahead_x = far.x_m[i] - near.x_m[i], ahead_y = far.y_m[i] - near.y_m[i], ahead_z = far.z_m[i] - near.z_m[i];
        const double across_x = far.x_m[i + 1] - near.x_m[i], across_y = far.y_m[i + 1] - near.y_m[i],
                     across_z = far.z_m[i + 1] - near.z_m[i];
        const double beside_x = near.x_m[i + 1] - near.x_m[i], beside_y = near.y_m[i + 1] - near.y_m[i],
                     beside_z = near.z_m[i + 1] - near.z_m[i];
        const double right_x = ahead_y * across_z - across_y * ahead_z, right_y = ahead_z * across_x - across_z * ahead_x,
                     right_z = ahead_x * across_y - across_x * ahead_y;
        const double left_x = across_y * beside_z - beside_y * across_z, left_y = across_z * beside_x - beside_z * across_x,
                     left_z = across_x * beside_y - beside_x * across_y;
        right_m4[i] = right_x * right_x + right_y * right_y + right_z * right_z;
        left_m4[i] = left_x * left_x + left_y * left_y + left_z * left_z;
    }
}

} // namespace

std::vector<CellArea> cell_areas_m2(const ExtentGrid& grid, std::size_t step, std::size_t rows, std::size_t columns) {
    const std::size_t stride = grid.offset_m.size(), cells = columns > 0 ? (columns - 1) / step : 0,
                      strips = rows > 0 ? (rows - 1) / step : 0;
    const SurfacePlaces own = grid.places.x_m.empty() ? SurfacePlaces(grid.surface) : SurfacePlaces();
    const SurfacePlaces& places = grid.places.x_m.empty() ? own : grid.places;
    std::vector<CellArea> areas_m2(strips * cells);
    std::vector<double> right_m4(cells), left_m4(cells), picked[2][3];
    const auto row_places = [&](std::size_t row) {
        const std::size_t first = row * step * stride;
        if (step == 1)
            return RowPlaces{&places.x_m[first], &places.y_m[first], &places.z_m[first]};
        const std::vector<double>* const from[]{&places.x_m, &places.y_m, &places.z_m};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::vector<double>& to = picked[row % 2][axis];
            to.resize(cells + 1);
            for (std::size_t i = 0; i <= cells; ++i)
                to[i] = (*from[axis])[first + i * step];
        }
        return RowPlaces{picked[row % 2][0].data(), picked[row % 2][1].data(), picked[row % 2][2].data()};
    };
    if (strips == 0 || cells == 0)
        return {};
    RowPlaces near = row_places(0);
    for (std::size_t row = 0; row < strips; ++row) {
        const RowPlaces far = row_places(row + 1);
        strip_areas(near, far, cells, right_m4.data(), left_m4.data());
        for (std::size_t i = 0; i < cells; ++i)
            areas_m2[row * cells + i] = {0.5 * std::sqrt(right_m4[i]), 0.5 * std::sqrt(left_m4[i])};
        near = far;
    }
    return areas_m2;
}

namespace {

FERNLICHT_WIDEST void mark_lit(const double* __restrict lx, std::size_t count, double threshold_lx, unsigned char* __restrict lit) {
    for (std::size_t i = 0; i < count; ++i)
        lit[i] = lx[i] >= threshold_lx ? 1 : 0;
}

FERNLICHT_WIDEST void count_lit_corners(const unsigned char* __restrict near, const unsigned char* __restrict far, std::size_t cells,
                                        unsigned char* __restrict corners) {
    for (std::size_t i = 0; i < cells; ++i)
        corners[i] = static_cast<unsigned char>(near[i] + near[i + 1] + far[i] + far[i + 1]);
}

} // namespace

LitArea::LitArea(const LitRoad& road, double threshold_lx) : road_(&road), threshold_lx_(threshold_lx) {
    std::size_t strips = road.grid_.ahead_m.size() - 1;
    while (strips > 0 && strip_is_dark(strips - 1))
        --strips;
    lit_m2_.resize(strips * cells());
    std::vector<unsigned char> near_lit(cells() + 1), far_lit(cells() + 1), lit_corners(cells());
    const auto look_at = [&](std::size_t row) {
        near_lit.swap(far_lit);
        mark_lit(road.row(row), cells() + 1, threshold_lx, far_lit.data());
    };
    look_at(0);
    for (std::size_t row = 0; row < strips; ++row) {
        look_at(row + 1);
        if (strip_is_dark(row))
            continue;
        count_lit_corners(near_lit.data(), far_lit.data(), cells(), lit_corners.data());
        for (std::size_t column = 0; column < cells(); ++column) {
            std::uint64_t eight = 0;
            if (column + sizeof eight <= cells()) {
                std::memcpy(&eight, &lit_corners[column], sizeof eight);
                if (eight == 0) {
                    column += sizeof eight - 1;
                    continue;
                }
            }
            if (lit_corners[column] == 0)
                continue;
            const std::size_t cell = row * cells() + column;
            const CellArea& areas_m2 = road.cell_m2_[cell];
            lit_m2_[cell] = lit_corners[column] == 4
                                ? areas_m2[0] + areas_m2[1]
                                : lit_part_m2(triangles_of(road.grid_, road.lx_, row, column), areas_m2, threshold_lx, std::identity());
        }
    }
}

double LitArea::all_m2() const {
    double lit_m2 = 0.0;
    for (std::size_t row = 0; row + 1 < road_->grid_.ahead_m.size(); ++row)
        for (std::size_t column = 0; !strip_is_dark(row) && column < cells(); ++column)
            lit_m2 += lit_m2_[row * cells() + column];
    return lit_m2;
}

double LitArea::in_cut_cell_m2(std::size_t row, std::size_t column, const LaneSpan& near, const LaneSpan& far, double* known_m2) const {
    const double *nearer = road_->row(row) + column, *farther = road_->row(row + 1) + column;
    if (nearer[0] < threshold_lx_ && nearer[1] < threshold_lx_ && farther[0] < threshold_lx_ && farther[1] < threshold_lx_)
        return 0.0;
    const bool all_lit =
        nearer[0] >= threshold_lx_ && nearer[1] >= threshold_lx_ && farther[0] >= threshold_lx_ && farther[1] >= threshold_lx_;
    if (all_lit && known_m2 && !std::isnan(*known_m2))
        return *known_m2;
    const double ahead_m = road_->grid_.ahead_m[row], length_m = road_->grid_.ahead_m[row + 1] - ahead_m;
    const double cut_m2 =
        lit_part_m2(triangles_of(road_->grid_, road_->lx_, row, column), road_->cell_m2_[row * cells() + column], threshold_lx_,
                    [&](const Polygon<double>& part) { return in_lane(part, ahead_m, length_m, near, far); });
    if (all_lit && known_m2)
        *known_m2 = cut_m2;
    return cut_m2;
}

std::pair<std::size_t, std::size_t> LitArea::columns_of(const LaneSpan& near, const LaneSpan& far) const {
    const std::vector<double>& offsets = road_->grid_.offset_m;
    const auto column_at = [&offsets](double offset_m) {
        const auto above = std::ranges::upper_bound(offsets, offset_m);
        return std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - offsets.begin() - 1, 0)), offsets.size() - 2);
    };
    return {column_at(std::min(near.right_m, far.right_m)), column_at(std::max(near.left_m, far.left_m))};
}

/// Between two rows: cells wholly inside the lane count as they are, those that an edge cuts are clipped.
double LitArea::in_strip_m2(std::size_t row, const LaneSpan& near, const LaneSpan& far, std::array<double, 8>& known_m2) const {
    const std::vector<double>& offsets = road_->grid_.offset_m;
    const auto [first, last] = columns_of(near, far);
    const double inner_right_m = std::max(near.right_m, far.right_m);
    const double inner_left_m = std::min(near.left_m, far.left_m);
    double lit_m2 = 0.0;
    for (std::size_t column = first; column <= last; ++column) {
        const bool inside = offsets[column] >= inner_right_m && offsets[column + 1] <= inner_left_m;
        const std::size_t to_right = column - first, to_left = last - column;
        double* const known = to_right < 4 ? &known_m2[to_right] : to_left < 4 ? &known_m2[4 + to_left] : nullptr;
        lit_m2 += inside ? lit_m2_[row * cells() + column] : in_cut_cell_m2(row, column, near, far, known);
    }
    return lit_m2;
}

LitArea::CutCells LitArea::no_cut_cells(std::size_t rows) {
    std::array<double, 8> none{};
    none.fill(std::numeric_limits<double>::quiet_NaN());
    return CutCells(rows, none);
}

double LitArea::lane_m2(const LaneSpans& lane, CutCells& known) const {
    double lit_m2 = 0.0;
    for (std::size_t row = 0; row + 1 < road_->grid_.ahead_m.size(); ++row)
        if (lane[row] && lane[row + 1] && !strip_is_dark(row))
            lit_m2 += in_strip_m2(row, *lane[row], *lane[row + 1], known[row]);
    return lit_m2;
}

std::vector<double> LitArea::lane_shares(const LaneSpans& lane) const {
    const std::size_t stride = road_->grid_.offset_m.size();
    std::vector<double> shares(road_->lx_.size());
    for (std::size_t row = 0; row + 1 < road_->grid_.ahead_m.size(); ++row) {
        if (!lane[row] || !lane[row + 1] || strip_is_dark(row))
            continue;
        const double ahead_m = road_->grid_.ahead_m[row], length_m = road_->grid_.ahead_m[row + 1] - ahead_m;
        const auto [first, last] = columns_of(*lane[row], *lane[row + 1]);
        for (std::size_t column = first; column <= last; ++column) {
            const std::size_t here = row * stride + column;
            const std::array<std::array<std::size_t, 3>, 2> corners{
                {{here, here + stride, here + stride + 1}, {here, here + stride + 1, here + 1}}}; // as triangles_of()
            const std::array<Polygon<double>, 2> triangles = triangles_of(road_->grid_, road_->lx_, row, column);
            for (std::size_t i = 0; i < triangles.size(); ++i) {
                const Graded lit =
                    signed_area(in_lane(lit_part(graded(triangles[i]), threshold_lx_), ahead_m, length_m, *lane[row], *lane[row + 1]));
                for (std::size_t k = 0; k < lit.by.size(); ++k)
                    shares[corners[i][k]] += road_->cell_m2_[row * cells() + column][i] / signed_area(triangles[i]) * lit.by[k];
            }
        }
    }
    return shares;
}

} // namespace fernlicht
