#include "renderer/gl/shadows/warped_maps.h"
#include "renderer/gl/shadows/map_warp.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fernlicht::gl {
namespace {

constexpr double widest_warped_texel = 2.0; // of the plain map's

} // namespace

std::vector<MapPlan> WarpedMaps::plan(const Shot& shot) {
    const glm::dvec3 ego_m = casters_.ego_m();
    const Camera eye = eye_ ? camera_of(shot.moment, *eye_) : shot.camera;
    std::vector<Corners> boxes; // of all that can be seen, whether it is lit or not: pruning must not change the fit
    if (!eye.is_map && !shot.wanted.target) {
        const Frustum frustum(eye.clip_from_ego);
        for (const std::uint32_t k : scene_.near(ego_m)) {
            const Piece& piece = scene_.pieces()[k];
            if (frustum.outside(centre_of(piece, ego_m), piece.radius_m))
                continue;
            boxes.push_back(piece.corners_m);
            for (glm::dvec3& corner : boxes.back())
                corner += piece.origin_m - ego_m;
        }
    }
    std::vector<MapPlan> plans;
    for (std::size_t i = 0; i < casters_.lamps().size(); ++i) {
        const LampCasters& lamp = casters_.lamps()[i];
        plans.push_back(plain(lamp));
        MapPlan& plan = plans.back();
        const std::vector<glm::dvec3> seen = seen_in_beam(boxes, eye, lamp.lamp, lamp.lamp_m, lamp.window, shadow_slack_m);
        if (seen.empty())
            continue;
        const double plain_raise = most_raise_tangent(plan.texture_from_lamp, plan.spread, seen);
        const auto take = [&](const std::optional<glm::dmat3>& warp, double widest) {
            const auto fit = warp ? fitted(*warp, seen, settings_.width, settings_.height, shadow_slack_m) : std::nullopt;
            if (!fit)
                return false;
            const double spread = spread_of(*fit, settings_.width, settings_.height), raise = most_raise_tangent(*fit, spread, seen);
            if (raise > widest * plain_raise)
                return false;
            plan.texture_from_lamp = *fit;
            plan.spread = spread;
            plan.to_cover = seen;
            plan.most_raise = raise;
            return true;
        };
        const auto warp = warp_ == Warp::perspective ? perspective_warp(seen, eye, lamp.lamp, lamp.lamp_m)
                                                     : light_space_warp(seen, eye, lamp.lamp, lamp.lamp_m);
        if (take(warp, widest_warped_texel) || take(glm::dmat3(1.0), 1.0))
            casters_.widen(i, shadow_kept_slack * 2.0 * std::max(0.0, plan.most_raise - plain_raise));
    }
    return plans;
}

} // namespace fernlicht::gl
