// Lights a picture on the CPU, each pixel once, where GL has drawn which triangle it shows (shaders/visible.frag.glsl).
#pragma once

#include "renderer/beam_texture.h"
#include "renderer/renderer.h"
#include "scenarios/drives/play/camera.h"
#include "scenarios/drives/play/frame.h"
#include "scenarios/packs/level.h"
#include "scenarios/values/scene.h"

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <span>

namespace fernlicht {

namespace packs {
struct PassMaterial;
}

/// What is drawn, as the GPU has it.
struct DrawnSurfaces {
    struct Corner {
        glm::vec3 position_m, normal; ///< relative to the mesh's origin
        std::uint32_t material = 0;
    };
    std::vector<Corner> corners;
    /// Of the triangle whose last corner it is, the other two: each triangle has a last corner of its own.
    std::vector<std::array<std::uint32_t, 2>> others;
};

/// A piece as it stands in a picture.
struct DrawnPiece {
    std::uint32_t first_id = 1;                  ///< its corner k is drawn as first_id + k; pieces come in the order of their ids
    std::uint32_t first_corner = 0, corners = 0; ///< among all
    glm::dvec3 origin_m{0.0};                    ///< relative to the car
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    std::uint32_t mesh = 0;
    bool ground = false;
    bool lit = true, shadowed = true; ///< own lamps may reach it, shadows may fall on it
};

/// Depth maps of what one lamp does not see.
struct ShadowLookUp {
    glm::dmat4 texture_from_ego{1.0}; ///< x, y, w, and what is raised by, of places relative to the car
    double near_m = 0.0, tolerance_m = 0.0;
    int width = 0, height = 0;
    std::vector<glm::dvec2> shifts{{}};  ///< of x and y, one a layer
    const float* depth = nullptr;        ///< layer by layer; rows from the lowest
    const float* target_depth = nullptr; ///< that targets above surfaces are looked up in; nullptr: the same
    double box[4] = {};                  ///< in texels, low and high x, low and high y: look-ups beside it meet nothing
};

struct DrawnLamp {
    const LitLamp* lamp = nullptr;
    const BeamTexture* beam = nullptr; ///< of as long a life as the pass
    bool steep = false;
    const ShadowLookUp* shadow = nullptr;
};

struct DrawnPicture {
    const Camera& camera;
    int width = 0, height = 0;
    std::span<const std::uint32_t> visible; ///< id and texel of each pixel, rows from the top
    std::span<const DrawnPiece> pieces;
    std::span<const DrawnLamp> lamps;
    glm::dvec3 ego_m{0.0};
    double sky_lx = 0.0;
    float sky_luminance_cdm2 = 0.0F;
    glm::vec3 background{0.0F};
    FrameOutputs outputs;
    LightWork* work = nullptr; ///< counted and timed for it
};

class CpuLight {
  public:
    /// `sources`: what shines by itself is seen.
    CpuLight(const Scene& scene, const ToneMapper& tone, const std::optional<glm::dmat3>& white, double target_height_m, bool sources,
             packs::Level level);
    ~CpuLight();

    /// Fills what the picture wants of the frame; pictures of the right size are written over.
    void draw(const DrawnPicture& picture, const DrawnSurfaces& surfaces, Frame& frame);

  private:
    const std::vector<float>& padded(const BeamTexture& beam);

    ToneMapper tone_;
    std::optional<glm::mat3> white_rows_;
    double target_height_m_;
    packs::Level level_;
    std::vector<packs::PassMaterial> materials_;
    struct Padded {
        std::uint64_t state = 0; ///< of the beam
        std::vector<float> cd;
    };
    std::map<const BeamTexture*, Padded> beams_;
};

} // namespace fernlicht
