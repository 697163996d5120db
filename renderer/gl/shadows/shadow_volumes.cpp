#include "renderer/gl/shadows/shadow_volumes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <numeric>
#include <tuple>

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

glm::dvec3 lamp_in_frame(const Piece& piece, const glm::dvec3& lamp_world_m) {
    return glm::conjugate(turn_of(piece)) * (lamp_world_m - piece.origin_m);
}

Casting casting_of(const Piece& piece) {
    return !piece.ground ? Casting::fewest : piece.above_ground ? Casting::all : Casting::turned_away;
}

glm::vec4 as_it_stands(const glm::vec3& place) { return {place, 1.0F}; }
glm::vec4 at_infinity(const glm::vec3& place) { return {place, 0.0F}; }

} // namespace

Silhouettes::Silhouettes(const std::vector<glm::vec3>& corners) {
    std::map<std::tuple<float, float, float>, std::uint32_t> known_places;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known_edges;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        Triangle t;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& p = corners[i + k];
            const auto [it, fresh] = known_places.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(places_.size()));
            if (fresh)
                places_.push_back(p);
            t.corners[k] = it->second;
        }
        const glm::dvec3 a(corners[i]), b(corners[i + 1]), c(corners[i + 2]);
        t.normal = glm::cross(b - a, c - a);
        t.offset = -glm::dot(t.normal, a);
        if (t.normal == glm::dvec3(0.0))
            continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t.corners[k], to = t.corners[(k + 1) % 3];
            const auto [it, fresh] = known_edges.try_emplace(std::minmax(from, to), static_cast<std::uint32_t>(edges_.size()));
            if (fresh)
                edges_.push_back({std::min(from, to), std::max(from, to)});
            t.edges[k] = it->second;
            t.along[k] = from < to ? 1 : -1;
        }
        triangles_.push_back(t);
    }
    // Bodies: edges joined by triangles.
    std::vector<std::uint32_t> joined(edges_.size());
    std::iota(joined.begin(), joined.end(), 0U);
    const auto root = [&](std::uint32_t i) {
        while (joined[i] != i)
            i = joined[i] = joined[joined[i]];
        return i;
    };
    for (const Triangle& t : triangles_)
        for (const std::size_t k : {1U, 2U})
            joined[root(t.edges[k])] = root(t.edges[0]);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::map<std::uint32_t, std::uint32_t> numbers;
    std::vector<int> uneven(edges_.size(), 0);
    std::vector<std::uint32_t> body_of_edge(edges_.size(), 0);
    for (Triangle& t : triangles_) {
        const auto [it, fresh] = numbers.try_emplace(root(t.edges[0]), static_cast<std::uint32_t>(bodies_.size()));
        if (fresh)
            bodies_.push_back({true, glm::dvec3(infinity), glm::dvec3(-infinity)});
        t.body = it->second;
        for (std::size_t k = 0; k < 3; ++k) {
            uneven[t.edges[k]] += t.along[k];
            body_of_edge[t.edges[k]] = t.body;
            bodies_[t.body].low = glm::min(bodies_[t.body].low, glm::dvec3(places_[t.corners[k]]));
            bodies_[t.body].high = glm::max(bodies_[t.body].high, glm::dvec3(places_[t.corners[k]]));
        }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e)
        bodies_[body_of_edge[e]].closed = bodies_[body_of_edge[e]].closed && uneven[e] == 0;
    // Six times the volume, by tetrahedra from the middle of the box.
    std::vector<double> volumes(bodies_.size(), 0.0);
    for (const Triangle& t : triangles_) {
        const Body& body = bodies_[t.body];
        volumes[t.body] -= glm::dot(t.normal, 0.5 * (body.low + body.high)) + t.offset;
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const glm::dvec3 size = bodies_[i].high - bodies_[i].low;
        bodies_[i].closed = bodies_[i].closed && volumes[i] > -1e-9 * std::pow(glm::length(size), 3.0);
    }
}

std::size_t Silhouettes::closed_bodies() const {
    return static_cast<std::size_t>(std::ranges::count_if(bodies_, [](const Body& body) { return body.closed; }));
}

void Silhouettes::add_hulls(const glm::dvec3& lamp, Casting casting, const std::vector<bool>& casts,
                            std::vector<glm::vec4>& corners) const {
    // Of a closed body round the lamp, light meets backs alone.
    std::vector<bool> fronts_alone(bodies_.size(), false);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& body = bodies_[i];
        const bool within = glm::all(glm::lessThanEqual(body.low, lamp)) && glm::all(glm::lessThanEqual(lamp, body.high));
        fronts_alone[i] = casting == Casting::fewest && body.closed && !within;
    }
    std::vector<int> walls(edges_.size(), 0);
    for (const Triangle& t : triangles_) {
        if (!casts[t.body])
            continue;
        const double side = glm::dot(t.normal, lamp) + t.offset;
        if (side == 0.0 || (side < 0.0 && fronts_alone[t.body]) || (side > 0.0 && casting == Casting::turned_away))
            continue;
        const bool front = side > 0.0;
        const glm::vec3 &a = places_[t.corners[0]], &b = places_[t.corners[front ? 1 : 2]], &c = places_[t.corners[front ? 2 : 1]];
        corners.insert(corners.end(), {as_it_stands(a), as_it_stands(b), as_it_stands(c), at_infinity(c), at_infinity(b), at_infinity(a)});
        for (std::size_t k = 0; k < 3; ++k)
            walls[t.edges[k]] += front ? t.along[k] : -t.along[k];
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const glm::vec3 &a = places_[edges_[e][walls[e] > 0 ? 0 : 1]], &b = places_[edges_[e][walls[e] > 0 ? 1 : 0]];
        for (int k = std::abs(walls[e]); k > 0; --k)
            corners.insert(corners.end(),
                           {as_it_stands(b), as_it_stands(a), at_infinity(a), as_it_stands(b), at_infinity(a), at_infinity(b)});
    }
}

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
    const glm::dquat turn = turn_of(piece);
    std::vector<bool> casts;
    for (const Silhouettes::Body& body : silhouettes.bodies()) {
        const double radius = 0.5 * glm::length(body.high - body.low);
        const glm::dvec3 centre = piece.origin_m - ego_m() + turn * (0.5 * (body.low + body.high)), from_lamp = centre - casters.lamp_m;
        const double nearest = glm::length(from_lamp) - radius;
        const double max_cd = beams_[lamp]->bounds.max_towards(to_lamp_space(casters.lamp, from_lamp), radius);
        casts.push_back(nearest <= shadow_farthest_m && max_cd > 0.0 && (nearest <= 0.0 || max_cd >= last_contour_lx * nearest * nearest));
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
