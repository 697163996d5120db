// Hulls of the space that bodies hide from a lamp: triangles that cast, moved away from the lamp, and walls where they end.
//
// An edge gets as many walls as its triangles that cast leave uneven: each adds +1 or -1 by the direction in which it runs round that
// triangle once all are turned towards the lamp, and the sum says how many walls and which way round (G. Aldridge and E. Woods, "Robust,
// geometry-independent shadow volumes", 2004). So open sheets, edges of more than two triangles and triangles turned the wrong way round
// all give closed hulls.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace fernlicht::gl {

/// Which triangles cast. fewest: of closed bodies those turned towards the lamp, of open ones all. turned_away: for ground, whose lit side
/// lets light pass that comes out again only through a part that faces away. all: from both sides.
enum class Casting { fewest, turned_away, all };

/// Triangles with what their hulls need, the same for every lamp.
class Silhouettes {
  public:
    /// Three places a triangle, counter-clockwise on the lit side. Corners with equal places are one; triangles without area are left out.
    explicit Silhouettes(const std::vector<glm::vec3>& corners);

    /// Appends the triangles of the hulls, three corners each, turned outwards: w = 1 as it stands, w = 0 moved away from the lamp to
    /// infinity. Of bodies with casts[i] alone.
    void add_hulls(const glm::dvec3& lamp_m, Casting casting, const std::vector<bool>& casts, std::vector<glm::vec4>& corners) const;

    std::size_t triangles() const { return triangles_.size(); }
    /// Bodies are triangles that share edges. Closed: at each edge as many triangles run one way as the other, and the lit sides lie
    /// outside (the volume that they enclose is not negative), so that light meets a lit side before it meets a back.
    struct Body {
        bool closed = true;
        glm::dvec3 low, high; ///< of the box round it
    };
    const std::vector<Body>& bodies() const { return bodies_; }
    std::size_t closed_bodies() const;

  private:
    struct Triangle {
        std::array<std::uint32_t, 3> corners; ///< into places_
        std::array<std::uint32_t, 3> edges;   ///< into edges_; edge k runs from corner k to the next
        std::array<std::int8_t, 3> along;     ///< +1: as the edge is stored
        glm::dvec3 normal{0.0};               ///< of any length
        double offset = 0.0;                  ///< -normal . place
        std::uint32_t body = 0;
    };
    std::vector<glm::vec3> places_;
    std::vector<std::array<std::uint32_t, 2>> edges_;
    std::vector<Triangle> triangles_;
    std::vector<Body> bodies_;
};

} // namespace fernlicht::gl
