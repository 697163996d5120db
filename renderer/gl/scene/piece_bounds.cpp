#include "renderer/gl/scene/piece_bounds.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace fernlicht::gl {
namespace {

/// The root of `i` in a forest of parents, with the path halved on the way.
std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

} // namespace

Corners box_round(const std::vector<glm::dvec3>& triangles) {
    // Strips of road have long edges along the road: the longest edge is tried beside the world's axes, the smallest floor wins.
    glm::dvec2 longest(1.0, 0.0);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        if (next < triangles.size())
            if (const glm::dvec2 edge(triangles[next] - triangles[i]); glm::length(edge) > glm::length(longest))
                longest = edge;
    }
    Box best;
    glm::dvec2 best_along(1.0, 0.0);
    double smallest = std::numeric_limits<double>::infinity();
    for (const glm::dvec2& along : {glm::dvec2(1.0, 0.0), glm::normalize(longest)}) {
        Box box; // in the turned frame
        for (const glm::dvec3& p : triangles)
            box.add({p.x * along.x + p.y * along.y, -p.x * along.y + p.y * along.x, p.z});
        if (const double floor = (box.high.x - box.low.x) * (box.high.y - box.low.y); floor < smallest) {
            smallest = floor;
            best = box;
            best_along = along;
        }
    }
    Corners corners{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double x = (i & 1U) != 0 ? best.high.x : best.low.x, y = (i & 2U) != 0 ? best.high.y : best.low.y;
        corners[i] = {x * best_along.x - y * best_along.y, x * best_along.y + y * best_along.x, (i & 4U) != 0 ? best.high.z : best.low.z};
    }
    return corners;
}

std::vector<Corners> boxes_round_bodies(const std::vector<glm::dvec3>& triangles) {
    std::vector<std::size_t> parent(triangles.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    std::map<std::tuple<double, double, double>, std::size_t> places;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::size_t first = places.try_emplace({triangles[i].x, triangles[i].y, triangles[i].z}, i).first->second;
        parent[root_of(parent, i)] = root_of(parent, first);
        parent[root_of(parent, i)] = root_of(parent, i - i % 3);
    }
    std::map<std::size_t, std::vector<glm::dvec3>> bodies;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        bodies[root_of(parent, i)].push_back(triangles[i]);
    std::vector<Corners> boxes;
    for (const auto& [root, body] : bodies)
        boxes.push_back(box_round(body));
    return boxes;
}

} // namespace fernlicht::gl
