// Parallel light of sun or moon, with a shadow map across the road before the car. None of it exists when neither shines.
//
// As for lamps (shadow_maps.h), ground that faces the light casts no shadow, and receivers are looked up from a point raised by what a
// texel spans, so that nothing shades itself; from level ground by less where no ground casts, or low light would pass under what stands on
// it.
#pragma once

#include "renderer/gl/device/program.h"
#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/scene/lighting.h"

namespace fernlicht::gl {

inline constexpr GLuint sun_shadow_unit = 17;
/// The map covers a square of this half width about a point so far before the car; beyond it nothing is shaded.
inline constexpr double sun_window_m = 120.0, sun_window_ahead_m = 80.0;
inline constexpr int sun_map_texels = 2048;

class SunLight {
  public:
    SunLight(Context& context, const SceneBuffers& scene);

    /// Takes the light of the moment and, with `shadows`, chooses the casters.
    void set(const Moment& moment, bool shadows);
    bool shines() const { return illuminance_lx_ > 0.0; }
    bool casts() const { return !casters_.empty(); }
    /// Draws the map unless it stands already as it would be drawn, and binds it.
    void draw(Work& work);
    void compile();
    /// Of a program with SUN.
    void set_uniforms(const Program& program) const;
    std::size_t texture_bytes() const;

  private:
    glm::dmat4 window_from_ego() const; ///< -1..1 across, depth 0..1 with 1 towards the light
    bool faces_light(const Piece& piece) const;
    void make_map();

    Context& context_;
    const SceneBuffers& scene_;
    DepthPass pass_;
    std::optional<Texture> map_;
    double illuminance_lx_ = 0.0;
    glm::dvec3 towards_{0.0, 0.0, 1.0}, right_{1.0, 0.0, 0.0}, up_{0.0, 1.0, 0.0};
    glm::dvec3 ego_m_{0.0}, centre_m_{0.0}; ///< centre of the map, relative to the car
    std::vector<std::uint32_t> casters_, drawn_;
    bool ground_casts_ = false;
    std::optional<glm::dmat4> drawn_window_;
    glm::dvec3 drawn_ego_m_{0.0};
};

} // namespace fernlicht::gl
