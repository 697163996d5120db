#include "scenarios/models/triangle_soup.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>

namespace fernlicht {
namespace {

constexpr double largest_mesh_m = 128.0, mesh_cell_m = 64.0;

constexpr double open_from_share = 0.85;

using Key = std::array<long, 3>;
Key key_of(const glm::dvec3& v, double step) { return {std::lround(v.x / step), std::lround(v.y / step), std::lround(v.z / step)}; }

void append_quad(TriangleSoup& soup, const std::array<glm::dvec3, 4>& q, std::uint32_t material) {
    soup.add({q[0], q[1], q[2]}, material);
    soup.add({q[0], q[2], q[3]}, material);
}

void append_cap(TriangleSoup& soup, const Outline& outline, bool turned, std::uint32_t material) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& p : outline)
        middle += p / static_cast<double>(outline.size());
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const glm::dvec3 &a = outline[k], &b = outline[(k + 1) % outline.size()];
        soup.add(turned ? std::array{middle, b, a} : std::array{middle, a, b}, material);
    }
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
        std::iota(all.begin(), all.end(), std::size_t{0});
        const bool near = std::max({farthest.x, farthest.y, farthest.z}) <= largest_mesh_m;
        model.meshes.push_back(mesh_of(soup, all, near ? glm::dvec3(0.0) : glm::round(0.5 * (low + high)), model.name));
        return;
    }
    std::map<Key, std::vector<std::size_t>> cells;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const auto& c = soup.triangles[t].corners;
        const glm::dvec3 middle =
            (soup.vertices[c[0]].position_m + soup.vertices[c[1]].position_m + soup.vertices[c[2]].position_m) / (3.0 * mesh_cell_m);
        cells[key_of(glm::floor(middle), 1.0)].push_back(t);
    }
    for (const auto& [cell, triangles] : cells) {
        const glm::dvec3 origin = (glm::dvec3(cell[0], cell[1], cell[2]) + 0.5) * mesh_cell_m;
        model.meshes.push_back(mesh_of(soup, triangles, origin, fmt::format("{} {} {} {}", model.name, cell[0], cell[1], cell[2])));
    }
}

void append_loft(TriangleSoup& soup, const std::vector<Outline>& stations, std::uint32_t caps,
                 const std::function<std::uint32_t(std::size_t, std::size_t)>& material) {
    for (std::size_t i = 0; i + 1 < stations.size(); ++i)
        for (std::size_t k = 0; k < stations[i].size(); ++k) {
            const std::size_t next = (k + 1) % stations[i].size();
            append_quad(soup, {stations[i][k], stations[i + 1][k], stations[i + 1][next], stations[i][next]}, material(i, k));
        }
    append_cap(soup, stations.front(), false, caps);
    append_cap(soup, stations.back(), true, caps);
}

void append_box(TriangleSoup& soup, const glm::dvec3& a, const glm::dvec3& b, std::uint32_t material) {
    const auto at = [&](int x, int y, int z) { return glm::dvec3(x ? b.x : a.x, y ? b.y : a.y, z ? b.z : a.z); };
    append_quad(soup, {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}, material);
    append_quad(soup, {at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1)}, material);
    append_quad(soup, {at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1)}, material);
    append_quad(soup, {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}, material);
    append_quad(soup, {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}, material);
    append_quad(soup, {at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), at(0, 0, 0)}, material);
}

void append_wheel(TriangleSoup& soup, const glm::dvec3& c, double radius_m, double width_m, double rim_share, int sides, std::uint32_t tyre,
                  std::uint32_t rim) {
    const auto at = [&](int side, double radius, double y) {
        const double angle = 2.0 * pi * side / sides;
        return c + glm::dvec3(radius * std::cos(angle), y, radius * std::sin(angle));
    };
    const double half = 0.5 * width_m, inner = rim_share * radius_m;
    for (int s = 0; s < sides; ++s) {
        append_quad(soup, {at(s, radius_m, half), at(s + 1, radius_m, half), at(s + 1, radius_m, -half), at(s, radius_m, -half)}, tyre);
        append_quad(soup, {at(s, inner, half), at(s + 1, inner, half), at(s + 1, radius_m, half), at(s, radius_m, half)}, tyre);
        append_quad(soup, {at(s + 1, inner, -half), at(s, inner, -half), at(s, radius_m, -half), at(s + 1, radius_m, -half)}, tyre);
        if (rim_share > open_from_share) { // spokes too thin to be seen: a ring
            append_quad(soup, {at(s + 1, inner, half), at(s, inner, half), at(s, inner, -half), at(s + 1, inner, -half)}, rim);
            continue;
        }
        soup.add({c + glm::dvec3(0.0, 0.8 * half, 0.0), at(s + 1, inner, half), at(s, inner, half)}, rim);
        soup.add({c - glm::dvec3(0.0, 0.8 * half, 0.0), at(s, inner, -half), at(s + 1, inner, -half)}, rim);
    }
}

void append_limb(TriangleSoup& soup, const glm::dvec3& from, const glm::dvec3& to, double from_radius_m, double to_radius_m, int sides,
                 std::uint32_t material) {
    const glm::dvec3 way = to - from, along = glm::normalize(way);
    const glm::dvec3 across = glm::normalize(glm::cross(along, std::abs(along.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 third = glm::cross(along, across);
    std::vector<Outline> rings;
    const auto ring = [&](const glm::dvec3& centre, double radius) {
        Outline outline;
        for (int s = 0; s < sides; ++s) {
            const double angle = 2.0 * pi * s / sides;
            outline.push_back(centre + radius * (std::cos(angle) * across + std::sin(angle) * third));
        }
        rings.push_back(std::move(outline));
    };
    for (const double turn : {1.3, 0.7}) // round ends: rings at these angles before each
        ring(from - from_radius_m * std::sin(turn) * along, from_radius_m * std::cos(turn));
    ring(from, from_radius_m);
    ring(to, to_radius_m);
    for (const double turn : {0.7, 1.3})
        ring(to + to_radius_m * std::sin(turn) * along, to_radius_m * std::cos(turn));
    // Rings turn clockwise seen against the way, which is counter-clockwise along it.
    for (Outline& outline : rings)
        std::ranges::reverse(outline);
    append_loft(soup, rings, material, [&](std::size_t, std::size_t) { return material; });
}

void append_plate(TriangleSoup& soup, const glm::dvec3& c, double width_m, double height_m, bool faces_forward, std::uint32_t material) {
    const double y = 0.5 * width_m * (faces_forward ? 1.0 : -1.0), z = 0.5 * height_m;
    append_quad(soup, {c + glm::dvec3(0, -y, -z), c + glm::dvec3(0, y, -z), c + glm::dvec3(0, y, z), c + glm::dvec3(0, -y, z)}, material);
}

void smooth(TriangleSoup& soup, double crease_rad) {
    const double least = std::cos(crease_rad);
    std::vector<glm::dvec3> faces; // normals as long as twice the area
    std::map<Key, std::vector<std::size_t>> meeting;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const auto& c = soup.triangles[t].corners;
        const glm::dvec3 &a = soup.vertices[c[0]].position_m, &b = soup.vertices[c[1]].position_m, &d = soup.vertices[c[2]].position_m;
        faces.push_back(glm::cross(b - a, d - a));
        for (const std::uint32_t corner : c)
            meeting[key_of(soup.vertices[corner].position_m, 1e-5)].push_back(t);
    }
    TriangleSoup out;
    std::map<std::pair<Key, Key>, std::uint32_t> known;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        SoupTriangle triangle = soup.triangles[t];
        for (std::uint32_t& corner : triangle.corners) {
            const glm::dvec3 position = soup.vertices[corner].position_m;
            glm::dvec3 sum(0.0);
            for (const std::size_t other : meeting[key_of(position, 1e-5)])
                if (glm::dot(faces[t], faces[other]) >= least * glm::length(faces[t]) * glm::length(faces[other]))
                    sum += faces[other];
            const glm::dvec3 normal = glm::normalize(sum);
            const auto [it, fresh] =
                known.try_emplace({key_of(position, 1e-5), key_of(normal, 1e-4)}, static_cast<std::uint32_t>(out.vertices.size()));
            if (fresh)
                out.vertices.push_back({position, normal});
            corner = it->second;
        }
        out.triangles.push_back(triangle);
    }
    soup = std::move(out);
}

} // namespace fernlicht
