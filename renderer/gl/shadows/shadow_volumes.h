// Shadow volumes: the space that bodies hide from each lamp, counted into the stencil buffer behind each pixel's surface. Edges of shadows
// lie where the geometry has them, at any distance, whatever the size of a map.
#pragma once

#include "renderer/gl/shadows/shadow_mask.h"
#include "renderer/gl/shadows/silhouettes.h"
#include "renderer/gl/shadows/stencil_volumes.h"

#include <map>

namespace fernlicht::gl {

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
