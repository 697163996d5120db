// Light baked once for lamps that do not move on their car: a map of the ground's illuminance, and a volume of lux, the founding thesis's
// 2-D and 3-D light maps. In the car's frame (x forward, y left, z up, origin on the road under the rear axle), lamps only, no sky.
#pragma once

#include "scenarios/drives/play/moment.h"

#include <optional>

namespace fernlicht {

/// One axis of a map: texel i at u = (i + 0.5) / cells, where the axis is at from + (to - from) (growth^u - 1) / (growth - 1). The last
/// cell is about `growth` times as long as the first; 1: all alike.
struct LightMapAxis {
    double from_m = 0.0, to_m = 1.0;
    int cells = 1;
    double growth = 1.0;
};
double position_m(const LightMapAxis& axis, double u); ///< u in 0..1
double texture_coordinate(const LightMapAxis& axis,
                          double at_m); ///< the inverse: u = ln(1 + (at - from)/(to - from) (growth - 1)) / ln growth

/// How far the linear look-up between texels lies from the light itself, sampled midway between neighbouring texels on all axes.
struct LightMapError {
    double worst_lx = 0.0;
    std::optional<double>
        p95_relative; ///< 95 % of the samples with at least 1 lx are nearer to it than this share; nullopt: there are none
};

/// Cells are 0.2 m wide and 0.04 m long at the car, 0.09 m at 10 m, 0.3 m at 50 m, 0.6 m at the end: seen from a lamp 0.65 m high and 3.5 m
/// ahead of the origin, 0.08 degrees at 10 m and 0.005 at 50 m, across the cut-off. Our halogen low beams lose 0.4 % (p95) to it.
struct GroundMapExtent {
    LightMapAxis ahead{0.0, 100.0, 512, 16.0}, left{-25.0, 25.0, 256, 1.0};
};

/// Cells are 0.4 m wide, 0.25 m high, and 0.1 m long at the car, 0.9 m at 100 m. Up to 57 m ahead of a lamp its cut-off, 0.25 degrees of
/// it, is thinner than a cell, and blurred: our halogen low beams lose 12 % (p95) to it.
struct VolumeMapExtent {
    LightMapAxis ahead{0.0, 100.0, 256, 8.0}, left{-25.0, 25.0, 128, 1.0}, up{-2.0, 6.0, 32, 1.0};
};

/// lx[left * ahead.cells + ahead]; rows from the right side (low y) to the left.
struct LightMap2d {
    LightMapAxis ahead, left;
    std::vector<float> lx;
    LightMapError error;
    std::size_t bytes() const { return lx.size() * sizeof(float); }
};

/// lx[(up * left.cells + left) * ahead.cells + ahead]; layers from below upwards.
struct LightMap3d {
    LightMapAxis ahead, left, up;
    std::vector<float> lx;
    LightMapError error;
    std::size_t bytes() const { return lx.size() * sizeof(float); }
};

/// Illuminance of the plane z = 0 of the car's frame: E = sum of I cos(alpha) / d^2. A road that bends out of this plane is lit as if it
/// did not. Throws std::invalid_argument for an axis without cells or length.
LightMap2d bake_ground(const Moment& moment, const GroundMapExtent& extent = {});

/// Facing illuminance: the sum of I / d^2, d taken as 0.5 m at least, so that the pole in a lamp does not leak into the cells beside it.
/// 4 MiB as it stands. Throws as above.
LightMap3d bake_volume(const Moment& moment, const VolumeMapExtent& extent = {});

/// Linear look-up by hand at a point in the car's frame; the outermost texels hold in the half cell along the edges, 0 beyond.
double mapped_lx(const LightMap2d& map, double ahead_m, double left_m);
double mapped_lx(const LightMap3d& map, const glm::dvec3& point_m);

} // namespace fernlicht
