// Other lamps on the scene: any number, each as coarsely as its light allows.
//
// A pair of lamps of one body with one beam and one aim is one unit. For each piece of the scene and each cell of a grid on the ground, a
// bound from the beam and the distance says how much light a unit can bring there and how wrong it would be as one beam from midway
// between its lamps; renderer/traffic_levels.h says how it is drawn then, and how wrong that is at most. Pieces that are not ground and do
// not retroreflect may be lit by vertex.
#pragma once

#include "renderer/gl/scene/beams.h"
#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/traffic_shadows.h"
#include "renderer/renderer.h"
#include "renderer/traffic_levels.h"

#include <limits>
#include <span>

namespace fernlicht::gl {

inline constexpr double traffic_cell_m = 8.0;
inline constexpr int traffic_cells_ahead = 32, traffic_cells_across = 8;
inline constexpr double traffic_behind_m = 32.0, traffic_beside_m = 32.0; ///< of the car, where the grid begins

/// How units were drawn, over all places (pieces and cells) of all pictures so far.
struct TrafficReport {
    std::uint64_t each = 0, merged = 0, by_vertex = 0, point = 0, left_out = 0; ///< units times places; a blend counts in both
    double worst_drawn_lx = 0.0;    ///< most of what all units drawn at a place can be off together, by bounds
    double worst_left_out_lx = 0.0; ///< most that all units left out at a place can bring together, by bounds
};

class TrafficLights {
  public:
    TrafficLights(Context& context, const SceneBuffers& scene, Beams& beams, bool levels, bool pruned)
        : context_(context), scene_(scene), beams_(beams), levels_(levels), pruned_(pruned) {}

    /// Lists for the pieces that are drawn. `shadows`: chooses which units cast any; nullptr: none do.
    void set(const Moment& moment, const std::vector<std::uint32_t>& drawn, Work& work, TrafficShadows* shadows);
    bool any() const { return !units_.empty(); }
    std::size_t units() const { return units_.size(); }
    /// Whether any light of others may fall on the piece.
    bool reach(std::uint32_t piece) const { return lists_[piece].traffic[1] != 0 || lists_[piece].traffic[3] != 0; }
    const std::vector<PieceExtra>& lists() const { return lists_; }
    void bind() const;
    /// Direction of travel in the plane, and the grid's corner.
    glm::vec4 grid() const;
    const TrafficReport& report() const { return report_; }
    int left_out() const { return left_out_; } ///< units that reach nothing of what was drawn

  private:
    struct Packed { // six texels, as in traffic_lamps.glsl
        glm::vec4 position_m, forward, up, apart_m, colour, grid;
    };
    struct Unit : TrafficSource {
        const TrafficBeam* bounds = nullptr;
        glm::dvec3 at_m{0.0}; ///< of the middle, relative to the car
        double factor = 1.0, half_m = 0.0;
        double half_up_m = 0.0; ///< the part of half_m along the lamps' vertical
        double reaches_m = 0.0; ///< no farther does it bring the least lux, wherever it aims
        bool used = false;
    };
    /// What the fragment or vertex stage fetches.
    struct Texels {
        Buffer buffer;
        Texture texture;
        std::size_t room = 0;
    };
    struct Place {
        glm::dvec3 centre_m{0.0};
        double radius_m = 0.0, lowest_m = 0.0, highest_m = 0.0, lean = 0.0; ///< lean: sine of the steepest normal's angle from the vertical
        bool ground = false, retro = false;
        const std::vector<glm::dvec4>* normals = nullptr; ///< ground: its cell's, instead of lean
    };
    /// What ground lies in a cell, relative to the car.
    struct Cell {
        double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
        std::vector<glm::dvec4> normals; ///< each for all within same_normal of it, w: the least normal . place
        void add(const glm::dvec4& normal);
    };
    struct Lists {
        std::vector<glm::vec4> fragment, vertex;
        std::vector<TrafficReceiver> receivers;   ///< of `fragment`; entry: counted from its first
        double drawn_lx = 0.0, left_out_lx = 0.0; ///< bounds, summed over units
    };
    void add_units(const Moment& moment);
    void pack(const Unit& unit, int first, double min_lx);
    int beam_offset(const Beam& beam);
    /// What a unit can bring to a place; the coarse bound alone where that is not above `min_lx`.
    struct Bound {
        double max_lx = 0.0, lx_a_cd = 0.0, near_m = 0.0;
        BeamWindow window;
    };
    static Bound bound(const Unit& unit, const Place& place, double min_lx);
    static BeamWindow window(const Unit& unit, const Place& place, const glm::dvec3& from);
    Lists lists_of(const Place& place, std::span<const std::size_t> units, double min_lx, Work* work);
    void list(std::size_t number, const Place& place, double min_lx, Lists& lists, Work* work);
    /// Numbers of the units that may reach into a sphere; all where nothing is pruned.
    std::vector<std::size_t> reaching(const glm::dvec3& centre_m, double radius_m) const;
    std::vector<Cell> cells_of(const Moment& moment, const std::vector<std::uint32_t>& drawn) const;
    void list_cells(const Moment& moment, const std::vector<std::uint32_t>& drawn, Work& work);
    template <class T> void fill(Texels& texels, GLenum format, const std::vector<T>& values);
    std::pair<std::uint32_t, std::uint32_t> keep(const std::vector<glm::vec4>& entries);
    /// The same of light by fragment, on a place that shadows may fall on.
    std::pair<std::uint32_t, std::uint32_t> keep(Lists& lists, const TrafficPlace& place);

    Context& context_;
    const SceneBuffers& scene_;
    Beams& beams_;
    bool levels_, pruned_;
    std::vector<Unit> units_;
    std::vector<Packed> packed_;
    std::vector<glm::vec4> entries_;
    std::vector<TrafficReceiver> receivers_;
    std::vector<TrafficPlace> places_;
    std::vector<float> cd_;
    std::map<int, int> offsets_;
    std::map<int, TrafficBeam> bounds_;
    std::vector<PieceExtra> lists_;
    std::vector<glm::vec2> cells_;
    glm::dvec2 ahead_{1.0, 0.0};
    Texels unit_texels_, entry_texels_, cd_texels_, cell_texels_;
    TrafficReport report_;
    int left_out_ = 0;
};

} // namespace fernlicht::gl
