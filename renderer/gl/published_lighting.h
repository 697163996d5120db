// The techniques of the founding thesis and of the literature: one family of shaders, compiled with the features of a technique's row.
#pragma once

#include "renderer/gl/device/program.h"
#include "renderer/gl/published_beams.h"
#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/scene/lighting.h"

#include <map>

namespace fernlicht::gl {

class PublishedLighting : public Lighting {
  public:
    PublishedLighting(Context& context, const Scene& scene, const RendererSettings& settings);

    void draw(const Shot& shot) override;
    void prepare(const Shot& shot) override;
    std::vector<LeftOut> left_out() const override { return left_out_; }
    std::optional<double> beam_error(const LampFile& lamp) const override;

  private:
    /// Decides over a shader variant, beside the row.
    struct Variant {
        int lamps = 0, texture = 0, pass = 0, wanted = 0;
        auto operator<=>(const Variant&) const = default;
    };
    struct Compiled {
        Program program;
        GLint clip, car, eye, axis, sun, ambient;
    };
    struct Group {
        int texture; ///< SurfaceClass::texture
        std::vector<std::uint32_t> pieces;
    };
    struct PackedLamp { // std140, as in published_features.glsl
        glm::mat4 texture_from_ego;
        glm::vec4 position_m;
    };
    struct PackedSpot {
        glm::vec4 axis, cd;
    };

    bool is(const char* feature, const char* value) const { return features_.at(feature) == value; }
    void set_lamps(const Shot& shot);
    void set_projected_lamp(const LitLamp& lamp, const UploadedBeam& beam, const glm::dvec3& ego_m);
    void set_spots(const LitLamp& lamp, const glm::dvec3& ego_m);
    std::vector<Group> groups_for(const Shot& shot, std::size_t& pieces) const;
    const Compiled& variant(const Variant& wish, const Wanted& wanted);
    void use(const Compiled& v, const Shot& shot) const;
    void bind() const;
    void start_pass(int pass, const Shot& shot) const;
    void end_passes() const;
    int first_pass() const { return technique_.passes > 1 ? 1 : 0; }

    Context& context_;
    RendererSettings settings_;
    const Technique& technique_;
    std::map<std::string, std::string> features_;
    SceneBuffers scene_;
    PublishedBeams beams_;
    DrawList list_;
    std::map<Variant, Compiled> variants_;
    int lamps_ = 0, computed_lamps_ = 0; ///< as the shader is compiled for; as it computes one by one
    std::vector<PackedLamp> packed_;
    std::vector<PackedSpot> spots_;
    std::vector<GLuint> textures_; ///< units 0, 1, ...
    const UploadedMap* map_ = nullptr;
    Buffer lamp_block_, spot_block_;
    std::vector<LeftOut> left_out_;
};

} // namespace fernlicht::gl
