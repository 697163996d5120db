// What the published techniques take for granted: the constants of their light, in the units of their pictures.
#pragma once

#include "scenarios/drives/drive.h"

#include <algorithm>
#include <numbers>

namespace fernlicht {

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
