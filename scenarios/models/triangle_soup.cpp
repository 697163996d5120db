#include "scenarios/models/triangle_soup.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <unordered_map>

namespace fernlicht {
namespace {

using Cell = std::array<long, 3>;

Mesh mesh_of(const TriangleSoup& soup, const std::vector<std::size_t>& triangles, const glm::dvec3& origin_m, std::string name) {
    Mesh mesh{std::move(name), origin_m, {}, {}, {}};
    std::map<std::uint32_t, std::vector<std::size_t>> by_material;
    for (const std::size_t t : triangles)
        by_material[soup.triangles[t].material].push_back(t);
    std::unordered_map<std::uint32_t, std::uint32_t> taken;
    for (const auto& [material, members] : by_material) {
        mesh.batches.push_back({material, static_cast<std::uint32_t>(mesh.indices.size()), static_cast<std::uint32_t>(3 * members.size())});
        for (const std::size_t t : members)
            for (const std::uint32_t corner : soup.triangles[t].corners) {
                const auto [it, fresh] = taken.try_emplace(corner, static_cast<std::uint32_t>(mesh.vertices.size()));
                if (fresh) {
                    const SoupVertex& v = soup.vertices[corner];
                    mesh.vertices.push_back({glm::vec3(v.position_m - origin_m), glm::vec3(v.normal), v.uv});
                }
                mesh.indices.push_back(it->second);
            }
    }
    return mesh;
}

} // namespace

std::size_t Model::triangles() const {
    std::size_t count = 0;
    for (const Mesh& mesh : meshes)
        count += mesh.indices.size() / 3;
    return count;
}

void TriangleSoup::add(const std::array<glm::dvec3, 3>& corners, std::uint32_t material) {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = glm::length(normal);
    if (!(length > 0.0))
        return;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const glm::dvec3& corner : corners)
        vertices.push_back({corner, normal / length});
    triangles.push_back({{first, first + 1, first + 2}, material});
}

void add_meshes(Model& model, const TriangleSoup& soup) {
    if (soup.triangles.empty())
        return;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const SoupTriangle& t : soup.triangles)
        for (const std::uint32_t corner : t.corners) {
            low = glm::min(low, soup.vertices[corner].position_m);
            high = glm::max(high, soup.vertices[corner].position_m);
        }
    model.low_m = low;
    model.high_m = high;
    const glm::dvec3 size = high - low, farthest = glm::max(glm::abs(low), glm::abs(high));
    if (std::max({size.x, size.y, size.z}) <= largest_mesh_m) {
        std::vector<std::size_t> all(soup.triangles.size());
        for (std::size_t t = 0; t < all.size(); ++t)
            all[t] = t;
        const bool near = std::max({farthest.x, farthest.y, farthest.z}) <= largest_mesh_m;
        model.meshes.push_back(mesh_of(soup, all, near ? glm::dvec3(0.0) : glm::round(0.5 * (low + high)), model.name));
        return;
    }
    std::map<Cell, std::vector<std::size_t>> cells;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const auto& c = soup.triangles[t].corners;
        const glm::dvec3 middle =
            (soup.vertices[c[0]].position_m + soup.vertices[c[1]].position_m + soup.vertices[c[2]].position_m) / (3.0 * mesh_cell_m);
        cells[{std::lround(std::floor(middle.x)), std::lround(std::floor(middle.y)), std::lround(std::floor(middle.z))}].push_back(t);
    }
    for (const auto& [cell, triangles] : cells) {
        const glm::dvec3 origin = (glm::dvec3(cell[0], cell[1], cell[2]) + 0.5) * mesh_cell_m;
        model.meshes.push_back(mesh_of(soup, triangles, origin, fmt::format("{} {} {} {}", model.name, cell[0], cell[1], cell[2])));
    }
}

} // namespace fernlicht
