// The lamps of a moment on the GPU: beam textures (kept from moment to moment), their uniform block, and shadow maps.
#pragma once

#include "renderer/beam_texture.h"
#include "renderer/gl/objects.h"
#include "renderer/gl/program.h"
#include "renderer/gl/scene_buffers.h"
#include "scenarios/drives/moment.h"

#include <glm/vec4.hpp>
#include <map>
#include <optional>

namespace fernlicht::gl {

inline constexpr int most_lamps = 8;

class LampLights {
  public:
    LampLights(Context& context, int shadow_width, int shadow_height);

    /// Takes the lamps that are on. Throws InputError for more than most_lamps.
    void set(const Moment& moment, bool shadows);
    void draw_shadow_maps(SceneBuffers& scene, const glm::dvec3& ego_m);
    void bind() const;

    int count() const { return static_cast<int>(lit_.size()); }
    double beam_error(const LampFile& lamp);

  private:
    struct Beam {
        Texture texture;
        BeamTexture grid;
    };
    struct Packed { // std140, as in lamps.glsl
        glm::vec4 position_m, right, up, forward, grid, count, colour, shadow;
    };
    struct Window { ///< tangents in lamp space that the shadow map covers
        double left, right, bottom, top;
    };
    const Beam& beam(const std::shared_ptr<const LampFile>& file);
    static Window window_of(const Beam& beam);

    Context& context_;
    int shadow_width_, shadow_height_;
    Program depth_program_;
    GLint depth_matrix_;
    std::map<const LampFile*, std::pair<std::shared_ptr<const LampFile>, Beam>> beams_;
    std::vector<LitLamp> lit_;
    std::vector<Packed> packed_;
    Buffer block_;
    std::vector<Texture> shadow_maps_;
    Framebuffer shadow_target_;
};

} // namespace fernlicht::gl
