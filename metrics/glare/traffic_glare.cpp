#include "metrics/glare/traffic_glare.h"

#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {

bool box_hides(const BodyBox& box, const Pose& pose, const glm::dvec3& from_m, const glm::dvec3& to_m) {
    const glm::dvec3 low(box.rear_m, -0.5 * box.size_m.y, 0.0), high(box.rear_m + box.size_m.x, 0.5 * box.size_m.y, box.size_m.z);
    const glm::dvec3 from = to_local(pose, from_m), way = to_local(pose, to_m) - from;
    double enter = 0.0, leave = 1.0; // Kay and Kajiya's slabs
    for (int axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0.0) {
            if (from[axis] < low[axis] || from[axis] > high[axis])
                return false;
            continue;
        }
        const double a = (low[axis] - from[axis]) / way[axis], b = (high[axis] - from[axis]) / way[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

std::vector<GlareSource> traffic_glare(const Moment& moment, const glm::dvec3& eye_m, const glm::dvec3& gaze,
                                       const std::vector<BodyBox>& boxes) {
    std::vector<GlareSource> sources;
    for (const LitLamp& lamp : moment.other_lamps) {
        const glm::dvec3 at_m = lamp.pose.position_m, to = at_m - eye_m;
        const double cd = intensity_towards_cd(lamp, eye_m), d2 = glm::dot(to, to);
        if (!(cd > 0.0) || !(d2 > 0.0))
            continue;
        bool hidden = false;
        for (std::size_t i = 0; i < moment.bodies.size() && i < boxes.size() && !hidden; ++i)
            hidden =
                moment.bodies[i].visible && static_cast<int>(i) != lamp.body && box_hides(boxes[i], moment.bodies[i].pose, eye_m, at_m);
        const GlareSource source = glare_source({lamp.name, at_m, cd / d2, std::sqrt(d2)}, eye_m, gaze);
        if (!hidden && source.eye_lx > 0.0)
            sources.push_back(source);
    }
    return sources;
}

} // namespace fernlicht
