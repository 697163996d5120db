// Positions and attitudes. World: right-handed, x forward/east, y left/north, z up, metres, double.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace fernlicht {

/// A frame in its parent: columns of `axes` are forward (x), left (y) and up (z), orthonormal.
struct Pose {
    glm::dvec3 position_m{0.0};
    glm::dmat3 axes{1.0};

    const glm::dvec3& forward() const { return axes[0]; }
    const glm::dvec3& left() const { return axes[1]; }
    const glm::dvec3& up() const { return axes[2]; }

    bool operator==(const Pose&) const = default;
};

/// Child in parent: a point p in `child` lies at parent.position + parent.axes * p.
inline glm::dvec3 to_parent(const Pose& frame, const glm::dvec3& point) { return frame.position_m + frame.axes * point; }
inline glm::dvec3 to_local(const Pose& frame, const glm::dvec3& point) {
    return (point - frame.position_m) * frame.axes; // row vector times axes = transpose(axes) * vector
}
inline Pose compose(const Pose& parent, const Pose& child) { return {to_parent(parent, child.position_m), parent.axes * child.axes}; }

/// Yaw turns left (about z), then pitch raises the nose (about -y), then roll lifts the left side (about x). Radians.
/// Pitch is positive upwards: a lamp aimed 1 % down has pitch_rad = -atan(0.01).
glm::dmat3 axes_from_angles(double yaw_rad, double pitch_rad, double roll_rad);

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double radians(double degrees) { return degrees * (pi / 180.0); }
inline constexpr double degrees(double radians) { return radians * (180.0 / pi); }

} // namespace fernlicht
