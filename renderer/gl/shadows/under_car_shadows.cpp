#include "renderer/gl/shadows/under_car_shadows.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>

namespace fernlicht::gl {
namespace {

/// What is dark reaches so far above and below the plane that the car stands on: over crests and dips of 50 m radius a plane that touches
/// the road leaves it by 0.1 m under a car 6 m long.
constexpr double dark_above_m = 0.3, dark_below_m = 0.3;

/// The hull between both heights, turned outwards.
void add_prism(const std::vector<glm::dvec2>& outline, std::vector<glm::vec4>& corners) {
    const auto at = [&](std::size_t i, double z) { return glm::vec4(glm::vec2(outline[i % outline.size()]), static_cast<float>(z), 1.0F); };
    const double low = -dark_below_m, high = dark_above_m;
    for (std::size_t i = 0; i < outline.size(); ++i)
        corners.insert(corners.end(), {at(i, low), at(i + 1, low), at(i + 1, high), at(i, low), at(i + 1, high), at(i, high)});
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        corners.insert(corners.end(), {at(0, high), at(i, high), at(i + 1, high), at(0, low), at(i + 1, low), at(i, low)});
}

} // namespace

std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
    const auto before = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
    std::ranges::sort(points, before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3)
        return points;
    const auto turns_left = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0.0;
    };
    std::vector<glm::dvec2> hull;
    const auto add_chain = [&](auto first, auto last) {
        const std::size_t start = hull.size();
        for (auto it = first; it != last; ++it) {
            while (hull.size() >= start + 2 && !turns_left(hull[hull.size() - 2], hull.back(), *it))
                hull.pop_back();
            hull.push_back(*it);
        }
        hull.pop_back(); // where the other chain begins
    };
    add_chain(points.begin(), points.end());
    add_chain(points.rbegin(), points.rend());
    return hull;
}

UnderCarShadows::UnderCarShadows(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, const ShadowUse& use)
    : ShadowMask(context, scene, settings, use), volumes_(context) {
    std::map<int, std::vector<std::uint32_t>> bodies;
    for (std::uint32_t i = 0; i < scene.pieces().size(); ++i)
        if (scene.pieces()[i].body >= 0)
            bodies[scene.pieces()[i].body].push_back(i);
    for (const auto& [body, pieces] : bodies) {
        Outline outline;
        outline.piece = pieces.front();
        outline.resting_m = scene.pieces()[pieces.front()].origin_m; // nothing is placed yet: in the body's frame
        std::vector<glm::dvec2> points;
        for (const std::uint32_t i : pieces)
            for (const glm::vec3& corner : scene.corners_of(scene.pieces()[i]))
                points.emplace_back(glm::dvec3(corner) + scene.pieces()[i].origin_m);
        outline.corners_m = convex_hull(std::move(points));
        for (const glm::dvec2& corner : outline.corners_m)
            outline.radius_m = std::max(outline.radius_m, glm::length(corner) + std::max(dark_above_m, dark_below_m));
        outlines_.push_back(std::move(outline));
    }
}

void UnderCarShadows::set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    set_lamps(lamps, ego_m);
    standing_.clear();
    const std::vector<std::uint32_t>& near = scene_.near(ego_m);
    for (std::size_t k = 0; k < outlines_.size(); ++k) {
        const Outline& outline = outlines_[k];
        const Piece& piece = scene_.pieces()[outline.piece];
        if (std::ranges::find(near, outline.piece) == near.end())
            continue;
        const glm::dvec3 place = piece.origin_m - turn_of(piece) * outline.resting_m - ego_m;
        for (std::size_t i = 0; i < lamps.size(); ++i)
            if (beams[i]->bounds.max_towards(to_lamp_space(lamps[i], place - (lamps[i].pose.position_m - ego_m)), outline.radius_m) > 0.0) {
                standing_.push_back({k, place});
                break;
            }
    }
}

bool UnderCarShadows::reach(const Piece& piece, double /*raised_m*/) const {
    return piece.ground && std::ranges::any_of(standing_, [&](const Standing& one) {
               return glm::length(centre_of(piece, ego_m()) - one.place_m) < piece.radius_m + outlines_[one.outline].radius_m;
           });
}

void UnderCarShadows::before_marking(const Shot& /*shot*/) {
    std::vector<glm::vec4> corners;
    for (const Standing& one : standing_)
        add_prism(outlines_[one.outline].corners_m, corners);
    volumes_.upload(corners);
}

/// A target above the polygon stands in the dark as the polygon does.
void UnderCarShadows::mark_hidden(const Shot& shot, std::size_t /*lamp*/, double /*raised_m*/) {
    volumes_.begin(shot.camera);
    StencilVolumes::Placed placed;
    for (const Standing& one : standing_) {
        const Piece& piece = scene_.pieces()[outlines_[one.outline].piece];
        const std::size_t n = outlines_[one.outline].corners_m.size();
        placed.offset_m = one.place_m;
        placed.turn = piece.turn;
        placed.count = 3 * (2 * n + (n < 3 ? 0 : 2 * (n - 2)));
        volumes_.draw(placed);
        placed.first += placed.count;
        ++shot.work.draws;
        shot.work.triangles += placed.count / 3;
    }
    volumes_.end();
}

} // namespace fernlicht::gl
