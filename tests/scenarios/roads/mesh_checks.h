// What a road's triangles must be, counted on the triangles themselves.
#pragma once

#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace fernlicht::mesh_checks {

/// A vertex's place in the world in units of the lattice: equal for equal places, whatever the mesh.
using Place = std::array<std::int64_t, 3>;

struct PlaceHash {
    std::size_t operator()(const Place& p) const {
        std::size_t h = 0;
        for (const std::int64_t v : p)
            h = (h ^ static_cast<std::size_t>(v)) * 0x9E3779B97F4A7C15ULL;
        return h ^ (h >> 29);
    }
};

struct Triangle {
    std::array<glm::dvec3, 3> corners;
    std::array<glm::dvec3, 3> normals;
    std::uint32_t material = 0;
    glm::dvec3 cross() const { return glm::cross(corners[1] - corners[0], corners[2] - corners[0]); }
    double area() const { return 0.5 * glm::length(cross()); }
};

/// Triangles of each mesh whose name begins with `prefix`.
inline std::vector<Triangle> triangles(const Scene& scene, const std::string& prefix) {
    std::vector<Triangle> all;
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.name.rfind(prefix, 0) != 0)
            continue;
        for (const Batch& batch : mesh.batches)
            for (std::uint32_t i = batch.first; i + 2 < batch.first + batch.count; i += 3) {
                Triangle triangle;
                triangle.material = batch.material;
                for (std::size_t k = 0; k < 3; ++k) {
                    const Vertex& vertex = mesh.vertices.at(mesh.indices.at(i + k));
                    triangle.corners[k] = mesh.origin_m + glm::dvec3(vertex.position_m);
                    triangle.normals[k] = glm::dvec3(vertex.normal);
                }
                all.push_back(triangle);
            }
    }
    return all;
}

inline Place place(const glm::dvec3& p) { return {std::llround(p.x * 32768.0), std::llround(p.y * 32768.0), std::llround(p.z * 32768.0)}; }

/// A surface without holes, cracks and T-junctions: no edge belongs to more than two triangles, and Euler's V - E + F is 1 for each
/// connected part, as it is for a disc. Every crack, however narrow, takes 1 from that sum.
struct Topology {
    std::size_t triangles = 0, parts = 0;
    std::int64_t euler = 0;
    std::size_t crowded_edges = 0; ///< of more than two triangles
    std::vector<std::array<glm::dvec3, 2>> free_edges;

    bool sound() const { return crowded_edges == 0 && euler == static_cast<std::int64_t>(parts); }
};

inline Topology topology(const std::vector<Triangle>& triangles) {
    std::unordered_map<Place, std::uint32_t, PlaceHash> ids;
    std::vector<glm::dvec3> at;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    std::vector<std::uint32_t> parent;
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    };
    Topology result{.triangles = triangles.size()};
    for (const Triangle& triangle : triangles) {
        std::array<std::uint32_t, 3> v{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [found, is_new] = ids.try_emplace(place(triangle.corners[k]), static_cast<std::uint32_t>(ids.size()));
            if (is_new) {
                parent.push_back(found->second);
                at.push_back(triangle.corners[k]);
            }
            v[k] = found->second;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            ++edges[std::minmax(v[k], v[(k + 1) % 3])];
            parent[root(v[k])] = root(v[(k + 1) % 3]);
        }
    }
    for (std::uint32_t i = 0; i < parent.size(); ++i)
        result.parts += root(i) == i ? 1U : 0U;
    for (const auto& [edge, count] : edges) {
        result.crowded_edges += count > 2 ? 1U : 0U;
        if (count == 1)
            result.free_edges.push_back({at[edge.first], at[edge.second]});
    }
    result.euler =
        static_cast<std::int64_t>(at.size()) - static_cast<std::int64_t>(edges.size()) + static_cast<std::int64_t>(triangles.size());
    return result;
}

} // namespace fernlicht::mesh_checks
