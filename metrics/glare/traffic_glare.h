// The lamps of other road users in the own driver's eyes.
#pragma once

#include "metrics/glare/eye_light.h"

namespace fernlicht {

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
