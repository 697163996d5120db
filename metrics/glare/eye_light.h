// The lamps of a moment as an eye, a mirror or a sensor meets them, from the candela tables in double (scenarios/light/light.h).
// The lamps of other road users in the own driver's eyes.
#pragma once

#include "metrics/glare/glare.h"
#include "scenarios/drives/play/moment.h"

namespace fernlicht {

/// One lamp seen from a point.
struct SeenLamp {
    std::string name;
    glm::dvec3 position_m{0.0};
    double facing_lx = 0.0; ///< I / d^2, on a plane that faces the lamp
    double distance_m = 0.0;
};

/// Every lamp of the moment, also those that give nothing. A lamp at the point itself gives nothing (scenarios/light/light.h).
std::vector<SeenLamp> seen_lamps(const Moment& moment, const glm::dvec3& point_m);

/// Sum of I / d^2, lx.
double facing_lx(const std::vector<SeenLamp>& lamps);

/// Across the line of sight `gaze` (unit): E = I cos(theta) / d^2, nothing from behind the eye.
GlareSource glare_source(const SeenLamp& lamp, const glm::dvec3& eye_m, const glm::dvec3& gaze);

/// The lamp in a plane mirror that is turned so that the eye sees the lamp in it: light goes on as from an image as far behind the mirror
/// as the lamp is before it. `lamp` seen from the mirror.
GlareSource mirrored_source(const SeenLamp& lamp, const glm::dvec3& mirror_m, double reflectance, const glm::dvec3& eye_m,
                            const glm::dvec3& gaze);

/// Angle between two directions in degrees, well-conditioned near 0.
double angle_between_deg(const glm::dvec3& a, const glm::dvec3& b);

/// True where the paved road between two distances along the route rises above the straight line from `from` to `to`: a crest that hides a
/// lamp. Looked at every 2 m; a crest of 1000 m radius stands 0.5 mm out between two such places. Ground beside the pavement, trees and
/// houses are not asked.
bool road_hides(const Route& route, double from_m, double to_m, const glm::dvec3& from, const glm::dvec3& to);

/// What stands round a body, in its frame: length along x from rear_m, width about y = 0, height from the ground.
struct BodyBox {
    glm::dvec3 size_m{0.0};
    double rear_m = 0.0;
};

/// True where the segment between two world points meets the box of a body that stands at `pose`.
bool box_hides(const BodyBox& box, const Pose& pose, const glm::dvec3& from_m, const glm::dvec3& to_m);

/// Every lamp of others that brings light to an eye that looks along `gaze` (unit), less those that the box of another visible body hides;
/// `boxes` by body. A lamp's own body hides nothing of it: its table says where it shines.
std::vector<GlareSource> traffic_glare(const Moment& moment, const glm::dvec3& eye_m, const glm::dvec3& gaze,
                                       const std::vector<BodyBox>& boxes);

} // namespace fernlicht
