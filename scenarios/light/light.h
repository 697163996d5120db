// Illuminance at a point by the lamps of a moment, from the candela tables themselves, in double: the ground that rendered
// lux images are measured against. The air takes its part. Knows no shadows;
// callers that need them bring their own visibility.
#pragma once

#include "scenarios/drives/play/moment.h"

namespace fernlicht {

/// Intensity in cd of the lamp towards a world point; 0 behind, outside its table, or switched off.
double intensity_towards_cd(const LitLamp& lamp, const glm::dvec3& point_m);

/// Of the uniform sky, and of sun or moon where one shines, on a surface of unit `normal`. lx.
double daylight_illuminance_lx(const Daylight& daylight, const glm::dvec3& normal);

/// E = I cos(alpha) / d^2 on a surface of unit `normal`, light of sky, sun and moon included. lx.
double surface_illuminance_lx(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal);

/// Sum over the lamps of I / d^2: a target that faces each lamp. lx. No sky. A lamp gives nothing at its own place.
double target_illuminance_lx(const Moment& moment, const glm::dvec3& point_m);

} // namespace fernlicht
