// How evenly a lane is lit: gradients along and across, patches that are darker or brighter than what surrounds them, foreground against
// distance. Definitions are ours; of G = lg E(b) - lg E(b + 0.1 deg) of UN R112 the gradients have the logarithm. lx on the road's surface.
#pragma once

#include "metrics/readings/value.h"

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace fernlicht {

/// A lane's illuminance on a grid: rows along, columns across.
struct LaneLight {
    std::vector<double> ahead_m;     ///< from the lamps, above 0, ascending, at even distances
    std::vector<double> offset_m;    ///< ascending, at even distances
    std::vector<double> lx;          ///< row-major
    std::vector<glm::dvec3> seen_at; ///< of each point, from the driver's eye, any length
};

struct Gradient {
    double per_m = 0.0;                                               ///< |d lg E| a metre
    double per_degree = 0.0;                                          ///< |d lg E| a degree seen from the driver
    std::array<std::size_t, 2> per_m_between{}, per_degree_between{}; ///< which points
};
/// Largest between neighbours that both have at least `min_lx`; each of the two figures by itself. All 0 where nothing has.
struct Gradients {
    Gradient along, across;
};
Gradients largest_gradients(const LaneLight& light, double min_lx);

/// A patch is a connected part (over sides) of the points with at least `min_lx` whose light lies below or above a smooth surface by more
/// than `factor`. The surface: at each point the plane fitted by least squares to lg E over ln(ahead) and offset, among lit points within a
/// quarter of the distance along and 1.75 m across; a power of the distance is smooth.
struct Patches {
    int count = 0;
    double longest_m = 0.0; ///< along the lane, rows times their distance
};
struct Unevenness {
    Patches dark, bright;
};
Unevenness patches(const LaneLight& light, double min_lx, double factor);

/// Mean illuminance from 5 to 15 m, by `ahead_m`: the light on the road at the car's nose, which pleases and shows nothing far. Not
/// measured where the grid does not reach.
Value foreground_lx(const LaneLight& light);

/// Smallest over mean, 0 to 1: 1 is even. Not measured of nothing and in the dark.
Value uniformity(const std::vector<double>& lx);

/// Mean illuminance from 5 to 15 m over that from 40 to 60 m, by `ahead_m`. Not measured where the grid does not reach or the distance is
/// dark.
Value foreground_ratio(const LaneLight& light);

/// d foreground_lx(), d foreground_ratio() and d uniformity() / d lx, by point. Where these are measured.
std::vector<double> foreground_shares(const LaneLight& light);
std::vector<double> foreground_ratio_shares(const LaneLight& light);
std::vector<double> uniformity_shares(const std::vector<double>& lx);

} // namespace fernlicht
