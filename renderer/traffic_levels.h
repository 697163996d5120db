// How coarsely a pair of another road user's lamps is drawn at a place, and how wrong that is at most.
//
// b: the most light the pair can bring there. m: how far one beam from midway between its lamps can be off there. l: the least lux.
//   each lamp with its beam where m >= 4 l, one beam for both where m <= 2 l, both weighted between;
//   where light may be interpolated: by vertex where b <= 3 l, as a point of one intensity by vertex where b <= 1.5 l, blended from 4 l
//   and 2 l on;
//   not at all where b <= l: what is drawn by fragment is ramped from nothing at l to all at 2 l, so that leaving out adds exactly nothing.
#pragma once

#include "renderer/beam_texture.h"

namespace fernlicht {

/// Shares of the ways to draw a pair (or a lamp alone); they add up to 1.
struct TrafficShare {
    double each = 1.0, merged = 0.0, by_vertex = 0.0, point = 0.0;
};

/// Of b = max_lx, m = merging_lx, l = min_lx (all >= 0). `pair`: two lamps; else `merged` is the lamp itself, and m = 0. `interpolated`:
/// light may be interpolated over triangles.
TrafficShare traffic_share(double max_lx, double merging_lx, double min_lx, bool pair, bool interpolated);

/// Bound on |illuminance as drawn - that of each lamp with its own beam|, lx. By fragment a ramp takes at most l (l / 2 of each of two
/// lamps): e (2 l - e) / l between l and 2 l, all of e below. One beam for both is off by m more. By vertex the light lies between 0 and b
/// as the true light does. Nothing is off by more than b.
double traffic_error_lx(const TrafficShare& share, double max_lx, double merging_lx, double min_lx);

/// Most that traffic_error_lx() of a traffic_share() can be, in l. One beam for both: (4 l - m) m / (2 l) has its most, 2 l, at m = 2 l,
/// and the ramp takes l: 3. Between fragments and vertices, with b = x l and 3 <= x <= 4: (4 - x) x + 3 (x - 3), at x = 3.5: 3.25.
inline constexpr double worst_traffic_error = 3.25;

/// Directions in the goniometer's angles.
struct BeamWindow {
    double h_from_rad = 0.0, h_to_rad = 0.0, v_from_rad = 0.0, v_to_rad = 0.0;
};

/// Bounds on a beam within a window: how bright it is, and what it is off when it shines once from midway between two lamps instead of
/// twice.
class TrafficBeam {
  public:
    TrafficBeam() = default;
    /// Texels in float (bits = 32).
    explicit TrafficBeam(const BeamTexture& beam);

    /// No direction in the window has more, in cd.
    double max_cd(const BeamWindow& window) const;
    double max_cd() const { return most_; } ///< in any direction

    /// Bound on |E_1 + E_2 - E_midway| for lamps of half the intensity each, where E_midway <= max_lx, 1 cd brings at most lx_a_cd, and
    /// the receiver is seen from midway within the window. `apart`: half the lamps' distance over the least distance to the receiver, > 0;
    /// above 0.2 or the steps that are known, 2 max_lx. `apart_up`: the part of `apart` along the lamps' vertical.
    /// The intensity's second difference across for the angle between the lamps (exact for a bilinear beam: it is linear between the
    /// differences at whole and half steps that are looked through); its slope up times the second-order change of V; its slope across
    /// times that of H, and times the first-order change of cosine / d^2 (3 `apart`); and the second-order change of that, twice 3 / 2
    /// `apart`^2 for distance and cosine each.
    double merging_lx(double apart, double apart_up, const BeamWindow& window, double lx_a_cd, double max_lx) const;

  private:
    struct Row {                                     ///< of some rows of texels
        float up = 0.0F, across = 0.0F, edge = 0.0F; ///< largest steps from texel to texel, cd; the most at the table's edges
        std::vector<float> second_cd;                ///< by steps between lamp and middle, and over all fewer
    };
    std::pair<int, int> rows_of(double v_from_rad, double v_to_rad) const;

    double h_first_ = 0.0, v_first_ = 0.0, h_step_ = 1.0, v_step_ = 1.0, most_ = 0.0;
    int columns_ = 0;
    std::vector<Row> rows_;
    std::vector<float> max_of_cell_;
};

} // namespace fernlicht
