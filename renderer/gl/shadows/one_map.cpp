#include "renderer/gl/shadows/one_map.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fernlicht::gl {
namespace {

/// What lies nearer and at the side of a beam may be lit for want of texels: to hold it too would take texels from all the rest.
constexpr double one_map_from_m = 3.0;
/// 72 degrees: of a lamp that looks elsewhere, such as a cornering lamp, only so much is in the map.
constexpr double one_map_widest_tangent = 3.0;

} // namespace

LitLamp midway(const std::vector<LitLamp>& lamps) {
    LitLamp between = lamps.front();
    glm::dvec3 place(0.0), forward(0.0), up(0.0);
    double count = 0.0;
    for (const LitLamp& lamp : lamps)
        if (lamp.intensity_factor > 0.0) {
            place += lamp.pose.position_m - lamps.front().pose.position_m;
            forward += lamp.pose.forward();
            up += lamp.pose.up();
            count += 1.0;
        }
    if (count == 0.0)
        return between;
    between.name = "midway";
    between.intensity_factor = 1.0;
    between.pose.position_m += place / count;
    if (glm::length(forward) > 0.1 * count && glm::length(glm::cross(up, forward)) > 0.1 * glm::length(forward)) {
        forward = glm::normalize(forward);
        const glm::dvec3 left = glm::normalize(glm::cross(up, forward));
        between.pose.axes = {forward, left, glm::cross(forward, left)};
    }
    return between;
}

ShadowWindow window_over(const LitLamp& from, const std::vector<LitLamp>& lamps, const std::vector<ShadowWindow>& windows, double from_m) {
    ShadowWindow over{1.0, -1.0, 1.0, -1.0};
    bool first = true;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        if (lamps[i].intensity_factor <= 0.0)
            continue;
        const Pose& pose = lamps[i].pose;
        for (const double x : {windows[i].left, windows[i].right})
            for (const double y : {windows[i].bottom, windows[i].top})
                for (const double distance : {from_m, shadow_farthest_m}) { // in between the tangents lie in between
                    const glm::dvec3 p =
                        pose.position_m + distance * (pose.forward() - x * pose.left() + y * pose.up()) - from.pose.position_m;
                    const glm::dvec3 q = to_lamp_space(from, p);
                    const auto tangent = [&](double along) {
                        return std::clamp(along / std::max(q.z, 1e-3), -one_map_widest_tangent, one_map_widest_tangent);
                    };
                    const glm::dvec2 t(tangent(q.x), tangent(q.y));
                    over = first ? ShadowWindow{t.x, t.x, t.y, t.y}
                                 : ShadowWindow{std::min(over.left, t.x), std::max(over.right, t.x), std::min(over.bottom, t.y),
                                                std::max(over.top, t.y)};
                    first = false;
                }
    }
    return over;
}

void OneMap::choose_casters(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    ProjectedMaps::choose_casters(lamps, beams, ego_m);
    if (std::ranges::none_of(lamps, [](const LitLamp& lamp) { return lamp.intensity_factor > 0.0; }))
        return;
    std::vector<ShadowWindow> windows;
    for (const Beam* const beam : beams)
        windows.push_back(beam->window);
    const LitLamp from = midway(lamps);
    casters_.merge(from, window_over(from, lamps, windows, one_map_from_m));
}

std::vector<Program::Define> OneMap::defines(const std::vector<const Beam*>& beams) const {
    std::vector<Program::Define> defines = ProjectedMaps::defines(beams);
    defines.push_back({"SHADOW_ONE_MAP", "1"});
    return defines;
}

} // namespace fernlicht::gl
