// The technique `photometric`: variants compiled for what a moment needs, and drawn group by group.
#pragma once

#include "renderer/gl/lamps_seen.h"
#include "renderer/gl/scene/lighting.h"
#include "renderer/gl/shadows/shadows.h"
#include "renderer/gl/sun_light.h"
#include "renderer/gl/traffic_lights.h"

#include <memory>
#include <tuple>

namespace fernlicht::gl {

/// Air that is seen before the sky.
bool fog_before_sky(const Shot& shot);

class PhotometricLighting : public Lighting {
  public:
    /// `pruned`: leave out what a moment does not need; else everything is compiled in and drawn, which gives the same pixels.
    PhotometricLighting(Context& context, const Scene& scene, const RendererSettings& settings, bool pruned);

    void draw(const Shot& shot) override;
    void prepare(const Shot& shot) override;
    void prepare_here(const Shot& shot) override;
    void keep_programs_of(const std::vector<Moment>& moments) override;
    std::optional<double> beam_error(const LampFile& lamp) const override { return beams_.error_of_peak(lamp); }
    std::vector<PrunedFeature> pruned() const override { return pruned_features_; }
    /// Why the shader lights such a picture though the CPU was to; "" where the CPU does.
    std::string why_shader(const Shot& shot) const override;

  private:
    /// A set of features is a shader variant.
    struct Features {
        std::vector<int> beams; ///< one a lamp
        SurfaceClass surface;
        bool shadows = false, sky = false, everything = false, by_vertex = true, traffic = false, traffic_shadows = false;
        int sun = 0; ///< 0: neither sun nor moon, 1: shines, 2: casts shadows
        bool fog = false, lamps_in_fog = false, wet = false, background = false;
        int outputs = 0;
        auto operator<=>(const Features&) const = default;
    };
    struct Compiled {
        Program program;
        bool traffic, shadows, sun, weather, lamps_in_fog;
    };
    /// Pieces that one variant draws.
    struct Group {
        SurfaceClass surface;
        bool lit = true, shadowed = true, traffic = true, traffic_shadowed = true;
        std::vector<std::uint32_t> pieces;
    };
    struct Packed { // std140, as in photometric_lamps.glsl
        glm::vec4 position_m, right, up, forward, colour, eye, raise;
    };

    void set_lamps(const Shot& shot);
    void set_sun(const Shot& shot);
    void make_traffic_shadows(const Moment& moment);
    std::vector<Group> groups_for(const Shot& shot);
    Features features_of(const Shot& shot, const Group& group, int sun) const;
    const Compiled& variant(const Features& features, const FrameOutputs& outputs);
    void use(const Compiled& v, const Shot& shot) const;
    void set_for_preparing(const Shot& shot);
    void compile_visible(const Shot& shot);
    void compile(const Features& features, const Shot& shot);
    const Program& visible_program(bool textured, bool moving);
    void use_visible(const Features& features, const Shot& shot);
    void light_visible(const Shot& shot, const std::vector<Group>& groups);
    Features background_features(const Shot& shot) const;
    void draw_background(const Shot& shot);
    void note_what_is_left_out(const Shot& shot, const std::vector<Group>& groups);

    Context& context_;
    RendererSettings settings_;
    bool pruned_;
    SceneBuffers scene_;
    Beams beams_;
    std::unique_ptr<Shadows> shadows_; ///< nullptr: none are cast
    TrafficLights traffic_;
    std::unique_ptr<TrafficShadows> traffic_shadows_; ///< from the first moment on with lamps of others, unless none are cast
    LampsInFog lamps_in_fog_;
    LampFaces faces_;
    std::unique_ptr<SunLight> sun_; ///< from the first moment on in which sun or moon shines
    int sun_needs_ = 0;             ///< as Features::sun
    DrawList list_;
    std::map<Features, Compiled> variants_;
    std::optional<CpuLight> cpu_light_;                         ///< where the CPU is to light
    std::map<std::pair<bool, bool>, Program> visible_programs_; ///< textured, moving
    std::vector<std::uint32_t> visible_;
    std::vector<LitLamp> lamps_;
    std::vector<const Beam*> lamp_beams_;
    std::vector<Packed> packed_;
    Buffer block_;
    bool by_vertex_ = true;
    std::vector<PrunedFeature> pruned_features_;
};

} // namespace fernlicht::gl
