#include "renderer/gl/shadows/shadow_casters.h"

#include "renderer/gl/scene/draw_list.h"
#include "scenarios/drives/play/camera.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <optional>

namespace fernlicht::gl {
namespace {

constexpr double margin_m = shadow_slack_m; // look-ups are raised by the tolerance at least
constexpr double tangents_from_m = 0.1;

} // namespace

Corners in_lamp_space(const LitLamp& lamp, const glm::dvec3& offset_from_lamp, const Corners& corners) {
    Corners out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = to_lamp_space(lamp, offset_from_lamp + corners[i]);
    return out;
}

Caster caster_of(const Corners& box, double margin) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Caster caster{infinity, -infinity, infinity, -infinity, infinity, false};
    for (const glm::dvec3& corner : box) {
        caster.around = caster.around || corner.z < tangents_from_m;
        caster.left = std::min(caster.left, corner.x / corner.z - margin);
        caster.right = std::max(caster.right, corner.x / corner.z + margin);
        caster.bottom = std::min(caster.bottom, corner.y / corner.z - margin);
        caster.top = std::max(caster.top, corner.y / corner.z + margin);
        caster.nearest_m = std::min(caster.nearest_m, corner.z - margin_m);
    }
    return caster;
}

double begins_in_window(const std::vector<glm::dvec3>& triangles, const ShadowWindow& w) {
    const std::array<glm::dvec4, 5> inside{glm::dvec4(0.0, 0.0, 1.0, -shadow_near_m), glm::dvec4(1.0, 0.0, -w.left, 0.0),
                                           glm::dvec4(-1.0, 0.0, w.right, 0.0), glm::dvec4(0.0, 1.0, -w.bottom, 0.0),
                                           glm::dvec4(0.0, -1.0, w.top, 0.0)};
    double nearest = std::numeric_limits<double>::infinity();
    std::vector<glm::dvec3> polygon, cut;
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        polygon.assign({triangles[i], triangles[i + 1], triangles[i + 2]});
        for (const glm::dvec4& plane : inside) {
            const auto above = [&](const glm::dvec3& p) { return glm::dot(glm::dvec3(plane), p) + plane.w; };
            cut.clear();
            for (std::size_t k = 0; k < polygon.size(); ++k) {
                const glm::dvec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
                const double at_a = above(a), at_b = above(b);
                if (at_a >= 0.0)
                    cut.push_back(a);
                if ((at_a >= 0.0) != (at_b >= 0.0))
                    cut.push_back(a + (b - a) * (at_a / (at_a - at_b)));
            }
            std::swap(polygon, cut);
        }
        for (const glm::dvec3& p : polygon)
            nearest = std::min(nearest, p.z);
    }
    return nearest;
}

// The part of the box that lies beyond the caster's front against the frustum behind the caster: apart, where all of it is on the far side
// of one of the frustum's planes.
bool shades(const Caster& caster, const Corners& box, double slack_m) {
    if (caster.around)
        return true;
    std::array<glm::dvec3, 20> points; // corners beyond the front, and where edges cross it
    std::size_t count = 0;
    const double front = std::max(caster.nearest_m, tangents_from_m);
    for (std::size_t i = 0; i < box.size(); ++i) {
        if (box[i].z >= front)
            points[count++] = box[i];
        for (const std::size_t axis : {1U, 2U, 4U})
            if (const std::size_t k = i | axis; k != i && (box[i].z < front) != (box[k].z < front))
                points[count++] = box[i] + (box[k] - box[i]) * ((front - box[i].z) / (box[k].z - box[i].z));
    }
    const auto all = [&](auto outside) {
        for (std::size_t i = 0; i < count; ++i)
            if (!outside(points[i]))
                return false;
        return true;
    };
    return !(all([&](const glm::dvec3& p) { return p.x < caster.left * p.z - slack_m; }) ||
             all([&](const glm::dvec3& p) { return p.x > caster.right * p.z + slack_m; }) ||
             all([&](const glm::dvec3& p) { return p.y < caster.bottom * p.z - slack_m; }) ||
             all([&](const glm::dvec3& p) { return p.y > caster.top * p.z + slack_m; }));
}

glm::dmat4 lamp_clip(const LitLamp& lamp, const ShadowWindow& w, const glm::dvec3& ego_m) {
    return tangent_projection(w.left, w.right, w.bottom, w.top, shadow_near_m) * lamp_from_ego(lamp.pose, ego_m);
}

double texel_tangent(const ShadowWindow& window, const ShadowSettings& settings) {
    return std::max((window.right - window.left) / (settings.width - 2), (window.top - window.bottom) / (settings.height - 2));
}

bool faces_lamp(const SceneBuffers& scene, const Piece& piece, const glm::dvec3& lamp_m, const glm::dvec3& ego_m) {
    const glm::vec3 lamp(lamp_m + ego_m - piece.origin_m);
    const auto first = scene.planes().begin() + static_cast<std::ptrdiff_t>(piece.first_plane);
    return std::all_of(first, first + static_cast<std::ptrdiff_t>(piece.planes),
                       [&](const glm::vec4& plane) { return glm::dot(glm::vec3(plane), lamp) + plane.w > 0.0F; });
}

ShadowCasters::ShadowCasters(const SceneBuffers& scene, const ShadowSettings& settings)
    : scene_(scene), settings_(settings), windowed_(settings.method != ShadowMethod::planar && settings.method != ShadowMethod::volumes) {}

void ShadowCasters::set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    ego_m_ = ego_m;
    lamps_.clear();
    constexpr std::size_t max_read = 4096;
    if (corners_.size() > max_read) // a long drive passes many
        corners_.clear();
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        LampCasters found;
        found.lamp = lamps[i];
        found.lamp_m = lamps[i].pose.position_m - ego_m;
        found.window = beams[i]->window;
        found.clip = lamp_clip(lamps[i], found.window, ego_m);
        const Frustum frustum(found.clip);
        for (const std::uint32_t k : scene_.near(ego_m)) {
            const Piece& piece = scene_.pieces()[k];
            const glm::dvec3 from_lamp = centre_of(piece, ego_m) - found.lamp_m;
            const double distance = glm::length(from_lamp), nearest = distance - piece.radius_m;
            if (nearest > shadow_farthest_m || (windowed_ && frustum.outside(centre_of(piece, ego_m), piece.radius_m)))
                continue;
            if (!piece.casts || (piece.ground && !piece.above_ground && faces_lamp(scene_, piece, found.lamp_m, ego_m)))
                continue;
            const double max_cd = beams[i]->bounds.max_towards(to_lamp_space(lamps[i], from_lamp), piece.radius_m);
            if (max_cd == 0.0 || (nearest > 0.0 && max_cd < last_contour_lx * nearest * nearest))
                continue;
            found.pieces.push_back(k);
            found.ground = found.ground || piece.ground;
        }
        add_bodies(found);
        lamps_.push_back(std::move(found));
    }
}

double ShadowCasters::begins_in(const LampCasters& lamp, std::uint32_t piece, const ShadowWindow& window) {
    const Piece& of = scene_.pieces()[piece];
    auto known = corners_.find(piece);
    if (known == corners_.end())
        known = corners_.emplace(piece, scene_.corners_of(of)).first;
    std::vector<glm::dvec3> triangles;
    for (const glm::vec3& corner : known->second)
        triangles.push_back(to_lamp_space(lamp.lamp, of.origin_m - ego_m_ - lamp.lamp_m + turn_of(of) * glm::dvec3(corner)));
    return begins_in_window(triangles, window);
}

/// Bodies beside and behind the lamp have the window's tangents, and begin where they do in the window: what a map may be kept for.
void ShadowCasters::add_bodies(LampCasters& found) {
    const double margin = caster_margin_texels * texel_tangent(found.window, settings_),
                 more = margin + 2.0 * settings_.redraw_texels * texel_tangent(found.window, settings_);
    ShadowWindow window = found.window;
    gl::widen(window, more);
    for (const std::uint32_t k : found.pieces) {
        std::optional<double> begins_m;
        for (const Corners& body : scene_.pieces()[k].bodies_m) {
            const glm::dvec3 offset = scene_.pieces()[k].origin_m - ego_m_ - found.lamp_m;
            Caster caster = caster_of(in_lamp_space(found.lamp, offset, body), margin);
            if (caster.around && windowed_ && settings_.redraw_texels > 0.0) {
                if (!begins_m)
                    begins_m = begins_in(found, k, window);
                caster = {window.left, window.right, window.bottom, window.top, *begins_m - margin_m, true};
            }
            found.bodies.push_back(caster);
        }
    }
}

void ShadowCasters::merge(const LitLamp& lamp, const ShadowWindow& window) {
    LampCasters one;
    one.lamp = lamp;
    one.lamp_m = lamp.pose.position_m - ego_m_;
    one.window = window;
    one.clip = lamp_clip(lamp, window, ego_m_);
    for (const LampCasters& each : lamps_) {
        std::vector<std::uint32_t> both;
        if (each.lamp.intensity_factor > 0.0) {
            std::ranges::set_union(one.pieces, each.pieces, std::back_inserter(both));
            one.pieces = std::move(both);
            one.ground = one.ground || each.ground;
        }
    }
    add_bodies(one);
    lamps_ = {std::move(one)};
}

void ShadowCasters::widen(std::size_t lamp, double tangent) {
    for (Caster& caster : lamps_.at(lamp).bodies)
        gl::widen(caster, tangent);
}

void ShadowCasters::soften(double radius_m) {
    for (LampCasters& lamp : lamps_) {
        lamp.slack_m += radius_m;
        for (Caster& caster : lamp.bodies)
            gl::widen(caster, radius_m / std::max(caster.nearest_m, tangents_from_m));
    }
}

bool ShadowCasters::any() const {
    return std::any_of(lamps_.begin(), lamps_.end(), [](const LampCasters& lamp) { return !lamp.pieces.empty(); });
}

bool ShadowCasters::reach(const Piece& piece, double raised_m) const {
    Corners raised = piece.corners_m; // bits 0 to 3: the box's bottom, 4 to 7: its top
    for (std::size_t i = 4; i < raised.size(); ++i)
        raised[i].z += raised_m;
    for (const LampCasters& lamp : lamps_) {
        if (lamp.bodies.empty())
            continue;
        const Corners box = in_lamp_space(lamp.lamp, piece.origin_m - ego_m_ - lamp.lamp_m, raised);
        if (std::ranges::any_of(lamp.bodies, [&](const Caster& caster) { return shades(caster, box, lamp.slack_m); }))
            return true;
    }
    return false;
}

} // namespace fernlicht::gl
