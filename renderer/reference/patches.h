// The surfaces near the car in pieces: triangles under a grid of cells along their longest side.
//
// With x the place along the longest side b, as a share of it, and t the distance from it as a share of the triangle's height h, cells are
// 1 / ceil(b / patch) wide and 1 / ceil(h / patch) high, clipped by the triangle. So no cell is wider or higher than a patch should be,
// thin triangles make short cells and not long slivers, and a triangle smaller than a patch stays whole.
#pragma once

#include "renderer/reference/embree_scene.h"

#include <vector>

namespace fernlicht::reference {

/// A triangle of the scene, relative to the geometry's origin.
struct Facet {
    std::uint32_t mesh = 0, triangle = 0, material = 0;
    std::array<glm::dvec3, 3> corner_m; ///< the first opposite to the longest side
    std::array<glm::dvec3, 3> normal;   ///< of the vertices
    std::array<glm::dvec2, 3> uv;
    glm::dvec3 facet_normal{0.0, 0.0, 1.0}; ///< unit, on the lit side
    double area_m2 = 0.0;

    /// As a ray would find it, at weights of the three corners that add up to 1.
    SurfaceHit at(const glm::dvec3& weights) const;
    /// A place drawn evenly from the area.
    SurfaceHit anywhere(const glm::dvec2& square) const;
};

/// Those with any part within `reach_m` of `centre_m`, by their bounding spheres; without area left out. In the scene's order.
std::vector<Facet> facets_within(const EmbreeScene& embree, const glm::dvec3& centre_m, double reach_m);

/// Number of pieces of each facet, where each begins, and what lies where.
class Patches {
  public:
    /// patch_m > 0. Throws InputError for more than `most` patches.
    Patches(const EmbreeScene& embree, std::vector<Facet> facets, double patch_m, std::size_t most);

    static constexpr std::uint32_t none = 0xFFFFFFFF;
    std::size_t size() const { return places_.size(); }
    /// The patch that holds a place, or none.
    std::uint32_t at(const SurfaceHit& hit) const;
    /// A place drawn evenly from a patch's area.
    SurfaceHit place(std::uint32_t patch, const glm::dvec2& square) const;
    std::uint32_t material(std::uint32_t patch) const { return facets_[places_[patch].facet].material; }

  private:
    struct Columns {
        std::uint32_t first, count;
    };
    struct Cut {
        std::uint32_t first = 0; ///< patch
        std::uint32_t rows = 1, columns = 1;
        double apex = 0.0;                       ///< where along the longest side the third corner stands, 0..1
        Columns in_row(std::uint32_t row) const; ///< those that the triangle meets
    };
    struct Place {
        std::uint32_t facet, row, column;
    };
    std::vector<Facet> facets_;
    std::vector<Cut> cuts_;                            ///< of each facet
    std::vector<Place> places_;                        ///< of each patch
    std::vector<std::vector<std::uint32_t>> facet_of_; ///< by mesh and triangle; a mesh out of reach has none
};

} // namespace fernlicht::reference
