// Light baked once for lamps that do not move on their car: a map of the ground's illuminance, and a volume of lux, the founding thesis's
// 2-D and 3-D light maps. In the car's frame (x forward, y left, z up, origin on the road under the rear axle), lamps only, no sky.
// What the published techniques take for granted: the constants of their light, in the units of their pictures.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/drives/play/moment.h"

#include <algorithm>
#include <numbers>
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

/// lx[(up * left.cells + left) * ahead.cells + ahead]; rows from the right side (low y) to the left, layers from below upwards.
struct LightMap {
    LightMapAxis ahead, left, up; ///< up: of a map of the ground one cell about z = 0
    std::vector<float> lx;
    LightMapError error;
    std::size_t bytes() const { return lx.size() * sizeof(float); }
};

/// Illuminance of the plane z = 0 of the car's frame: E = sum of I cos(alpha) / d^2. A road that bends out of this plane is lit as if it
/// did not. Throws std::invalid_argument for an axis without cells or length.
LightMap bake_ground(const Moment& moment, const GroundMapExtent& extent = {});

/// Facing illuminance: the sum of I / d^2, d taken as 0.5 m at least, so that the pole in a lamp does not leak into the cells beside it.
/// 4 MiB as it stands. Throws as above.
LightMap bake_volume(const Moment& moment, const VolumeMapExtent& extent = {});

/// Linear look-up by hand at a point in the car's frame (of the ground at z = 0); the outermost texels hold in the half cell along the
/// edges, 0 beyond.
double mapped_lx(const LightMap& map, const glm::dvec3& point_m);

/// The brightest that one halogen headlamp gives (the founding thesis's table of maxima): white of the clamped techniques, and the share of
/// the lamps in the tone mapper's range.
inline constexpr double reference_light_lx = 100.0;
/// Daylight, of the same table; the moment's sky is the share `tod` of it.
inline constexpr double sun_max_lx = 27'000.0;
/// GL_LIGHT_MODEL_AMBIENT as OpenGL 1.x starts with: what the fixed pipeline shows at night.
inline constexpr double global_ambient = 0.2;
/// Retroreflecting at least so much (R_L in cd/(m2 lx)), a surface is sheeting of a sign, which glows in place of it.
inline constexpr double sheeting_rl = 10.0;
inline constexpr double emissive_reach_m = 500.0;
/// By how much `simplified` lowers its lamps: a cut-off 1 % down, 0.65 m above the road, then meets it at 25 m, where the beam's lux hold.
inline constexpr double lowered_rad = 0.92 * std::numbers::pi / 180.0;
/// Ends of the projection's depth, r/q = 1 - near / z (projected_beam.h).
inline constexpr double projection_near_m = 0.1;
/// Texels of a projected beam unless others are asked for.
inline constexpr BeamTexels projected_texels{1024, 512, 32};

inline double time_of_day(const Daylight& daylight) { return std::clamp(daylight.horizontal_illuminance_lx / sun_max_lx, 0.0, 1.0); }

/// L' = s L / (s L - L + L_max), L in lux.
struct RationalMapper {
    double l_max_lx = reference_light_lx, s = 20.0;
};

/// s is the drive's (20 where its mapper is another) for a night without sun. With the sun in L_max it grows by as much as L_max, so that
/// the dark end stays as steep: with the same s, 100 lx would come out as 7 % grey.
inline RationalMapper published_mapper(const ToneMapper& tone, bool sun) {
    const double s = tone.kind == ToneMapperKind::rational ? tone.s : 20.0;
    const double l_max_lx = reference_light_lx + (sun ? sun_max_lx : 0.0);
    return {l_max_lx, std::max(s * l_max_lx / reference_light_lx, 1.0)};
}

} // namespace fernlicht
