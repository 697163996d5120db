// Triangles gathered one by one, then cut into the meshes of a model.
// Simple closed shapes of which the bodies of road users are put together.
#pragma once

#include "scenarios/models/model.h"

#include <array>
#include <functional>

namespace fernlicht {

/// Vertices in the model's frame, in double precision until the meshes' origins are known.
struct SoupVertex {
    glm::dvec3 position_m, normal;
    glm::vec2 uv{0.0F};
};

struct SoupTriangle {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t material = 0;
    glm::vec3 tint{1.0F}; ///< the material's albedo is multiplied by it (colour_faces)
};

struct TriangleSoup {
    std::vector<SoupVertex> vertices;
    std::vector<SoupTriangle> triangles;

    /// A triangle of three vertices of its own, with its own normal. Nothing where it has no area.
    void add(const std::array<glm::dvec3, 3>& corners, std::uint32_t material);
};

/// These triangles (positions in `soup.triangles`) as a mesh about an origin: one batch a material, ascending.
Mesh mesh_of(const TriangleSoup& soup, const std::vector<std::size_t>& triangles, const glm::dvec3& origin_m, std::string name);

/// Adds the soup to the model: as one mesh, or as one a cell of 64 m where it is larger than 128 m. Sets the model's box.
void add_meshes(Model& model, const TriangleSoup& soup);

/// Gives triangles whose tint is not white materials of their own, in 64 colours a material at most; the mean over a material's area is
/// kept.
void colour_faces(TriangleSoup& soup, std::vector<Material>& materials);

/// A closed outline of points, the same number at every station of a loft.
using Outline = std::vector<glm::dvec3>;

/// Skins the space between outlines that follow one another, with caps on both ends (fans about the middle). Outlines turn
/// counter-clockwise seen along the way from the first to the last. `material(station, strip)` names what lies between stations i and
/// i + 1 and between points k and k + 1; `caps` what closes the ends.
void append_loft(TriangleSoup& soup, const std::vector<Outline>& stations, std::uint32_t caps,
                 const std::function<std::uint32_t(std::size_t, std::size_t)>& material);

/// Faces of a box between two corners.
void append_box(TriangleSoup& soup, const glm::dvec3& low_m, const glm::dvec3& high_m, std::uint32_t material);

/// A cylinder along y with tread and, at a part of its radius, another material on both sides: a wheel; a ring where the
/// rim has more than 0.85 of the radius. `sides` >= 3.
void append_wheel(TriangleSoup& soup, const glm::dvec3& centre_m, double radius_m, double width_m, double rim_share, int sides,
                  std::uint32_t tyre, std::uint32_t rim);

/// A body of rotation about a segment, with elliptic ends: limbs, heads, tubes. Radii >= 0 at its two ends.
void append_limb(TriangleSoup& soup, const glm::dvec3& from_m, const glm::dvec3& to_m, double from_radius_m, double to_radius_m, int sides,
                 std::uint32_t material);

/// A flat rectangle about a centre that faces +x or -x.
void append_plate(TriangleSoup& soup, const glm::dvec3& centre_m, double width_m, double height_m, bool faces_forward,
                  std::uint32_t material);

/// Gives corners the mean normal of the triangles that meet there at less than `crease_rad`, and merges vertices that are equal then.
void smooth(TriangleSoup& soup, double crease_rad);

} // namespace fernlicht
