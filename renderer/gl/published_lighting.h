// The techniques of the founding thesis and of the literature: one family of shaders, compiled with the features of a technique's row.
// What the published techniques light with, on the GPU: beam textures, merged beams, spot lights, light maps; each made once.
#pragma once

#include "renderer/gl/device/objects.h"
#include "renderer/gl/device/program.h"
#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/scene/lighting.h"
#include "renderer/light_map.h"
#include "renderer/projected_beam.h"
#include "scenarios/lamps/spots/spot_fit.h"

#include <list>
#include <map>
#include <memory>

namespace fernlicht::gl {

/// E_m at 25 m in lux = texel * lx_a_unit. The outermost texels are black, so that clamping to the edge gives no light outside the window.
struct UploadedBeam {
    TangentWindow window;
    double lx_a_unit = 1.0, peak_lx = 0.0, worst_error_of_peak = 0.0;
    Texture texture;
    std::size_t bytes = 0;
};

struct UploadedMap {
    LightMapAxis ahead, left, up; ///< up: volumes only
    Texture texture;              ///< lux; the outermost texels are black
};

class PublishedBeams {
  public:
    PublishedBeams(Context& context, const BeamTexels& texels) : context_(context), texels_(texels) {}

    const UploadedBeam& of(const std::shared_ptr<const LampFile>& file);
    double error_of_peak(const LampFile& file) const;
    const std::vector<Spot>& spots_of(const std::shared_ptr<const LampFile>& file);
    /// Made anew when a lamp moves on its car or changes its level; the last few arrangements are kept.
    const UploadedBeam& merged(const Moment& moment);
    const UploadedMap& light_map(const Moment& moment, bool volume);
    std::size_t texture_bytes() const { return texture_bytes_; }

  private:
    void forget_other_states(const LampFile& file); ///< of its pixels: they are not drawn again
    template <class Made> struct Kept {
        std::vector<LitLamp> arrangement; ///< the lamps that are on, in the car's frame
        Made made;
        std::size_t bytes;
    };
    template <class Made, class Make> const Made& kept(std::list<Kept<Made>>& list, const Moment& moment, Make make);
    UploadedBeam upload(const ProjectedBeam& beam);

    Context& context_;
    BeamTexels texels_;
    std::map<std::shared_ptr<const LampFile>, UploadedBeam> beams_;
    std::map<std::shared_ptr<const LampFile>, std::vector<Spot>> spots_;
    std::list<Kept<UploadedBeam>> merged_; ///< used last stands first
    std::list<Kept<UploadedMap>> maps_;
    std::size_t texture_bytes_ = 0;
};

class PublishedLighting : public Lighting {
  public:
    PublishedLighting(Context& context, const Scene& scene, const RendererSettings& settings);

    void draw(const Shot& shot) override;
    void prepare(const Shot& shot) override;
    std::vector<PrunedFeature> pruned() const override { return pruned_features_; }
    std::optional<double> beam_error(const LampFile& lamp) const override;

  private:
    /// Decides over a shader variant, beside the row.
    struct Variant {
        int lamps = 0, texture = 0, pass = 0, outputs = 0;
        auto operator<=>(const Variant&) const = default;
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
    const Program& variant(const Variant& wish, const FrameOutputs& outputs);
    void use(const Program& program, const Shot& shot) const;
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
    std::map<Variant, Program> variants_;
    int lamps_ = 0, computed_lamps_ = 0; ///< as the shader is compiled for; as it computes one by one
    std::vector<PackedLamp> packed_;
    std::vector<PackedSpot> spots_;
    std::vector<GLuint> textures_; ///< units 0, 1, ...
    const UploadedMap* map_ = nullptr;
    Buffer lamp_block_, spot_block_;
    std::vector<PrunedFeature> pruned_features_;
};

} // namespace fernlicht::gl
