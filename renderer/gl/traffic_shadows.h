// Shadows in the light of other road users' lamps and of street lamps.
//
// A unit of traffic_lights.h has a depth map for each of its lamps. Its shadow on a fragment is ramped, from nothing where the unit brings
// there min_traffic_shadow times the least lux to all of it at twice that: what needs no map or no look-up by a bound on its light adds
// exactly nothing, and nothing pops. Of more units than there are maps the strongest have them: those with most light, by bounds, on places
// where something may shade it, each place weighted by how large it is from the car. A unit that is near to losing its maps has faded
// shadows, so that they do not pop either.
//
// A lamp's own body casts like all others, from shadow_near_m in front of the lamp's glass on: luminous faces stand before the body, so
// that it cannot swallow them (as rays of the reference, which end just before the lamp).
#pragma once

#include "renderer/gl/device/program.h"
#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/scene/lighting.h"
#include "renderer/gl/shadows/shadow_casters.h"

#include <span>

namespace fernlicht::gl {

/// 8 pairs: on a straight with a car each 40 m the ninth stands 320 m ahead, where a shadow of a car spans a few pixels. 8 MB.
inline constexpr std::size_t max_traffic_maps = 16;
/// Light of a unit whose shadow is not drawn, in least lux.
inline constexpr double min_traffic_shadow = 2.0;
/// A unit with so much more than the strongest without maps has shadows in full.
inline constexpr double traffic_map_handover = 0.25;

/// One or two lamps with one beam and one aim.
struct TrafficSource {
    LitLamp middle;          ///< with the light of both
    glm::dvec3 apart_m{0.0}; ///< from the middle to the second lamp; 0 for one lamp
    int lamps = 1;
    const Beam* beam = nullptr;
};

/// Somewhere light falls.
struct TrafficPlace {
    static constexpr std::uint32_t no_piece = 0xffffffffU;
    Corners box_m;                  ///< relative to the car; bits 0 to 3 of the index: its bottom
    double weight = 0.0;            ///< how large it is, seen from the car
    std::uint32_t piece = no_piece; ///< of the scene
};

/// The light of one unit by fragment on one place.
struct TrafficReceiver {
    std::uint32_t unit = 0, place = 0, entry = 0; ///< entry: among those of traffic_lamps.glsl
    double max_lx = 0.0;                          ///< it brings no more
};

class TrafficShadows {
  public:
    TrafficShadows(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, bool pruned);

    /// Chooses units, and writes their maps into entries.
    void choose(const Moment& moment, std::span<const TrafficSource> units, std::span<const TrafficReceiver> receivers,
                std::span<const TrafficPlace> places, std::vector<glm::vec4>& entries);
    bool any() const { return !chosen_.empty(); }
    /// Whether a shadow may fall on the piece. Errs towards yes.
    bool reach(std::uint32_t piece) const { return reached_[piece]; }
    /// Draws the maps that do not stand already, before the view's targets are begun.
    void draw(const Shot& shot);
    void compile();
    void bind() const;
    std::vector<Program::Define> defines() const;
    std::size_t texture_bytes() const;

    /// That something may shade, and that are not among the strongest: the most in any picture so far.
    std::size_t max_units_left_out() const { return max_units_left_out_; }
    /// Most that these bring together, over all places of all pictures, by bounds: what shadows can be missing there.
    double worst_left_out_lx() const { return worst_left_out_lx_; }

  private:
    struct Map {
        LitLamp lamp;
        glm::dvec3 lamp_m{0.0}; ///< relative to the car
        ShadowWindow window;
        std::vector<Caster> bodies;
        std::vector<std::uint32_t> pieces; ///< ascending
        double weight = 1.0;
        std::size_t layer = 0;
    };
    struct Candidate {
        std::uint32_t unit = 0;
        std::vector<Map> maps; ///< one a lamp
        double score = 0.0;    ///< light times weight, over the places that something may shade
    };
    struct Layer { ///< what a layer of the texture holds
        glm::dmat4 clip{0.0};
        std::vector<std::uint32_t> pieces;
    };

    std::vector<std::uint32_t> pieces_near(const TrafficSource& unit, double min_lx) const;
    Map map_of(const TrafficSource& unit, int lamp, const std::vector<std::uint32_t>& pieces) const;
    Candidate candidate(std::uint32_t number, const TrafficSource& unit, double min_lx) const;
    static bool shaded(const Candidate& candidate, const Corners& box_m);
    void place_in_layers(std::vector<char>& to_draw);

    Context& context_;
    const SceneBuffers& scene_;
    ShadowSettings settings_; ///< of one map
    bool pruned_;
    DepthPass pass_;
    Texture maps_, map_texels_;
    Buffer map_buffer_;
    glm::dvec3 ego_m_{0.0};
    std::vector<std::uint32_t> casters_; ///< what may cast, near the car
    std::vector<Map> chosen_;
    std::vector<bool> reached_;
    std::size_t max_units_left_out_ = 0;
    double worst_left_out_lx_ = 0.0;
    std::vector<Layer> layers_;
    glm::dvec3 drawn_ego_m_{0.0};
    std::uint64_t drawn_placed_ = 0;
};

} // namespace fernlicht::gl
