// Triangles gathered one by one, then cut into the meshes of a model.
#pragma once

#include "scenarios/models/model.h"

#include <array>

namespace fernlicht {

/// Vertices in the model's frame, in double precision until the meshes' origins are known.
struct SoupVertex {
    glm::dvec3 position_m, normal;
    glm::vec2 uv{0.0F};
};

struct SoupTriangle {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t material = 0;
};

struct TriangleSoup {
    std::vector<SoupVertex> vertices;
    std::vector<SoupTriangle> triangles;

    /// A triangle of three vertices of its own, with its own normal. Nothing where it has no area.
    void add(const std::array<glm::dvec3, 3>& corners, std::uint32_t material);
};

inline constexpr double largest_mesh_m = 128.0, mesh_cell_m = 64.0;

/// Adds the soup to the model: as one mesh, or as one a cell where it is larger than largest_mesh_m. Sets the model's box.
void add_meshes(Model& model, const TriangleSoup& soup);

} // namespace fernlicht
