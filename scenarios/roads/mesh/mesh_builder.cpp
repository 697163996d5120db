#include "scenarios/roads/mesh/mesh_builder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>

namespace fernlicht {

namespace {
constexpr double lattice_per_m = 32768.0; // 2^15
}

glm::dvec3 on_lattice(const glm::dvec3& point_m) { return glm::round(point_m * lattice_per_m) / lattice_per_m; }

glm::vec2 texture_position(const glm::dvec3& mesh_origin_m, const Vertex& vertex) {
    const glm::dvec3 p = mesh_origin_m - texture_repeat_m * glm::floor(mesh_origin_m / texture_repeat_m) + glm::dvec3(vertex.position_m);
    const glm::vec3 n = vertex.normal, along = glm::abs(n);
    glm::dvec2 at(p.x, p.y);
    if (along.z < std::max(along.x, along.y))
        at = along.x >= along.y ? glm::dvec2(n.x > 0.0F ? p.y : -p.y, p.z) : glm::dvec2(n.y > 0.0F ? -p.x : p.x, p.z);
    return glm::vec2(at / texture_repeat_m);
}

MeshBuilder::MeshBuilder(std::string name, const glm::dvec3& near_m) {
    mesh_.name = std::move(name);
    mesh_.origin_m = glm::round(near_m);
}

std::size_t MeshBuilder::KeyHash::operator()(const Key& key) const {
    std::size_t hash = 0;
    for (const std::uint32_t word : key.bits)
        hash = (hash ^ word) * 0x9E3779B97F4A7C15ULL;
    return hash ^ (hash >> 32);
}

std::uint32_t MeshBuilder::vertex(const glm::dvec3& position_m, const glm::dvec3& normal) {
    // + 0.0F turns -0 into 0: equal places must have equal bits.
    const glm::vec3 position = glm::vec3(on_lattice(position_m) - mesh_.origin_m) + 0.0F;
    const glm::vec3 n = glm::vec3(glm::normalize(normal)) + 0.0F;
    const Key key{{std::bit_cast<std::uint32_t>(position.x), std::bit_cast<std::uint32_t>(position.y),
                   std::bit_cast<std::uint32_t>(position.z), std::bit_cast<std::uint32_t>(n.x), std::bit_cast<std::uint32_t>(n.y),
                   std::bit_cast<std::uint32_t>(n.z)}};
    const auto [found, is_new] = known_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) {
        Vertex vertex{position, n};
        vertex.uv = texture_position(mesh_.origin_m, vertex);
        mesh_.vertices.push_back(vertex);
    }
    return found->second;
}

void MeshBuilder::triangle(std::uint32_t material, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a == b || b == c || c == a)
        return;
    std::vector<std::uint32_t>& indices = by_material_[material];
    indices.insert(indices.end(), {a, b, c});
    ++triangles_;
}

void MeshBuilder::quad(std::uint32_t material, const std::array<glm::dvec3, 4>& corners) {
    const glm::dvec3 normal = glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
    if (glm::dot(normal, normal) < 1e-16)
        return;
    std::array<std::uint32_t, 4> v{};
    for (std::size_t i = 0; i < 4; ++i)
        v[i] = vertex(corners[i], normal);
    triangle(material, v[0], v[1], v[2]);
    triangle(material, v[0], v[2], v[3]);
}

void MeshBuilder::add_to(Scene& scene) && {
    if (triangles_ == 0)
        return;
    for (const auto& [material, indices] : by_material_) {
        mesh_.batches.push_back({material, static_cast<std::uint32_t>(mesh_.indices.size()), static_cast<std::uint32_t>(indices.size())});
        mesh_.indices.insert(mesh_.indices.end(), indices.begin(), indices.end());
    }
    scene.meshes.push_back(std::move(mesh_));
}

} // namespace fernlicht
