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

/// Points on surfaces, or raised from them along their normals: `lanes` may be read from any on.
struct BoundedPlaces {
    const double *x_m, *y_m, *z_m;
    const float *normal_x, *normal_y, *normal_z;
    float raised_m;
};

/// So many at once.
struct FoundBounds {
    static constexpr std::size_t count = 64;
    float low_lx[count], high_lx[count];
};

AT_EACH_LEVEL(void bound_surface_lx(const BoundedLight& light, float enough_lx, const BoundedPlaces& places, std::size_t count,
                                    FoundBounds& found);
              void bound_target_lx(const BoundedLight& light, const BoundedPlaces& places, std::size_t count, FoundBounds& found);)

} // namespace fernlicht::packs
