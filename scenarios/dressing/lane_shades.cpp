#include "scenarios/dressing/dressing.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace fernlicht {
namespace {

constexpr double route_every_m = 8.0, ahead_every_m = 10.0, farthest_ahead_m = 150.0; ///< of the route, and of the lane before the car
constexpr glm::dvec3 low_beam_m(3.6, 0.6, 0.65);                                      ///< of a car on the route, on both sides
constexpr double lane_beside_m = 1.5;                                                 ///< of the lane's centre

struct Segment {
    glm::dvec3 from_m, way_m;
};

/// By slabs.
bool meets_box(const Segment& s, const glm::dvec3& low, const glm::dvec3& high) {
    double first = 0.0, last = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (s.way_m[axis] == 0.0) {
            if (s.from_m[axis] < low[axis] || s.from_m[axis] > high[axis])
                return false;
            continue;
        }
        const double a = (low[axis] - s.from_m[axis]) / s.way_m[axis], b = (high[axis] - s.from_m[axis]) / s.way_m[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last;
}

/// Möller and Trumbore 1997.
bool meets_triangle(const Segment& s, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(s.way_m, ac);
    const double det = glm::dot(ab, p);
    if (det == 0.0)
        return false;
    const glm::dvec3 t = s.from_m - a, q = glm::cross(t, ab);
    const double u = glm::dot(t, p) / det, v = glm::dot(s.way_m, q) / det, along = glm::dot(ac, q) / det;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && along > 0.0 && along < 0.999;
}

bool meets_mesh(const Segment& s, const Mesh& mesh) {
    const auto at = [&](std::size_t i) { return glm::dvec3(mesh.vertices[mesh.indices[i]].position_m); };
    const Segment local{s.from_m - mesh.origin_m, s.way_m};
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        if (meets_triangle(local, at(i), at(i + 1), at(i + 2)))
            return true;
    return false;
}

/// Segments by the cells that they cross in plan.
class SegmentCells {
  public:
    explicit SegmentCells(const std::vector<Segment>& segments) {
        for (const Segment& s : segments) {
            const int pieces = 1 + static_cast<int>(std::hypot(s.way_m.x, s.way_m.y) / cell_m);
            for (int i = 0; i < pieces; ++i) {
                const glm::dvec3 a = s.from_m + s.way_m * (static_cast<double>(i) / pieces),
                                 b = s.from_m + s.way_m * (static_cast<double>(i + 1) / pieces);
                any_cell(glm::min(a, b), glm::max(a, b), [&](const Cell& cell) {
                    std::vector<const Segment*>& there = cells_[cell];
                    if (there.empty() || there.back() != &s)
                        there.push_back(&s);
                    return false;
                });
            }
        }
    }
    /// Whether `meets` holds of any segment in the cells of a box; it may be asked twice of one.
    template <class Meets> bool any_near(const glm::dvec3& low, const glm::dvec3& high, const Meets& meets) const {
        return any_cell(low, high, [&](const Cell& cell) {
            const auto there = cells_.find(cell);
            return there != cells_.end() && std::ranges::any_of(there->second, [&](const Segment* s) { return meets(*s); });
        });
    }

  private:
    using Cell = std::pair<long, long>;
    static constexpr double cell_m = 16.0, margin_m = 0.001; ///< the margin for rounding
    template <class Take> static bool any_cell(const glm::dvec3& low, const glm::dvec3& high, const Take& take) {
        const auto cell_at = [](double at_m) { return std::lround(std::floor(at_m / cell_m)); };
        for (long x = cell_at(low.x - margin_m); x <= cell_at(high.x + margin_m); ++x)
            for (long y = cell_at(low.y - margin_m); y <= cell_at(high.y + margin_m); ++y)
                if (take(Cell(x, y)))
                    return true;
        return false;
    }
    std::map<Cell, std::vector<const Segment*>> cells_;
};

} // namespace

std::vector<std::string> shades_of_lane(const Scene& scene, const Route& route, std::size_t first) {
    std::vector<Segment> segments;
    for (double at = 0.0; at < route.length_m(); at += route_every_m) {
        const Pose car = route.pose(at);
        for (double ahead = 10.0; ahead <= farthest_ahead_m && at + ahead < route.length_m(); ahead += ahead_every_m)
            for (const double left : {-lane_beside_m, 0.0, lane_beside_m})
                for (const double side : {-1.0, 1.0}) {
                    const glm::dvec3 from = to_parent(car, {low_beam_m.x, side * low_beam_m.y, low_beam_m.z});
                    segments.push_back({from, route.pose(at + ahead, left).position_m - from});
                }
    }
    const SegmentCells near(segments);
    std::vector<std::string> names;
    for (std::size_t i = first; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        if (!mesh.casts || mesh.body >= 0 || mesh.vertices.empty() || std::ranges::find(names, mesh.name) != names.end())
            continue;
        glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
        for (const Vertex& v : mesh.vertices) {
            low = glm::min(low, mesh.origin_m + glm::dvec3(v.position_m));
            high = glm::max(high, mesh.origin_m + glm::dvec3(v.position_m));
        }
        if (near.any_near(low, high, [&](const Segment& s) { return meets_box(s, low, high) && meets_mesh(s, mesh); }))
            names.push_back(mesh.name);
    }
    return names;
}

} // namespace fernlicht
