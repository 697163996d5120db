// Light of lamps in a homogeneous medium: what reaches a surface, and what is scattered to the eye on the way. In double.
#pragma once

#include "scenarios/drives/play/moment.h"

namespace fernlicht {

/// Share of a lamp's light that is left after a way of `distance_m` >= 0 through the weather; exactly 1 in clear air.
double air_transmittance(const Weather& weather, double distance_m);

/// Single scattering: luminance in cd/m2 that the medium between eye and point gives towards the eye by the light of this lamp, with the
/// extinction of both ways (Henyey-Greenstein's phase function; photometry.glsl, scattered_towards_eye). Equi-angular midpoints, doubled in
/// number until the sum moves twice by less than `relative` (at most 65 536). Obstacles between lamp and medium are not seen. The lamp
/// counts as 1 mm away from a ray that passes through it.
double airlight_cdm2(const LitLamp& lamp, const Weather& weather, const glm::dvec3& eye_m, const glm::dvec3& point_m,
                     double relative = 1e-4);

/// The same by a fixed number of midpoints, at the places where the shader has them.
double airlight_cdm2(const LitLamp& lamp, const Weather& weather, const glm::dvec3& eye_m, const glm::dvec3& point_m, int samples);

/// What a drawing may leave out of one lamp of others seen in the air: as much as `min_lx` gives a surface of reflectance 0.1.
inline double min_airlight_cdm2(double min_lx) { return 0.1 * min_lx / 3.14159265358979323846; }

/// Luminance of the uniform sky before which the medium hides a surface: what comes in its place, L_sky (1 - transmittance).
double sky_airlight_cdm2(const Daylight& daylight, const Weather& weather, double distance_m);

} // namespace fernlicht
