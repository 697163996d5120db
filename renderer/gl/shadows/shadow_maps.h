// Depth as each lamp sees it, of what can cast a shadow (shadow_casters.h). Receivers are looked up from a point raised above their
// surface by what a texel spans there, ground lowered by as much where it casts (docs/decisions/0005, 0011), so that nothing shades itself.
// The depth textures of shadow maps.
#pragma once

#include "renderer/gl/device/objects.h"
#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/shadows/map_on_cpu.h"

#include <string>

namespace fernlicht::gl {

class ShadowMaps : public Shadows {
  public:
    ShadowMaps(Context& context, const SceneBuffers& scene, const ShadowSettings& settings);

    /// Draws the maps unless they stand already as they would be drawn.
    void draw(const Shot& shot) override;
    void compile(const Shot& shot) override;
    std::vector<Program::Define> defines(const std::vector<const Beam*>& beams) const override;
    std::span<const ShadowLookUp> look_ups() override;
    bool has_look_ups() const override { return true; }
    std::size_t texture_bytes() const override;
    const char* title() const override { return "shadow maps"; }

  private:
    void draw_maps(std::vector<Texture>& textures, double ground_lowered, Work& work);
    double spread() const; ///< what look-ups are raised by over their distance along the axis

    DepthPass pass_;
    std::vector<Texture> textures_, target_textures_; ///< for targets: with ground where it is; only where both are asked for
    struct Drawn {
        std::vector<glm::dmat4> clips;
        std::vector<std::vector<std::uint32_t>> pieces;
        glm::dvec3 ego_m{0.0};
        std::uint64_t placed = 0;
        bool operator==(const Drawn&) const = default;
    } drawn_;                    ///< what the textures hold
    bool targets_drawn_ = false; ///< target_textures_ hold it too
    bool targets_apart_ = false; ///< what is drawn looks targets up there
    std::vector<MapOnCpu> on_cpu_, targets_on_cpu_;
    bool on_cpu_stands_ = false, targets_on_cpu_stand_ = false; ///< drawn_ is read back
    std::vector<ShadowLookUp> look_ups_;
};

struct ShadowTextureAsked {
    int width = 0, height = 0; ///< texels
    int layers = 0;            ///< maps in an array of textures; 0: one map, a plain texture
    std::string owner;         ///< "each lamp by 'map'"
    std::string smaller;       ///< what takes less: "a smaller map_texels"
};
/// Depths that are compared while they are looked up. Throws ShadowMemoryError where the driver has no room for them.
Texture make_shadow_texture(Context& context, const ShadowTextureAsked& asked);

} // namespace fernlicht::gl
