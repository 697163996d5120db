// Lamps of others on the scene: any number, each as coarsely as its light allows.
//
// A pair of lamps of one body with one beam and one aim is one unit. For each piece of the scene and each cell of a grid on the ground, a
// bound from the beam and the distance says how much light a unit can bring there (b) and how wrong it would be as one beam from midway
// between its lamps (m). With l the least lux (Moment::least_traffic_lx) the unit is drawn there
//   with each lamp's beam where m >= 4 l, with one beam for both where m <= 2 l, both weighted between;
//   on pieces that are not ground and do not retroreflect: per vertex where b <= 3 l, as a point of one intensity per vertex where
//   b <= 1.5 l, blended from 4 l and 2 l on;
//   not at all where b <= l: what it brings is ramped from nothing at l to all at 2 l, so that this adds exactly nothing.
// So no unit is off by more than 5 l anywhere.
#pragma once

#include "renderer/gl/beams.h"
#include "renderer/gl/draw_list.h"
#include "renderer/renderer.h"

namespace fernlicht::gl {

inline constexpr double traffic_cell_m = 8.0;
inline constexpr int traffic_cells_ahead = 32, traffic_cells_across = 8;
inline constexpr double traffic_behind_m = 32.0, traffic_beside_m = 32.0; ///< of the car, where the grid begins

class TrafficLights {
  public:
    TrafficLights(Context& context, const SceneBuffers& scene, Beams& beams, bool levels, bool pruned)
        : context_(context), scene_(scene), beams_(beams), levels_(levels), pruned_(pruned) {}

    /// Lists for the pieces that are drawn.
    void set(const Moment& moment, const std::vector<std::uint32_t>& drawn, Work& work);
    bool any() const { return !units_.empty(); }
    std::size_t units() const { return units_.size(); }
    /// Whether any light of others may fall on the piece.
    bool reach(std::uint32_t piece) const { return lists_[piece].traffic[1] != 0 || lists_[piece].traffic[3] != 0; }
    const std::vector<PieceExtra>& lists() const { return lists_; }
    void bind() const;
    /// Direction of travel in the plane, and the grid's corner.
    glm::vec4 grid() const;
    int left_out() const { return left_out_; } ///< units that reach nothing of what was drawn

  private:
    struct Packed { // std430, as in traffic_lamps.glsl
        glm::vec4 position_m, right, up, forward, colour, grid, beam;
    };
    struct Unit {
        const Beam* beam = nullptr;
        std::vector<double>* merging_cd = nullptr; ///< by samples between the lamps and the middle
        LitLamp middle;
        glm::dvec3 at_m{0.0}; ///< relative to the car
        double factor = 1.0, half_m = 0.0;
        int first = 0, lamps = 1; ///< packed: each lamp, then where there are two the one for both
        bool used = false;
    };
    struct Place {
        glm::dvec3 centre_m{0.0};
        double radius_m = 0.0, lowest_m = 0.0, lean = 0.0; ///< lean: sine of the steepest normal's angle from the vertical
        bool ground = false, retro = false;
    };
    struct Lists {
        std::vector<glm::vec4> fragment, vertex;
    };
    void add_units(const Moment& moment);
    void pack(const LitLamp& lamp, const Beam& beam, const Moment& moment, double factor, double least_lx);
    int beam_offset(const Beam& beam);
    /// What a unit can bring to a place; the coarse bound alone where that is not above `least_lx`.
    struct Bound {
        double most_lx = 0.0, lx_a_cd = 0.0, near_m = 0.0;
    };
    Bound bound(const Unit& unit, const Place& place, double least_lx) const;
    static double merging_lx(const Unit& unit, const Bound& bound);
    void list(Unit& unit, const Place& place, double least_lx, Lists& lists, Work& work);
    void list_cells(const Moment& moment, const std::vector<std::uint32_t>& drawn, Work& work);
    std::pair<std::uint32_t, std::uint32_t> keep(const std::vector<glm::vec4>& entries);

    Context& context_;
    const SceneBuffers& scene_;
    Beams& beams_;
    bool levels_, pruned_;
    std::vector<Unit> units_;
    std::vector<Packed> packed_;
    std::vector<glm::vec4> entries_;
    std::vector<float> cd_;
    std::map<int, int> offsets_;
    std::map<int, std::vector<double>> merging_cd_;
    std::vector<PieceExtra> lists_;
    std::vector<std::uint32_t> cells_;
    glm::dvec2 ahead_{1.0, 0.0};
    Buffer lamp_buffer_, entry_buffer_, cd_buffer_, cell_buffer_;
    std::size_t lamp_room_ = 0, entry_room_ = 0, cd_room_ = 0;
    int left_out_ = 0;
};

} // namespace fernlicht::gl
