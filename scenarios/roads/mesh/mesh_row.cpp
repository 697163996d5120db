#include "scenarios/roads/mesh/mesh_surface.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fernlicht {

namespace {

constexpr double same_place_m = 1e-4;

/// Every t of both cross-sections and of the crown between them, ascending.
std::vector<double> common_borders(const std::vector<Strip>& before, const std::vector<Strip>& after, const std::vector<double>& crown) {
    std::vector<double> all;
    for (const auto* strips : {&before, &after})
        for (const Strip& strip : *strips) {
            all.push_back(strip.right_t_m);
            all.push_back(strip.left_t_m);
        }
    if (all.empty())
        return all;
    const auto [right, left] = std::minmax_element(all.begin(), all.end());
    const double right_t = *right, left_t = *left;
    for (const double t : crown)
        if (t > right_t + same_place_m && t < left_t - same_place_m)
            all.push_back(t);
    std::sort(all.begin(), all.end());
    std::vector<double> out;
    for (const double t : all)
        if (out.empty() || t - out.back() >= same_place_m)
            out.push_back(t);
    return out;
}

/// Index of the border that stands for t.
std::size_t border_of(const std::vector<double>& borders, double t) {
    const auto next = static_cast<std::size_t>(std::lower_bound(borders.begin(), borders.end(), t) - borders.begin());
    if (next == borders.size())
        return next - 1;
    return next > 0 && t - borders[next - 1] < borders[next] - t ? next - 1 : next;
}

struct Step { ///< heights right and left of a border
    double right_h_m = 0.0, left_h_m = 0.0;
};

struct RowHeights {
    std::size_t first = 0, last = 0; ///< borders from the right edge to the left
    std::vector<Step> at;
};

/// RowHeights of a cross-section at the borders that it spans.
RowHeights heights_over(const std::vector<double>& borders, const std::vector<Strip>& strips) {
    RowHeights out;
    out.at.resize(borders.size());
    if (strips.empty())
        return out;
    out.first = border_of(borders, strips.front().right_t_m);
    out.last = out.first;
    out.at[out.first] = {strips.front().right_h_m, strips.front().right_h_m};
    for (const Strip& strip : strips) {
        const std::size_t left = std::max(out.last, border_of(borders, strip.left_t_m));
        for (std::size_t k = out.last + 1; k < left; ++k)
            out.at[k].right_h_m = out.at[k].left_h_m = strip.height_at(borders[k]);
        if (left > out.last)
            out.at[left].right_h_m = strip.left_h_m;
        out.at[left].left_h_m = strip.left_h_m;
        out.last = left;
    }
    // No step at the outer edges: it would be the kerb of a lane that has no width left.
    out.at[out.first].right_h_m = out.at[out.first].left_h_m;
    out.at[out.last].left_h_m = out.at[out.last].right_h_m;
    return out;
}

/// Which way a vertical face looks: +1 to the left, falling from right to left, else -1. Of both ends of a stretch the higher step counts:
/// at the other one the kerb may have come down to nothing.
double face_direction(const Strip& from, const Strip& to) {
    const double a = from.left_h_m - from.right_h_m, b = to.left_h_m - to.right_h_m;
    return (std::abs(a) > std::abs(b) ? a : b) < 0.0 ? 1.0 : -1.0;
}

glm::dvec3 surface_normal(const Strip& strip, const RowPoint& point) {
    const double width = strip.left_t_m - strip.right_t_m;
    const double slope = width > same_place_m ? (strip.left_h_m - strip.right_h_m) / width : 0.0;
    return slope == 0.0 ? point.pose.up() : glm::normalize(point.pose.up() - slope * point.pose.left());
}

struct StripCorner {
    glm::dvec3 position_m;
    glm::dvec3 normal;
};

/// Triangles of a fold, where the road reaches beyond the centre of its bend, lie upside down and are turned over. Where the triangle
/// is far from the surface that the normals belong to (the ramp of a kerb), it has its own.
void append_triangle(MeshBuilder& builder, std::uint32_t material, std::array<StripCorner, 3> corners, bool upright) {
    const auto across = [&] {
        return glm::cross(corners[1].position_m - corners[0].position_m, corners[2].position_m - corners[0].position_m);
    };
    const glm::dvec3 up = corners[0].normal;
    if (glm::dot(across(), up) < -1e-9 && !upright)
        std::swap(corners[1], corners[2]);
    const glm::dvec3 own = across();
    const double twice_area = glm::length(own);
    constexpr double cosine_of_60 = 0.5;
    for (StripCorner& corner : corners)
        if (twice_area > 1e-9 && glm::dot(own, corner.normal) < cosine_of_60 * twice_area)
            corner.normal = own;
    std::array<std::uint32_t, 3> v{};
    for (std::size_t k = 0; k < 3; ++k)
        v[k] = builder.vertex(corners[k].position_m, corners[k].normal);
    builder.triangle(material, v[0], v[1], v[2]);
}

/// The first and the last point at t.
Range points_at(const Row& row, double t) {
    auto nearest = static_cast<std::size_t>(std::ranges::lower_bound(row.points, t, {}, &RowPoint::t_m) - row.points.begin());
    if (nearest == row.points.size() || (nearest > 0 && t - row.points[nearest - 1].t_m < row.points[nearest].t_m - t))
        --nearest;
    Range range{nearest, nearest};
    while (range.first > 0 && row.points[range.first - 1].t_m == row.points[nearest].t_m)
        --range.first;
    while (range.last + 1 < row.points.size() && row.points[range.last + 1].t_m == row.points[nearest].t_m)
        ++range.last;
    return range;
}

} // namespace

Row make_row(const RoadNetwork& network, const Road& road, double s_m, const std::vector<Strip>& before, const std::vector<Strip>& after,
             const std::vector<double>& crown) {
    Row row;
    row.s_m = s_m;
    const std::vector<double> borders = common_borders(before, after, crown);
    const auto place = [&](double t, double h) {
        if (!row.points.empty() && row.points.back().t_m == t && std::abs(row.points.back().h_m - h) < same_place_m)
            return;
        RowPoint point{t, h, surface_pose(network, road, s_m, t)};
        point.pose.position_m += h * point.pose.up();
        row.points.push_back(point);
    };
    const RowHeights old_heights = heights_over(borders, before), new_heights = heights_over(borders, after);
    for (std::size_t k = 0; k < borders.size(); ++k) {
        const bool in_new = !after.empty() && k >= new_heights.first && k <= new_heights.last;
        const bool in_old = !before.empty() && k >= old_heights.first && k <= old_heights.last;
        if (in_old && (!in_new || (k == new_heights.first && k > old_heights.first)))
            place(borders[k], old_heights.at[k].right_h_m);
        if (in_new) {
            place(borders[k], new_heights.at[k].right_h_m);
            place(borders[k], new_heights.at[k].left_h_m);
        }
        if (in_old && (!in_new || (k == new_heights.last && k < old_heights.last)))
            place(borders[k], old_heights.at[k].left_h_m);
    }
    return row;
}

std::vector<Range> ranges_in(const Row& row, const std::vector<Strip>& strips) {
    std::vector<Range> out;
    if (strips.empty())
        return out;
    std::size_t at = points_at(row, strips.front().right_t_m).last;
    for (std::size_t i = 0; i < strips.size(); ++i) {
        const Range border = points_at(row, strips[i].left_t_m);
        // A face stands between the two points of a border; a strip ends below the face that follows it, or at the road's edge.
        const bool before_face = i + 1 == strips.size() || strips[i + 1].kerb_face;
        const std::size_t end = strips[i].kerb_face ? border.last : before_face ? border.first : border.last;
        out.push_back({at, std::max(at, end)});
        at = out.back().last;
    }
    return out;
}

void append_strip(MeshBuilder& builder, std::uint32_t material, const StripEnd& from, const StripEnd& to) {
    const bool face = from.strip.kerb_face;
    const double direction = face ? face_direction(from.strip, to.strip) : 0.0;
    const auto corner = [&](const StripEnd& end, std::size_t i) {
        const Pose& pose = end.row.points[i].pose;
        return StripCorner{pose.position_m, face ? direction * pose.left() : surface_normal(end.strip, end.row.points[i])};
    };
    std::size_t i = from.range.first, j = to.range.first;
    StripCorner near = corner(from, i), far = corner(to, j);
    while (i < from.range.last || j < to.range.last) {
        const auto squared = [](const glm::dvec3& v) { return glm::dot(v, v); };
        const bool near_ends = i == from.range.last, far_ends = j == to.range.last;
        const double near_diagonal = near_ends ? 0.0 : squared(from.row.points[i + 1].pose.position_m - far.position_m);
        const double far_diagonal = far_ends ? 0.0 : squared(to.row.points[j + 1].pose.position_m - near.position_m);
        // Equal diagonals are common; the tolerance keeps rounding (a road far from the origin) from choosing between them.
        const bool step_near = far_ends || (!near_ends && near_diagonal <= far_diagonal + 1e-6);
        const StripCorner next = step_near ? corner(from, ++i) : corner(to, ++j);
        append_triangle(builder, material, {near, far, next}, face);
        (step_near ? near : far) = next;
    }
}

} // namespace fernlicht
