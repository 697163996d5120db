#include "renderer/gl/shadows/silhouettes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace fernlicht::gl {
namespace {

glm::vec4 as_it_stands(const glm::vec3& place) { return {place, 1.0F}; }
glm::vec4 at_infinity(const glm::vec3& place) { return {place, 0.0F}; }

} // namespace

Silhouettes::Silhouettes(const std::vector<glm::vec3>& corners) {
    std::map<std::tuple<float, float, float>, std::uint32_t> known_places;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known_edges;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        Triangle t;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& p = corners[i + k];
            const auto [it, fresh] = known_places.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(places_.size()));
            if (fresh)
                places_.push_back(p);
            t.corners[k] = it->second;
        }
        const glm::dvec3 a(corners[i]), b(corners[i + 1]), c(corners[i + 2]);
        t.normal = glm::cross(b - a, c - a);
        t.offset = -glm::dot(t.normal, a);
        if (t.normal == glm::dvec3(0.0))
            continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t.corners[k], to = t.corners[(k + 1) % 3];
            const auto [it, fresh] = known_edges.try_emplace(std::minmax(from, to), static_cast<std::uint32_t>(edges_.size()));
            if (fresh)
                edges_.push_back({std::min(from, to), std::max(from, to)});
            t.edges[k] = it->second;
            t.along[k] = from < to ? 1 : -1;
        }
        triangles_.push_back(t);
    }
    // Bodies: edges joined by triangles.
    std::vector<std::uint32_t> joined(edges_.size());
    std::iota(joined.begin(), joined.end(), 0U);
    const auto root = [&](std::uint32_t i) {
        while (joined[i] != i)
            i = joined[i] = joined[joined[i]];
        return i;
    };
    for (const Triangle& t : triangles_)
        for (const std::size_t k : {1U, 2U})
            joined[root(t.edges[k])] = root(t.edges[0]);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::map<std::uint32_t, std::uint32_t> numbers;
    std::vector<int> uneven(edges_.size(), 0);
    std::vector<std::uint32_t> body_of_edge(edges_.size(), 0);
    for (Triangle& t : triangles_) {
        const auto [it, fresh] = numbers.try_emplace(root(t.edges[0]), static_cast<std::uint32_t>(bodies_.size()));
        if (fresh)
            bodies_.push_back({true, glm::dvec3(infinity), glm::dvec3(-infinity)});
        t.body = it->second;
        for (std::size_t k = 0; k < 3; ++k) {
            uneven[t.edges[k]] += t.along[k];
            body_of_edge[t.edges[k]] = t.body;
            bodies_[t.body].low = glm::min(bodies_[t.body].low, glm::dvec3(places_[t.corners[k]]));
            bodies_[t.body].high = glm::max(bodies_[t.body].high, glm::dvec3(places_[t.corners[k]]));
        }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e)
        bodies_[body_of_edge[e]].closed = bodies_[body_of_edge[e]].closed && uneven[e] == 0;
    // Six times the volume, by tetrahedra from the middle of the box.
    std::vector<double> volumes(bodies_.size(), 0.0);
    for (const Triangle& t : triangles_) {
        const Body& body = bodies_[t.body];
        volumes[t.body] -= glm::dot(t.normal, 0.5 * (body.low + body.high)) + t.offset;
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const glm::dvec3 size = bodies_[i].high - bodies_[i].low;
        bodies_[i].closed = bodies_[i].closed && volumes[i] > -1e-9 * std::pow(glm::length(size), 3.0);
    }
}

std::size_t Silhouettes::closed_bodies() const {
    return static_cast<std::size_t>(std::ranges::count_if(bodies_, [](const Body& body) { return body.closed; }));
}

void Silhouettes::add_hulls(const glm::dvec3& lamp, Casting casting, const std::vector<bool>& casts,
                            std::vector<glm::vec4>& corners) const {
    // Of a closed body round the lamp, light meets backs alone.
    std::vector<bool> fronts_alone(bodies_.size(), false);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& body = bodies_[i];
        const bool within = glm::all(glm::lessThanEqual(body.low, lamp)) && glm::all(glm::lessThanEqual(lamp, body.high));
        fronts_alone[i] = casting == Casting::fewest && body.closed && !within;
    }
    std::vector<int> walls(edges_.size(), 0);
    for (const Triangle& t : triangles_) {
        if (!casts[t.body])
            continue;
        const double side = glm::dot(t.normal, lamp) + t.offset;
        if (side == 0.0 || (side < 0.0 && fronts_alone[t.body]) || (side > 0.0 && casting == Casting::turned_away))
            continue;
        const bool front = side > 0.0;
        const glm::vec3 &a = places_[t.corners[0]], &b = places_[t.corners[front ? 1 : 2]], &c = places_[t.corners[front ? 2 : 1]];
        corners.insert(corners.end(), {as_it_stands(a), as_it_stands(b), as_it_stands(c), at_infinity(c), at_infinity(b), at_infinity(a)});
        for (std::size_t k = 0; k < 3; ++k)
            walls[t.edges[k]] += front ? t.along[k] : -t.along[k];
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const glm::vec3 &a = places_[edges_[e][walls[e] > 0 ? 0 : 1]], &b = places_[edges_[e][walls[e] > 0 ? 1 : 0]];
        for (int k = std::abs(walls[e]); k > 0; --k)
            corners.insert(corners.end(),
                           {as_it_stands(b), as_it_stands(a), at_infinity(a), as_it_stands(b), at_infinity(a), at_infinity(b)});
    }
}

} // namespace fernlicht::gl
