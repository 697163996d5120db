#include "metrics/lit_area.h"

#include "metrics/crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

struct Corner {
    double ahead_m = 0.0, offset_m = 0.0, lx = 0.0;
};

/// A convex part of a triangle: three corners, and one more for each of at most three cuts.
struct Polygon {
    std::array<Corner, 8> corners;
    std::size_t count = 0;
    void add(const Corner& corner) { corners[count++] = corner; }
};

double signed_area(const Polygon& polygon) {
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Corner& a = polygon.corners[i];
        const Corner& b = polygon.corners[(i + 1) % polygon.count];
        twice += a.ahead_m * b.offset_m - b.ahead_m * a.offset_m;
    }
    return 0.5 * twice;
}

/// Sutherland and Hodgman: keeps the corners that `inside` keeps and cuts the sides that leave it at `share(a, b)` of their length.
template <class Inside, class Share> Polygon clipped(const Polygon& polygon, Inside inside, Share share) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Corner& a = polygon.corners[i];
        const Corner& b = polygon.corners[(i + 1) % polygon.count];
        if (inside(a))
            result.add(a);
        if (inside(a) != inside(b)) {
            const double f = share(a, b);
            result.add({a.ahead_m + (b.ahead_m - a.ahead_m) * f, a.offset_m + (b.offset_m - a.offset_m) * f, a.lx + (b.lx - a.lx) * f});
        }
    }
    return result;
}

Polygon lit_part(const Polygon& polygon, double limit_lx) {
    return clipped(
        polygon, [limit_lx](const Corner& c) { return c.lx >= limit_lx; },
        [limit_lx](const Corner& a, const Corner& b) { return crossing_share(a.lx, b.lx, limit_lx); });
}

/// What lies on the side of a straight lane edge where `sign * (offset - edge)` is not negative.
Polygon beside(const Polygon& polygon, double from_ahead_m, double from_offset_m, double slope, double sign) {
    const auto side = [=](const Corner& c) { return sign * (c.offset_m - (from_offset_m + slope * (c.ahead_m - from_ahead_m))); };
    return clipped(
        polygon, [side](const Corner& c) { return side(c) >= 0.0; },
        [side](const Corner& a, const Corner& b) { return side(a) / (side(a) - side(b)); });
}

/// One cell with its four corners: near and far row, right and left column.
struct Cell {
    Corner near_right, near_left, far_right, far_left;

    bool lit(double limit_lx) const {
        return near_right.lx >= limit_lx && near_left.lx >= limit_lx && far_right.lx >= limit_lx && far_left.lx >= limit_lx;
    }
    bool dark(double limit_lx) const {
        return near_right.lx < limit_lx && near_left.lx < limit_lx && far_right.lx < limit_lx && far_left.lx < limit_lx;
    }
    std::array<Polygon, 2> triangles() const {
        return {Polygon{{near_right, far_right, far_left}, 3}, Polygon{{near_right, far_left, near_left}, 3}};
    }
};

/// The grid's numbers as the functions below walk over them.
struct Field {
    const ExtentGrid& grid;
    const std::vector<double>& areas_m2;
    const std::vector<double>& lx;
    double limit_lx;

    std::size_t columns() const { return grid.offset_m.size(); }
    const double* areas(std::size_t row, std::size_t column) const { return &areas_m2[2 * (row * (columns() - 1) + column)]; }
    Cell cell(std::size_t row, std::size_t column) const {
        const auto corner = [this](std::size_t r, std::size_t c) {
            return Corner{grid.ahead_m[r], grid.offset_m[c], lx[r * columns() + c]};
        };
        return {corner(row, column), corner(row, column + 1), corner(row + 1, column), corner(row + 1, column + 1)};
    }
};

double lit_in_cell_m2(const Field& field, std::size_t row, std::size_t column) {
    const Cell cell = field.cell(row, column);
    const double* areas = field.areas(row, column);
    if (cell.lit(field.limit_lx))
        return areas[0] + areas[1];
    double lit_m2 = 0.0;
    if (!cell.dark(field.limit_lx))
        for (std::size_t i = 0; i < 2; ++i) {
            const Polygon triangle = cell.triangles()[i];
            lit_m2 += areas[i] * (signed_area(lit_part(triangle, field.limit_lx)) / signed_area(triangle));
        }
    return lit_m2;
}

double lit_in_cut_cell_m2(const Field& field, std::size_t row, std::size_t column, const LaneSpan& near, const LaneSpan& far) {
    const Cell cell = field.cell(row, column);
    if (cell.dark(field.limit_lx))
        return 0.0;
    const double ahead_m = field.grid.ahead_m[row];
    const double length_m = field.grid.ahead_m[row + 1] - ahead_m;
    const double* areas = field.areas(row, column);
    double lit_m2 = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        const Polygon triangle = cell.triangles()[i];
        Polygon part = lit_part(triangle, field.limit_lx);
        part = beside(part, ahead_m, near.left_m, (far.left_m - near.left_m) / length_m, -1.0);
        part = beside(part, ahead_m, near.right_m, (far.right_m - near.right_m) / length_m, 1.0);
        lit_m2 += areas[i] * (signed_area(part) / signed_area(triangle));
    }
    return lit_m2;
}

/// Between two rows: cells wholly inside the lane count as they are, those that an edge cuts are clipped.
double lit_in_strip_m2(const Field& field, std::size_t row, const LaneSpan& near, const LaneSpan& far) {
    const std::vector<double>& offsets = field.grid.offset_m;
    const auto column_at = [&offsets](double offset_m) {
        const auto above = std::ranges::upper_bound(offsets, offset_m);
        return std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - offsets.begin() - 1, 0)), offsets.size() - 2);
    };
    const std::size_t first = column_at(std::min(near.right_m, far.right_m));
    const std::size_t last = column_at(std::max(near.left_m, far.left_m));
    const double inner_right_m = std::max(near.right_m, far.right_m);
    const double inner_left_m = std::min(near.left_m, far.left_m);
    double lit_m2 = 0.0;
    for (std::size_t column = first; column <= last; ++column) {
        const bool inside = offsets[column] >= inner_right_m && offsets[column + 1] <= inner_left_m;
        lit_m2 += inside ? lit_in_cell_m2(field, row, column) : lit_in_cut_cell_m2(field, row, column, near, far);
    }
    return lit_m2;
}

double triangle_area_m2(const Pose& a, const Pose& b, const Pose& c) {
    return 0.5 * glm::length(glm::cross(b.position_m - a.position_m, c.position_m - a.position_m));
}

} // namespace

std::vector<double> triangle_areas_m2(const ExtentGrid& grid) {
    std::vector<double> areas;
    const std::size_t columns = grid.offset_m.size();
    if (grid.ahead_m.size() < 2 || columns < 2)
        return areas;
    areas.reserve(2 * (grid.ahead_m.size() - 1) * (columns - 1));
    for (std::size_t row = 0; row + 1 < grid.ahead_m.size(); ++row)
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const Pose* near = &grid.surface[row * columns + column];
            const Pose* far = near + columns;
            areas.push_back(triangle_area_m2(near[0], far[0], far[1]));
            areas.push_back(triangle_area_m2(near[0], far[1], near[1]));
        }
    return areas;
}

double lit_area_m2(const ExtentGrid& grid, const std::vector<double>& areas_m2, const std::vector<double>& lx, double limit_lx) {
    const Field field{grid, areas_m2, lx, limit_lx};
    double lit_m2 = 0.0;
    for (std::size_t row = 0; row + 1 < grid.ahead_m.size(); ++row)
        for (std::size_t column = 0; column + 1 < grid.offset_m.size(); ++column)
            lit_m2 += lit_in_cell_m2(field, row, column);
    return lit_m2;
}

double lit_area_m2(const ExtentGrid& grid, const std::vector<double>& areas_m2, const std::vector<double>& lx, double limit_lx,
                   const LaneSpans& lane) {
    const Field field{grid, areas_m2, lx, limit_lx};
    double lit_m2 = 0.0;
    for (std::size_t row = 0; row + 1 < grid.ahead_m.size() && grid.offset_m.size() >= 2; ++row)
        if (lane[row] && lane[row + 1])
            lit_m2 += lit_in_strip_m2(field, row, *lane[row], *lane[row + 1]);
    return lit_m2;
}

} // namespace fernlicht
