// A scene for rays: Embree finds the triangle in single precision, the hit is then computed in double on that triangle.
//
// Positions are relative to `origin_m`, which lies near the camera, so that a float holds them to some 1e-5 m however far from the
// map's origin the drive is. Directions need not be of unit length. Distances are in metres where the direction is of unit length.
// Everything is const after construction and may be used by many threads at once. The scene must outlive this.
#pragma once

#include "scenarios/drives/play/camera.h"
#include "scenarios/values/scene.h"

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht::reference {

/// Rays that travel together, those of one pixel or of neighbours: what Embree takes at a time.
inline constexpr std::size_t packet_size = 16;
using LaneMask = std::uint32_t; ///< bit i: lane i takes part
inline constexpr bool in_mask(LaneMask mask, std::size_t lane) { return (mask >> lane & 1U) != 0; }

/// The lanes of a mask, ascending.
struct LanesOf {
    LaneMask left;
    std::size_t operator*() const { return static_cast<std::size_t>(std::countr_zero(left)); }
    void operator++() { left &= left - 1; }
    bool operator!=(const LanesOf& other) const { return left != other.left; }
    LanesOf begin() const { return *this; }
    LanesOf end() const { return {0}; }
};
inline LanesOf lanes_of(LaneMask mask) { return {mask}; }

/// Where a ray met a triangle. All in double, by the equations of Twin::cast.
struct SurfaceHit {
    double distance_m = 0.0; ///< along the ray, in lengths of its direction
    std::uint32_t mesh = 0, material = 0;
    std::uint32_t triangle = 0;             ///< of the mesh, counted over its batches
    glm::dvec3 point_m{0.0};                ///< relative to origin_m
    glm::dvec3 normal{0.0, 0.0, 1.0};       ///< unit, interpolated between the vertices; on the lit side
    glm::dvec3 facet_normal{0.0, 0.0, 1.0}; ///< unit, of the flat triangle, on the same side
    glm::dvec2 uv{0.0};
    bool from_behind = false; ///< the ray came from the side that is not lit
};

/// "3.13.5", of the library that is loaded.
std::string embree_version();

class EmbreeScene {
  public:
    /// Throws DeviceError when Embree cannot start or runs out of memory.
    EmbreeScene(const Scene& scene, const glm::dvec3& origin_m);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    const Scene& scene() const { return scene_; }
    const glm::dvec3& origin_m() const { return origin_m_; }

    /// The nearest triangle, both sides. `ground_only`: meshes all of whose materials are ground, which is what maps show.
    std::optional<SurfaceHit> cast(const Ray& ray, bool ground_only = false) const;
    /// The same for the lanes of `lanes`; returns those that hit something.
    LaneMask cast(const std::array<Ray, packet_size>& rays, LaneMask lanes, bool ground_only,
                  std::array<SurfaceHit, packet_size>& hits) const;

    /// Whether nothing stands between a surface and a point on its lit side. A point behind the flat triangle is not seen.
    bool visible(const SurfaceHit& from, const glm::dvec3& to_m) const;
    /// The same from a point in the air.
    bool visible(const glm::dvec3& from_m, const glm::dvec3& to_m) const;
    /// Segments of a packet, from start to end in the air; returns the lanes along which nothing stands.
    LaneMask visible(const std::array<glm::dvec3, packet_size>& from_m, const std::array<glm::dvec3, packet_size>& to_m,
                     LaneMask lanes) const;

    /// From where rays leave a surface, so that they do not meet it again: raised along the flat triangle's normal by what floats round.
    /// A vertex, the ray's origin and Embree's edge functions are each off by at most half a unit in the last place (2^-24) of the largest
    /// coordinate; eight such units cover their sum in three dimensions: 0.05 mm within 100 m of the origin, 0.4 mm at 800 m. What is lower
    /// than that casts no shadow and shades nothing.
    static glm::dvec3 raised(const SurfaceHit& hit);

    std::size_t triangles() const { return facets_.size(); }

  private:
    struct Embree;
    /// A triangle as hit_on needs it, in double.
    struct Facet {
        glm::dvec3 corner_m, ab_m, ac_m; ///< one corner relative to origin_m, and from there to the other two
        glm::dvec3 normal;               ///< of the plane, on the lit side
        std::uint32_t first = 0;         ///< of its three indices
        std::uint32_t material = 0;
    };
    void add_facets(const Mesh& mesh);
    SurfaceHit hit_on(const Ray& ray, std::uint32_t mesh, std::uint32_t triangle) const;

    const Scene& scene_;
    glm::dvec3 origin_m_;
    std::vector<Facet> facets_;            ///< of all meshes in turn
    std::vector<std::size_t> first_facet_; ///< by mesh
    std::unique_ptr<Embree> embree_;
};

} // namespace fernlicht::reference
