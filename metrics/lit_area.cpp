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

double triangle_area_m2(const Pose& a, const Pose& b, const Pose& c) {
    return 0.5 * glm::length(glm::cross(b.position_m - a.position_m, c.position_m - a.position_m));
}

/// The grid's numbers as the functions below walk over them.
struct Field {
    const ExtentGrid& grid;
    const std::vector<double>& lx;
    const std::vector<double>& brightest_lx;
    double limit_lx;

    std::size_t columns() const { return grid.offset_m.size(); }
    std::size_t strips() const { return grid.ahead_m.empty() || columns() < 2 ? 0 : grid.ahead_m.size() - 1; }
    bool strip_is_dark(std::size_t row) const { return brightest_lx[row] < limit_lx && brightest_lx[row + 1] < limit_lx; }
    Cell cell(std::size_t row, std::size_t column) const {
        const auto corner = [this](std::size_t r, std::size_t c) {
            return Corner{grid.ahead_m[r], grid.offset_m[c], lx[r * columns() + c]};
        };
        return {corner(row, column), corner(row, column + 1), corner(row + 1, column), corner(row + 1, column + 1)};
    }
    /// Road surface in m2 of the cell's two triangles, in the order of Cell::triangles.
    std::array<double, 2> areas_m2(std::size_t row, std::size_t column) const {
        const Pose* near = &grid.surface[row * columns() + column];
        const Pose* far = near + columns();
        return {triangle_area_m2(near[0], far[0], far[1]), triangle_area_m2(near[0], far[1], near[1])};
    }
};

/// Area of the part that `cut` leaves of the lit part of each of the cell's triangles.
template <class Cut> double lit_part_m2(const Field& field, std::size_t row, std::size_t column, const Cell& cell, Cut cut) {
    const std::array<double, 2> areas_m2 = field.areas_m2(row, column);
    const std::array<Polygon, 2> triangles = cell.triangles();
    double lit_m2 = 0.0;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        lit_m2 += areas_m2[i] * (signed_area(cut(lit_part(triangles[i], field.limit_lx))) / signed_area(triangles[i]));
    return lit_m2;
}

double lit_in_cell_m2(const Field& field, std::size_t row, std::size_t column) {
    const Cell cell = field.cell(row, column);
    if (cell.dark(field.limit_lx))
        return 0.0;
    if (!cell.lit(field.limit_lx))
        return lit_part_m2(field, row, column, cell, [](const Polygon& part) { return part; });
    const std::array<double, 2> areas_m2 = field.areas_m2(row, column);
    return areas_m2[0] + areas_m2[1];
}

double lit_in_cut_cell_m2(const Field& field, std::size_t row, std::size_t column, const LaneSpan& near, const LaneSpan& far) {
    const Cell cell = field.cell(row, column);
    if (cell.dark(field.limit_lx))
        return 0.0;
    const double ahead_m = field.grid.ahead_m[row];
    const double length_m = field.grid.ahead_m[row + 1] - ahead_m;
    return lit_part_m2(field, row, column, cell, [&](const Polygon& part) {
        const Polygon right_of_left_edge = beside(part, ahead_m, near.left_m, (far.left_m - near.left_m) / length_m, -1.0);
        return beside(right_of_left_edge, ahead_m, near.right_m, (far.right_m - near.right_m) / length_m, 1.0);
    });
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

} // namespace

double lit_area_m2(const ExtentGrid& grid, const std::vector<double>& lx, const std::vector<double>& brightest_lx, double limit_lx) {
    const Field field{grid, lx, brightest_lx, limit_lx};
    double lit_m2 = 0.0;
    for (std::size_t row = 0; row < field.strips(); ++row)
        for (std::size_t column = 0; !field.strip_is_dark(row) && column + 1 < field.columns(); ++column)
            lit_m2 += lit_in_cell_m2(field, row, column);
    return lit_m2;
}

double lit_area_m2(const ExtentGrid& grid, const std::vector<double>& lx, const std::vector<double>& brightest_lx, double limit_lx,
                   const LaneSpans& lane) {
    const Field field{grid, lx, brightest_lx, limit_lx};
    double lit_m2 = 0.0;
    for (std::size_t row = 0; row < field.strips(); ++row)
        if (lane[row] && lane[row + 1] && !field.strip_is_dark(row))
            lit_m2 += lit_in_strip_m2(field, row, *lane[row], *lane[row + 1]);
    return lit_m2;
}

} // namespace fernlicht
