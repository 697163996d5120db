#include "scenarios/values/pose.h"

#include <cmath>

namespace fernlicht {

glm::dmat3 axes_from_angles(double yaw_rad, double pitch_rad, double roll_rad) {
    const double cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
    const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
    const double cr = std::cos(roll_rad), sr = std::sin(roll_rad);
    // Rz(yaw) * Ry(-pitch) * Rx(roll), written out by columns.
    const glm::dvec3 forward{cy * cp, sy * cp, sp};
    const glm::dvec3 left{-sy * cr - cy * sp * sr, cy * cr - sy * sp * sr, cp * sr};
    const glm::dvec3 up{sy * sr - cy * sp * cr, -cy * sr - sy * sp * cr, cp * cr};
    return {forward, left, up};
}

} // namespace fernlicht
