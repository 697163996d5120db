#include "renderer/reference/patches.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht::reference {
namespace {

/// A facet smaller than this holds no light that could be told from rounding, m2.
constexpr double min_area_m2 = 1e-12;
/// A triangle that reaches less far into a cell than this share of it does not meet it: far above the rounding of shares, 1e-13 for a
/// thousand cells in a row.
constexpr double sliver = 1e-9;

Facet facet_of(const EmbreeScene& embree, std::uint32_t mesh_index, std::uint32_t triangle, const Batch& batch, std::uint32_t first) {
    const Mesh& mesh = embree.scene().meshes[mesh_index];
    Facet facet{mesh_index, triangle, batch.material, {}, {}, {}};
    std::array<const Vertex*, 3> v{};
    for (std::size_t k = 0; k < 3; ++k)
        v[k] = &mesh.vertices[mesh.indices[first + k]];
    const auto side = [&](std::size_t k) { // opposite to corner k
        return glm::length(glm::dvec3(v[(k + 1) % 3]->position_m) - glm::dvec3(v[(k + 2) % 3]->position_m));
    };
    std::size_t apex = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (side(k) > side(apex))
            apex = k;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vertex& vertex = *v[(apex + k) % 3];
        facet.corner_m[k] = mesh.origin_m - embree.origin_m() + glm::dvec3(vertex.position_m);
        facet.normal[k] = glm::dvec3(vertex.normal);
        facet.uv[k] = glm::dvec2(vertex.uv);
    }
    const glm::dvec3 across = glm::cross(facet.corner_m[1] - facet.corner_m[0], facet.corner_m[2] - facet.corner_m[0]);
    facet.area_m2 = 0.5 * glm::length(across);
    if (facet.area_m2 > min_area_m2)
        facet.facet_normal = across / (2.0 * facet.area_m2);
    if (glm::dot(facet.facet_normal, facet.normal[0] + facet.normal[1] + facet.normal[2]) < 0.0)
        facet.facet_normal = -facet.facet_normal;
    return facet;
}

bool within(const Facet& facet, const glm::dvec3& centre_m, double reach_m) {
    const glm::dvec3 middle = (facet.corner_m[0] + facet.corner_m[1] + facet.corner_m[2]) / 3.0;
    double radius = 0.0;
    for (const glm::dvec3& corner : facet.corner_m)
        radius = std::max(radius, glm::length(corner - middle));
    return glm::length(middle - centre_m) - radius < reach_m;
}

/// Weights of the three corners at a point of the facet's plane.
glm::dvec3 weights_at(const Facet& facet, const glm::dvec3& point_m) {
    const glm::dvec3 ab = facet.corner_m[1] - facet.corner_m[0], ac = facet.corner_m[2] - facet.corner_m[0],
                     ap = point_m - facet.corner_m[0], n = glm::cross(ab, ac);
    const double nn = glm::dot(n, n), b = glm::dot(glm::cross(ap, ac), n) / nn, c = glm::dot(glm::cross(ab, ap), n) / nn;
    return {1.0 - b - c, b, c};
}

/// The part of a convex polygon where dot(p, axis) >= least.
std::vector<glm::dvec2> clipped(const std::vector<glm::dvec2>& polygon, const glm::dvec2& axis, double least) {
    std::vector<glm::dvec2> out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = glm::dot(a, axis) - least, db = glm::dot(b, axis) - least;
        if (da >= 0.0)
            out.push_back(a);
        if ((da >= 0.0) != (db >= 0.0))
            out.push_back(a + (b - a) * (da / (da - db)));
    }
    return out;
}

double area_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

/// Drawn evenly from a convex polygon of at least one point.
glm::dvec2 anywhere_in(const std::vector<glm::dvec2>& polygon, const glm::dvec2& square) {
    double all = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        all += area_of(polygon[0], polygon[i - 1], polygon[i]);
    double drawn = square.x * all;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const double area = area_of(polygon[0], polygon[i - 1], polygon[i]);
        if (drawn < area || i + 1 == polygon.size()) {
            const double root = std::sqrt(area > 0.0 ? std::min(1.0, drawn / area) : 0.0);
            return polygon[0] * (1.0 - root) + polygon[i - 1] * (root * (1.0 - square.y)) + polygon[i] * (root * square.y);
        }
        drawn -= area;
    }
    return polygon.front();
}

} // namespace

SurfaceHit Facet::at(const glm::dvec3& w) const {
    SurfaceHit hit;
    hit.mesh = mesh, hit.triangle = triangle, hit.material = material;
    hit.point_m = corner_m[0] * w.x + corner_m[1] * w.y + corner_m[2] * w.z;
    hit.normal = glm::normalize(normal[0] * w.x + normal[1] * w.y + normal[2] * w.z);
    hit.facet_normal = facet_normal;
    hit.uv = uv[0] * w.x + uv[1] * w.y + uv[2] * w.z;
    return hit;
}

SurfaceHit Facet::anywhere(const glm::dvec2& square) const {
    const double root = std::sqrt(square.x);
    return at({1.0 - root, root * (1.0 - square.y), root * square.y});
}

std::vector<Facet> facets_within(const EmbreeScene& embree, const glm::dvec3& centre_m, double reach_m) {
    std::vector<Facet> facets;
    for (std::uint32_t m = 0; m < embree.scene().meshes.size(); ++m) {
        std::uint32_t triangle = 0;
        for (const Batch& batch : embree.scene().meshes[m].batches)
            for (std::uint32_t i = 0; i + 2 < batch.count; i += 3, ++triangle) {
                const Facet facet = facet_of(embree, m, triangle, batch, batch.first + i);
                if (facet.area_m2 > min_area_m2 && within(facet, centre_m, reach_m))
                    facets.push_back(facet);
            }
    }
    return facets;
}

Patches::Columns Patches::Cut::in_row(std::uint32_t row) const {
    const double t = static_cast<double>(row) / rows, low = apex * t * columns, high = (1.0 - (1.0 - apex) * t) * columns;
    const std::uint32_t begin = std::min(columns - 1, static_cast<std::uint32_t>(low + sliver)),
                        end = std::clamp(static_cast<std::uint32_t>(std::ceil(high - sliver)), begin + 1, columns);
    return {begin, end - begin};
}

Patches::Patches(const EmbreeScene& embree, std::vector<Facet> facets, double patch_m, std::size_t most) : facets_(std::move(facets)) {
    facet_of_.resize(embree.scene().meshes.size());
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
        const Facet& facet = facets_[f];
        const double base = glm::length(facet.corner_m[2] - facet.corner_m[1]), height = 2.0 * facet.area_m2 / base;
        if (base / patch_m > static_cast<double>(most))
            throw InputError({{}, 0, 0, "--patch"}, fmt::format("{} m would cut a side of {:.0f} m", patch_m, base),
                             fmt::format("a size that makes at most {} patches", most));
        const auto parts = [&](double length_m) { return std::max(1U, static_cast<std::uint32_t>(std::ceil(length_m / patch_m))); };
        const glm::dvec3 along = (facet.corner_m[2] - facet.corner_m[1]) / (base * base);
        cuts_.push_back({static_cast<std::uint32_t>(places_.size()), parts(height), parts(base),
                         std::clamp(glm::dot(facet.corner_m[0] - facet.corner_m[1], along), 0.0, 1.0)});
        for (std::uint32_t row = 0; row < cuts_.back().rows; ++row) {
            const Columns columns = cuts_.back().in_row(row);
            if (places_.size() + columns.count > most)
                throw InputError({{}, 0, 0, "--patch"}, fmt::format("{} m makes more than {} patches", patch_m, most),
                                 "a larger patch or a shorter reach");
            for (std::uint32_t k = 0; k < columns.count; ++k)
                places_.push_back({f, row, columns.first + k});
        }
        std::vector<std::uint32_t>& of_mesh = facet_of_[facet.mesh];
        if (of_mesh.size() <= facet.triangle)
            of_mesh.resize(facet.triangle + 1, none);
        of_mesh[facet.triangle] = f;
    }
}

std::uint32_t Patches::at(const SurfaceHit& hit) const {
    const std::vector<std::uint32_t>& of_mesh = facet_of_[hit.mesh];
    if (hit.triangle >= of_mesh.size() || of_mesh[hit.triangle] == none)
        return none;
    const std::uint32_t f = of_mesh[hit.triangle];
    const Cut& cut = cuts_[f];
    const glm::dvec3 w = weights_at(facets_[f], hit.point_m);
    const auto part = [](double share, std::uint32_t count, std::uint32_t first,
                         std::uint32_t last) { // rounding may put a place just outside
        return static_cast<std::uint32_t>(std::clamp(std::floor(share * count), static_cast<double>(first), static_cast<double>(last)));
    };
    const std::uint32_t row = part(w.x, cut.rows, 0, cut.rows - 1);
    std::uint32_t patch = cut.first;
    for (std::uint32_t r = 0; r < row; ++r)
        patch += cut.in_row(r).count;
    const Columns columns = cut.in_row(row);
    return patch + part(w.x * cut.apex + w.z, cut.columns, columns.first, columns.first + columns.count - 1) - columns.first;
}

SurfaceHit Patches::place(std::uint32_t patch, const glm::dvec2& square) const {
    const Place& place = places_[patch];
    const Cut& cut = cuts_[place.facet];
    std::vector<glm::dvec2> cell{{0.0, 0.0}, {1.0, 0.0}, {cut.apex, 1.0}}; // x, t
    for (const auto& [axis, least] : {std::pair(glm::dvec2(1.0, 0.0), static_cast<double>(place.column) / cut.columns),
                                      std::pair(glm::dvec2(-1.0, 0.0), -(place.column + 1.0) / cut.columns),
                                      std::pair(glm::dvec2(0.0, 1.0), static_cast<double>(place.row) / cut.rows),
                                      std::pair(glm::dvec2(0.0, -1.0), -(place.row + 1.0) / cut.rows)})
        if (std::vector<glm::dvec2> inside = clipped(cell, axis, least); !inside.empty()) // a point may be lost to rounding
            cell = std::move(inside);
    const glm::dvec2 p = anywhere_in(cell, square);
    return facets_[place.facet].at({p.y, 1.0 - p.x - p.y * (1.0 - cut.apex), p.x - p.y * cut.apex});
}

} // namespace fernlicht::reference
