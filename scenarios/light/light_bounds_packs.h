// Light bounds over packs: what light_bounds.cpp hands to its arithmetic, as plain numbers.
#pragma once

#include "scenarios/packs/level.h"

#include <cstdint>

namespace fernlicht::packs {

/// Buckets of equal width over an axis of a table: in each the position between samples is start + per_rad times the angle from first_rad
/// on.
struct BeamAxis {
    float first_rad, span_rad, buckets_per_rad, error_rad; ///< error_rad: of the angle and of what the buckets make of it
    const float* start_and_per_rad;
    std::int32_t last_bucket, last_cell;
};

struct BoundedLamp {
    double position_m[3];
    float right[3], up[3], forward[3];
    float factor;
    float peak_cd, error_cd; ///< of the table; error_cd: of the intensity found for an angle that is off by error_rad
    const float* cd;
    std::int32_t columns;
    BeamAxis h, v;
};

struct BoundedLight {
    const BoundedLamp* lamps;
    std::size_t lamp_count;
    float extinction_per_m;
    float sky_lx, direct_lx, direct_towards[3];
};

/// So many points at once. No normals: targets that face each lamp.
struct BoundedPoints {
    static constexpr std::size_t count = 64;
    double x_m[count], y_m[count], z_m[count];
    float normal_x[count], normal_y[count], normal_z[count];
    float low_lx[count], high_lx[count];
};

AT_EACH_LEVEL(void bound_surface_lx(const BoundedLight& light, float enough_lx, std::size_t count, BoundedPoints& points);
              void bound_target_lx(const BoundedLight& light, std::size_t count, BoundedPoints& points);)

} // namespace fernlicht::packs
