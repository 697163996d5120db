#include "scenarios/roads/mesh_row.h"

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

struct Heights {
    std::size_t first = 0, last = 0; ///< borders from the right edge to the left
    std::vector<Step> at;
};

/// Heights of a cross-section at the borders that it spans.
Heights heights_over(const std::vector<double>& borders, const std::vector<Strip>& strips) {
    Heights out;
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

/// Whether a triangle lies upside down: the strip is folded, for it reaches beyond the centre of a bend.
bool upside_down(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& up) {
    return glm::dot(glm::cross(b - a, c - a), up) < -1e-9;
}

/// The first and the last point at t.
Range points_at(const Row& row, double t) {
    std::size_t nearest = 0;
    const auto next = std::lower_bound(row.points.begin(), row.points.end(), t, [](const RowPoint& p, double v) { return p.t_m < v; });
    nearest = static_cast<std::size_t>(next - row.points.begin());
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
    const Heights old_heights = heights_over(borders, before), new_heights = heights_over(borders, after);
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
    const Range a = from.range, b = to.range;
    if (a.first == a.last && b.first == b.last)
        return;
    const auto near = [&](std::size_t i) { return from.row.points[i].pose.position_m; };
    const auto far = [&](std::size_t j) { return to.row.points[j].pose.position_m; };
    const bool face = from.strip.kerb_face;
    const double direction = face ? face_direction(from.strip, to.strip) : 0.0;
    const auto vertex = [&](const Strip& strip, const RowPoint& point) {
        return builder.vertex(point.pose.position_m, face ? direction * point.pose.left() : surface_normal(strip, point));
    };
    std::size_t i = a.first, j = b.first;
    std::uint32_t vi = vertex(from.strip, from.row.points[i]), vj = vertex(to.strip, to.row.points[j]);
    const auto add = [&](std::uint32_t next, const glm::dvec3& next_place) {
        if (!face && upside_down(near(i), far(j), next_place, from.row.points[i].pose.up()))
            builder.triangle(material, vi, next, vj);
        else
            builder.triangle(material, vi, vj, next);
    };
    while (i < a.last || j < b.last) {
        const auto diagonal = [](const glm::dvec3& p, const glm::dvec3& q) { return glm::dot(p - q, p - q); };
        const bool step_near = j == b.last || (i < a.last && diagonal(near(i + 1), far(j)) <= diagonal(far(j + 1), near(i)));
        if (step_near) {
            const std::uint32_t next = vertex(from.strip, from.row.points[i + 1]);
            add(next, near(i + 1));
            vi = next;
            ++i;
        } else {
            const std::uint32_t next = vertex(to.strip, to.row.points[j + 1]);
            add(next, far(j + 1));
            vj = next;
            ++j;
        }
    }
}

} // namespace fernlicht
