// Collects triangles by material into one Mesh. Positions are put on a lattice, so that meshes about different origins agree
// on their common vertices to the last bit.
#pragma once

#include "scenarios/values/scene.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace fernlicht {

/// The nearest point of a lattice of 2^-15 m (31 micrometres). With origins at whole metres and a mesh that reaches less than
/// 256 m from its origin, position - origin then has at most 23 bits and float holds it exactly: a vertex computed from the same
/// (road, s, t) has the same world position in every mesh, and no crack can open between chunks.
glm::dvec3 on_lattice(const glm::dvec3& point_m);

/// One repetition of every texture on a road scene, in both directions. A power of two, so that whole repetitions can be taken off a
/// mesh's origin exactly.
constexpr double texture_repeat_m = 8.0;

/// Where in a texture a vertex lies; 1 is one repetition. From above on what lies, u east and v north; from the side on what stands (by
/// the normal's greatest component), u to the right as seen from outside and v up. Counted from the world's origin, apart from whole
/// repetitions between it and the mesh's: vertices of two meshes at one place with one normal differ by whole numbers, exactly.
glm::vec2 texture_position(const glm::dvec3& mesh_origin_m, const Vertex& vertex);

class MeshBuilder {
  public:
    /// The origin is `near_m` rounded to whole metres.
    MeshBuilder(std::string name, const glm::dvec3& near_m);

    /// Index of the vertex at this place with this normal; equal ones are shared. It has its place in a texture, used or not.
    std::uint32_t vertex(const glm::dvec3& position_m, const glm::dvec3& normal);
    /// Counter-clockwise seen from the lit side. Triangles that name a vertex twice are left out.
    void triangle(std::uint32_t material, std::uint32_t a, std::uint32_t b, std::uint32_t c);
    /// A flat polygon of four corners, counter-clockwise, with its own normal. Nothing if it has no area.
    void quad(std::uint32_t material, const std::array<glm::dvec3, 4>& corners);

    std::size_t triangles() const { return triangles_; }
    /// One batch a material, in the order of the materials. Does nothing to `scene` when there are no triangles.
    void add_to(Scene& scene) &&;

  private:
    struct Key {
        std::array<std::uint32_t, 6> bits;
        bool operator==(const Key&) const = default;
    };
    struct KeyHash {
        std::size_t operator()(const Key& key) const;
    };

    Mesh mesh_;
    std::size_t triangles_ = 0;
    std::unordered_map<Key, std::uint32_t, KeyHash> known_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_material_;
};

} // namespace fernlicht
