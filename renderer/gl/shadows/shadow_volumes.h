// Shadow volumes: the space that bodies hide from each lamp, counted into the stencil buffer behind each pixel's surface. Edges of shadows
// lie where the geometry has them, at any distance, whatever the size of a map.
//
// Hulls of the space that bodies hide from a lamp: triangles that cast, moved away from the lamp, and walls where they end.
//
// An edge gets as many walls as its triangles that cast leave uneven: each adds +1 or -1 by the direction in which it runs round that
// triangle once all are turned towards the lamp, and the sum says how many walls and which way round (G. Aldridge and E. Woods, "Robust,
// geometry-independent shadow volumes", 2004). So open sheets, edges of more than two triangles and triangles turned the wrong way round
// all give closed hulls.
#pragma once

#include "renderer/gl/shadows/shadow_mask.h"

#include <array>
#include <map>

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

class ShadowVolumes : public ShadowMask {
  public:
    ShadowVolumes(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, const ShadowUse& use);

    void set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) override;
    const char* title() const override { return "shadow volumes"; }

  protected:
    bool only_on_ground() const override { return false; }
    bool hides_any(std::size_t lamp) const override { return !casters_.lamps()[lamp].pieces.empty(); }
    const char* pass_title() const override { return "shadow volumes: stencil"; }
    void before_marking(const Shot& shot) override;
    void mark_hidden(const Shot& shot, std::size_t lamp, double raised_m) override;

  private:
    using Pieces = std::vector<std::uint32_t>; ///< of one mesh
    /// Hulls behind one mesh from one lamp, in the mesh's frame.
    struct Hulls {
        Pieces pieces;
        glm::dvec3 lamp_m{0.0};
        std::vector<bool> casts; ///< by body
        std::vector<glm::vec4> corners;
        std::size_t first = 0; ///< in what is uploaded
    };
    struct Kept {
        Silhouettes silhouettes;
        std::size_t used = 0; ///< by this picture at last
    };
    const Silhouettes& silhouettes_of(const Pieces& pieces);
    std::vector<bool> casting_bodies(const Silhouettes& silhouettes, const Piece& piece, std::size_t lamp) const;

    std::vector<const Beam*> beams_; ///< by lamp
    std::map<Pieces, Kept> silhouettes_;
    std::size_t pictures_ = 0;
    std::vector<std::vector<Hulls>> hulls_; ///< by lamp
    StencilVolumes volumes_;
};

} // namespace fernlicht::gl
