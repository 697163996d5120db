#include "renderer/merged_beam.h"

#include "scenarios/light/light.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace fernlicht {
namespace {

constexpr double exact_at_m = 25.0;
constexpr int window_steps = 32; // along each edge of a lamp's window

bool is_on(const LitLamp& lamp) { return lamp.intensity_factor > 0.0; }

glm::dvec3 unit_or_refuse(const glm::dvec3& sum, const char* axes) {
    if (glm::length(sum) < 1e-6)
        throw InputError({{}, 0, 0, "lamps"}, std::string("found lamps whose ") + axes + " cancel",
                         "lamps that can be merged into one beam");
    return glm::normalize(sum);
}

/// In the frame of `pose` the point 25 m from it that lies in `direction` from `lamp`. Lamps stand nearer than 25 m to their middle.
glm::dvec3 point_at_distance(const Pose& pose, const Pose& lamp, const glm::dvec3& direction) {
    const glm::dvec3 from = to_local(pose, lamp.position_m);
    const glm::dvec3 along = glm::normalize(direction * pose.axes);
    const double half = glm::dot(from, along);
    const double root = half * half + exact_at_m * exact_at_m - glm::dot(from, from);
    return from + along * (std::sqrt(std::max(root, 0.0)) - half);
}

/// `window` widened to the tangents of what the lamp's own window sees at 25 m.
void widen(TangentWindow& window, const Pose& pose, const LitLamp& lamp) {
    const TangentWindow own = lit_window(lamp.file->table);
    for (int i = 0; i <= window_steps; ++i)
        for (int k = 0; k <= window_steps; ++k) {
            const double x = own.left + (own.right - own.left) * i / window_steps;
            const double y = own.bottom + (own.top - own.bottom) * k / window_steps;
            const glm::dvec3 p = point_at_distance(pose, lamp.pose, lamp.pose.forward() - lamp.pose.left() * x + lamp.pose.up() * y);
            if (p.x <= 0.0)
                continue;
            window.left = std::min(window.left, -p.y / p.x);
            window.right = std::max(window.right, -p.y / p.x);
            window.bottom = std::min(window.bottom, p.z / p.x);
            window.top = std::max(window.top, p.z / p.x);
        }
}

TangentWindow window_of(std::span<const LitLamp> lamps, const Pose& pose) {
    const TangentWindow widest;
    TangentWindow window{widest.right, widest.left, widest.top, widest.bottom}; // nothing yet
    for (const LitLamp& lamp : lamps)
        if (is_on(lamp) && peak_of(lamp.file->table).cd > 0.0)
            widen(window, pose, lamp);
    window = {std::max(window.left, widest.left), std::min(window.right, widest.right), std::max(window.bottom, widest.bottom),
              std::min(window.top, widest.top)};
    return window.left < window.right && window.bottom < window.top ? window : widest;
}

} // namespace

Pose merged_pose(std::span<const LitLamp> lamps) {
    glm::dvec3 position(0.0), forward(0.0), up(0.0);
    int count = 0;
    for (const LitLamp& lamp : lamps) {
        if (!is_on(lamp))
            continue;
        ++count;
        position += (lamp.pose.position_m - position) / static_cast<double>(count);
        forward += lamp.pose.forward();
        up += lamp.pose.up();
    }
    if (count == 0)
        return {};
    Pose pose;
    pose.position_m = position;
    pose.axes[0] = unit_or_refuse(forward, "axes");
    pose.axes[1] = unit_or_refuse(glm::cross(up, pose.axes[0]), "upward axes");
    pose.axes[2] = glm::cross(pose.axes[0], pose.axes[1]);
    return pose;
}

ProjectedBeam make_merged_beam(std::span<const LitLamp> lamps, const BeamTexels& texels) {
    const Pose pose = merged_pose(lamps);
    Moment moment;
    for (const LitLamp& lamp : lamps)
        if (is_on(lamp)) {
            moment.lamps.push_back(lamp); // relative to the merged pose, where no map's millions of metres cost digits
            moment.lamps.back().pose = {to_local(pose, lamp.pose.position_m), glm::transpose(pose.axes) * lamp.pose.axes};
        }
    const TangentWindow window = window_of(moment.lamps, {});
    return sampled_beam(window, texels, [&](double x, double y) {
        return target_illuminance_lx(moment, exact_at_m * glm::normalize(glm::dvec3(1.0, -x, y)));
    });
}

} // namespace fernlicht
