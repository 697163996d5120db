#include "renderer/gl/shadows/shadow_volumes.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace fernlicht::gl {
namespace {

/// A body's shadow begins so far behind its front, along the light: its front and the hull's, which are the same triangles, differ in depth
/// by more than a float of reversed depth rounds, so that a front is never taken to lie behind itself.
constexpr double gap_m = 1e-3, gap_share = 1e-4;

/// Hulls of ground, whose triangles turned away are fronts and receivers at once, lie lower by this: what grazing ground hides lower than
/// that is lost, and from a fifth of it on pictures of a road from above begin to shade themselves.
constexpr double ground_lowered_m = 5e-4;

/// Silhouettes that no picture has asked for this long are dropped.
constexpr std::size_t kept_for_pictures = 64;

glm::dquat turn_of_mesh(const Piece& piece) {
    return {static_cast<double>(piece.turn.w), static_cast<double>(piece.turn.x), static_cast<double>(piece.turn.y),
            static_cast<double>(piece.turn.z)};
}

glm::dvec3 lamp_in_frame(const Piece& piece, const glm::dvec3& lamp_world_m) {
    return glm::conjugate(turn_of_mesh(piece)) * (lamp_world_m - piece.origin_m);
}

Casting casting_of(const Piece& piece) {
    return !piece.ground ? Casting::fewest : piece.above_ground ? Casting::all : Casting::turned_away;
}

} // namespace

ShadowVolumes::ShadowVolumes(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, const ShadowUse& use)
    : ShadowMask(context, scene, settings, use), volumes_(context) {}

const Silhouettes& ShadowVolumes::silhouettes_of(const Pieces& pieces) {
    if (const auto known = silhouettes_.find(pieces); known != silhouettes_.end()) {
        known->second.used = pictures_;
        return known->second.silhouettes;
    }
    std::vector<glm::vec3> corners;
    for (const std::uint32_t i : pieces) {
        const std::vector<glm::vec3> more = scene_.corners_of(scene_.pieces()[i]);
        corners.insert(corners.end(), more.begin(), more.end());
    }
    return silhouettes_.emplace(pieces, Kept{Silhouettes(corners), pictures_}).first->second.silhouettes;
}

void ShadowVolumes::set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    ShadowMask::set(lamps, beams, ego_m);
    beams_ = beams;
}

/// As ShadowCasters chooses pieces, body by body of a mesh: in the lit part of the beam, where its last contour is.
std::vector<bool> ShadowVolumes::casting_bodies(const Silhouettes& silhouettes, const Piece& piece, std::size_t lamp) const {
    const LampCasters& casters = casters_.lamps()[lamp];
    const Frustum frustum(casters.clip);
    const glm::dquat turn = turn_of_mesh(piece);
    std::vector<bool> casts;
    for (const Silhouettes::Body& body : silhouettes.bodies()) {
        const double radius = 0.5 * glm::length(body.high - body.low);
        const glm::dvec3 centre = piece.origin_m - ego_m() + turn * (0.5 * (body.low + body.high)), from_lamp = centre - casters.lamp_m;
        const double nearest = glm::length(from_lamp) - radius;
        const double most_cd = beams_[lamp]->bounds.most_towards(to_lamp_space(casters.lamp, from_lamp), radius);
        casts.push_back(nearest <= shadow_farthest_m && !frustum.outside(centre, radius) && most_cd > 0.0 &&
                        (nearest <= 0.0 || most_cd >= last_contour_lx * nearest * nearest));
    }
    return casts;
}

/// Hulls stay as they are while lamp and mesh stand to each other as they did.
void ShadowVolumes::before_marking(const Shot& shot) {
    shot.clock.begin("shadow volumes: silhouettes");
    bool changed = false;
    ++pictures_;
    hulls_.resize(casters_.lamps().size());
    for (std::size_t lamp = 0; lamp < hulls_.size(); ++lamp) {
        const LampCasters& casters = casters_.lamps()[lamp];
        std::vector<Hulls> before = std::exchange(hulls_[lamp], {});
        for (std::size_t i = 0; i < casters.pieces.size();) {
            Hulls hulls;
            const Piece& piece = scene_.pieces()[casters.pieces[i]];
            for (; i < casters.pieces.size() && scene_.pieces()[casters.pieces[i]].mesh == piece.mesh &&
                   casting_of(scene_.pieces()[casters.pieces[i]]) == casting_of(piece);
                 ++i)
                hulls.pieces.push_back(casters.pieces[i]);
            hulls.lamp_m = lamp_in_frame(piece, casters.lamp.pose.position_m);
            const Silhouettes& silhouettes = silhouettes_of(hulls.pieces);
            hulls.casts = casting_bodies(silhouettes, piece, lamp);
            const auto same = std::ranges::find_if(before, [&](const Hulls& old) {
                return old.pieces == hulls.pieces && old.lamp_m == hulls.lamp_m && old.casts == hulls.casts;
            });
            if (same != before.end()) {
                hulls.corners = std::move(same->corners);
                hulls.first = same->first;
            } else {
                silhouettes.add_hulls(hulls.lamp_m, casting_of(piece), hulls.casts, hulls.corners);
                changed = true;
            }
            hulls_[lamp].push_back(std::move(hulls));
        }
    }
    if (changed) {
        std::vector<glm::vec4> all;
        for (std::vector<Hulls>& of_lamp : hulls_)
            for (Hulls& hulls : of_lamp) {
                hulls.first = all.size();
                all.insert(all.end(), hulls.corners.begin(), hulls.corners.end());
            }
        volumes_.upload(all);
    }
    std::erase_if(silhouettes_,
                  [&](const auto& kept) { return kept.second.used + kept_for_pictures < pictures_; }); // a long drive passes many
    shot.clock.end();
}

void ShadowVolumes::mark_hidden(const Shot& shot, std::size_t lamp, double raised_m) {
    volumes_.begin(shot.camera);
    for (const Hulls& hulls : hulls_[lamp]) {
        if (hulls.corners.empty())
            continue;
        const Piece& piece = scene_.pieces()[hulls.pieces.front()];
        StencilVolumes::Placed placed;
        placed.offset_m = piece.origin_m - ego_m();
        placed.turn = piece.turn;
        placed.lamp_m = casters_.lamps()[lamp].lamp_m;
        placed.gap_m = piece.ground ? 0.0 : gap_m;
        placed.gap_share = piece.ground ? 0.0 : gap_share;
        placed.lowered_m = raised_m + (piece.ground ? ground_lowered_m : 0.0);
        placed.first = hulls.first;
        placed.count = hulls.corners.size();
        volumes_.draw(placed);
        shot.work.triangles += placed.count / 3;
        ++shot.work.draws;
    }
    volumes_.end();
}

} // namespace fernlicht::gl
