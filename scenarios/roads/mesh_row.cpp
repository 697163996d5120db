#include "scenarios/roads/mesh_row.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fernlicht {

namespace {

constexpr double same_place_m = 1e-4;

/// The member of `borders` that stands for t.
double canonical(const std::vector<double>& borders, double t) {
    const auto next = std::lower_bound(borders.begin(), borders.end(), t);
    if (next == borders.end())
        return borders.back();
    if (next == borders.begin())
        return *next;
    return t - *(next - 1) < *next - t ? *(next - 1) : *next;
}

glm::dvec3 normal_of(const Strip& strip, const RowPoint& point) {
    if (strip.kerb_face)
        return strip.left_h_m > strip.right_h_m ? -point.pose.left() : point.pose.left();
    const double width = strip.left_t_m - strip.right_t_m;
    const double slope = width > same_place_m ? (strip.left_h_m - strip.right_h_m) / width : 0.0;
    return slope == 0.0 ? point.pose.up() : glm::normalize(point.pose.up() - slope * point.pose.left());
}

/// Heights of a row on the interval between two neighbouring borders: the point it leaves and the point it arrives at.
struct Piece {
    const RowPoint* right = nullptr;
    const RowPoint* left = nullptr;
};

std::vector<Piece> pieces(const Row& row) {
    std::vector<Piece> out;
    for (std::size_t i = 0; i + 1 < row.points.size(); ++i)
        if (row.points[i + 1].t_m > row.points[i].t_m)
            out.push_back({&row.points[i], &row.points[i + 1]});
    return out;
}

} // namespace

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

Row make_row(const RoadNetwork& network, const Road& road, double s_m, const std::vector<Strip>& strips,
             const std::vector<double>& borders) {
    Row row;
    row.s_m = s_m;
    const auto place = [&](double t, double h) {
        if (!row.points.empty() && row.points.back().t_m == t && std::abs(row.points.back().h_m - h) < same_place_m)
            return;
        RowPoint point{t, h, surface_pose(network, road, s_m, t)};
        point.pose.position_m += h * point.pose.up();
        row.points.push_back(point);
    };
    for (const Strip& strip : strips) {
        const double right = canonical(borders, strip.right_t_m);
        const double left = std::max(right, canonical(borders, strip.left_t_m));
        place(right, strip.right_h_m);
        Row::Range range;
        range.first = row.points.size() - 1;
        for (auto t = std::upper_bound(borders.begin(), borders.end(), right); t != borders.end() && *t < left; ++t)
            place(*t, strip.height_at(*t));
        place(left, strip.left_h_m);
        range.last = row.points.size() - 1;
        row.strips.push_back(range);
    }
    return row;
}

void append_strip(MeshBuilder& builder, std::uint32_t material, const Strip& at_from, const Row& from, const Strip& at_to, const Row& to,
                  std::size_t index) {
    const Row::Range a = from.strips[index];
    const Row::Range b = to.strips[index];
    if (a.first == a.last && b.first == b.last)
        return;
    const auto near = [&](std::size_t i) { return from.points[i].pose.position_m; };
    const auto far = [&](std::size_t j) { return to.points[j].pose.position_m; };
    const auto near_vertex = [&](std::size_t i) { return builder.vertex(near(i), normal_of(at_from, from.points[i])); };
    const auto far_vertex = [&](std::size_t j) { return builder.vertex(far(j), normal_of(at_to, to.points[j])); };
    std::size_t i = a.first, j = b.first;
    std::uint32_t vi = near_vertex(i), vj = far_vertex(j);
    while (i < a.last || j < b.last) {
        const auto diagonal = [](const glm::dvec3& p, const glm::dvec3& q) { return glm::dot(p - q, p - q); };
        const bool step_near = j == b.last || (i < a.last && diagonal(near(i + 1), far(j)) <= diagonal(far(j + 1), near(i)));
        if (step_near) {
            const std::uint32_t next = near_vertex(++i);
            builder.triangle(material, vi, vj, next);
            vi = next;
        } else {
            const std::uint32_t next = far_vertex(++j);
            builder.triangle(material, vi, vj, next);
            vj = next;
        }
    }
}

void append_risers(MeshBuilder& builder, const Row& before, const Row& after) {
    const std::vector<Piece> a = pieces(before), b = pieces(after);
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        if (a[i].right->t_m != b[j].right->t_m) {
            a[i].right->t_m < b[j].right->t_m ? ++i : ++j;
            continue;
        }
        const double right = b[j].right->h_m - a[i].right->h_m, left = b[j].left->h_m - a[i].left->h_m;
        if (std::max(std::abs(right), std::abs(left)) > same_place_m) {
            const glm::dvec3 normal = (right + left > 0.0 ? -1.0 : 1.0) * a[i].right->pose.forward();
            const auto vertex = [&](const RowPoint* p) { return builder.vertex(p->pose.position_m, normal); };
            const std::uint32_t ar = vertex(a[i].right), al = vertex(a[i].left), br = vertex(b[j].right), bl = vertex(b[j].left);
            builder.triangle(index_of(RoadMaterial::kerb), ar, br, bl);
            builder.triangle(index_of(RoadMaterial::kerb), ar, bl, al);
        }
        ++i, ++j;
    }
}

} // namespace fernlicht
