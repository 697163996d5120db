#include "renderer/gl/shadows/ground_shadows.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

namespace fernlicht::gl {

void PlaneFit::add(const glm::dvec3& p) {
    count_ += 1.0;
    sum_ += p;
    xx_ += p.x * p.x;
    xy_ += p.x * p.y;
    yy_ += p.y * p.y;
    xz_ += p.x * p.z;
    yz_ += p.y * p.z;
}

std::optional<glm::dvec4> PlaneFit::plane() const {
    if (count_ == 0.0)
        return std::nullopt;
    const glm::dvec3 mean = sum_ / count_;
    const double xx = xx_ / count_ - mean.x * mean.x, xy = xy_ / count_ - mean.x * mean.y, yy = yy_ / count_ - mean.y * mean.y,
                 xz = xz_ / count_ - mean.x * mean.z, yz = yz_ / count_ - mean.y * mean.z;
    const double determinant = xx * yy - xy * xy;
    double a = 0.0, b = 0.0;
    if (determinant > 1e-9 * xx * yy) { // else all in one line
        a = (xz * yy - yz * xy) / determinant;
        b = (yz * xx - xz * xy) / determinant;
    }
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-a, -b, 1.0));
    return glm::dvec4(normal, -glm::dot(normal, mean));
}

PlanarShadows::PlanarShadows(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, const ShadowUse& use)
    : ShadowMask(context, scene, settings, use),
      program_(context, "planar_shadow.vert.glsl", "",
               scene.moves() ? std::vector<Program::Define>{{"MOVING", "1"}} : std::vector<Program::Define>{}),
      list_(context, scene) {}

void PlanarShadows::set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    ShadowMask::set(lamps, beams, ego_m);
    find_plane(lamps, beams);
    ego_plane_ = world_plane_;
    ego_plane_.w += glm::dot(glm::dvec3(world_plane_), ego_m - origin_m_);
}

/// Through the ground that gets any lamp's last contour, whichever pieces that lies in.
void PlanarShadows::find_plane(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams) {
    std::vector<std::uint32_t> reached;
    for (const std::uint32_t i : scene_.near(ego_m())) {
        const Piece& piece = scene_.pieces()[i];
        if (!piece.ground)
            continue;
        const bool lit = std::ranges::any_of(lamps, [&](const LitLamp& lamp) {
            const glm::dvec3 from_lamp = piece.origin_m + piece.centre_m - lamp.pose.position_m;
            const double nearest = glm::length(from_lamp) - piece.radius_m,
                         cd = beams[static_cast<std::size_t>(&lamp - lamps.data())]->bounds.max_towards(to_lamp_space(lamp, from_lamp),
                                                                                                        piece.radius_m);
            return lamp.intensity_factor > 0.0 && nearest < shadow_farthest_m && cd > 0.0 &&
                   (nearest <= 0.0 || lamp.intensity_factor * cd >= last_contour_lx * nearest * nearest);
        });
        if (lit)
            reached.push_back(i);
    }
    if (reached == ground_ || reached.empty())
        return;
    const glm::dvec3 origin = scene_.pieces()[reached.front()].origin_m;
    const auto each_corner = [&](auto visit) {
        for (const std::uint32_t i : reached) {
            const Piece& piece = scene_.pieces()[i];
            for (std::size_t k = piece.first_plane; k < piece.first_plane + piece.planes; ++k)
                for (const glm::vec3& corner : scene_.ground()[k].corners_m)
                    visit(piece.origin_m - origin + glm::dvec3(corner));
        }
    };
    PlaneFit fit;
    each_corner([&](const glm::dvec3& p) { fit.add(p); });
    const glm::dvec4 plane = fit.plane().value_or(glm::dvec4(0.0, 0.0, 1.0, 0.0));
    double worst = 0.0;
    glm::dvec3 where(0.0);
    each_corner([&](const glm::dvec3& p) {
        if (const double height = glm::dot(glm::dvec3(plane), p) + plane.w; std::abs(height) > std::abs(worst)) {
            worst = height;
            where = p + origin;
        }
    });
    if (std::abs(worst) > settings_.tolerance_m)
        throw InputError({{}, 0, 0, "shadows"}, "found 'planar' and ground that is not one plane",
                         fmt::format("ground that the lamps reach within {:.1f} cm of one plane (shadows: tolerance_m): at x {:.1f} m, "
                                     "y {:.1f} m it lies {:.1f} cm {} it; choose another method",
                                     100.0 * settings_.tolerance_m, where.x, where.y, 100.0 * std::abs(worst),
                                     worst > 0.0 ? "above" : "below"));
    ground_ = std::move(reached);
    origin_m_ = origin;
    world_plane_ = plane;
}

bool PlanarShadows::hides_any(std::size_t lamp) const {
    const LampCasters& casters = casters_.lamps()[lamp];
    return glm::dot(glm::dvec3(ego_plane_), casters.lamp_m) + ego_plane_.w > 0.0 &&
           std::ranges::any_of(casters.pieces, [&](std::uint32_t i) { return !scene_.pieces()[i].ground; });
}

bool PlanarShadows::needed() const {
    for (std::size_t i = 0; i < casters_.lamps().size(); ++i)
        if (hides_any(i))
            return true;
    return false;
}

void PlanarShadows::before_marking(const Shot& /*shot*/) {
    list_.start(ego_m(), scene_.moves());
    for (const LampCasters& lamp : casters_.lamps()) {
        std::vector<std::uint32_t> upright;
        std::ranges::copy_if(lamp.pieces, std::back_inserter(upright), [&](std::uint32_t i) { return !scene_.pieces()[i].ground; });
        list_.add(upright);
    }
    list_.upload();
}

/// A target stands in a plane raised by its height: the shadow there, drawn so much lower, lies on its pixel. Where ground is seen it is
/// seen in the plane, so that no depth need be compared.
void PlanarShadows::mark_hidden(const Shot& shot, std::size_t lamp, double raised_m) {
    const LampCasters& casters = casters_.lamps()[lamp];
    glm::dvec4 plane = ego_plane_;
    plane.w -= raised_m * plane.z;
    if (glm::dot(glm::dvec3(plane), casters.lamp_m) + plane.w <= 0.0)
        return;
    const GladGLContext& gl = context_.gl;
    program_.use();
    program_.set("clip_from_ego", glm::mat4(glm::translate(shot.camera.clip_from_ego, {0.0, 0.0, -raised_m})));
    program_.set("plane", glm::vec4(plane));
    program_.set("lamp_m", glm::vec3(casters.lamp_m));
    gl.StencilFunc(GL_EQUAL, static_cast<GLint>(ground_bit | 1U), ground_bit);
    gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    gl.Disable(GL_DEPTH_TEST);
    gl.Enable(GL_DEPTH_CLAMP);
    gl.Enable(GL_CLIP_DISTANCE0);
    gl.Enable(GL_CLIP_DISTANCE0 + 1);
    list_.draw(static_cast<int>(lamp));
    gl.Disable(GL_CLIP_DISTANCE0 + 1);
    gl.Disable(GL_CLIP_DISTANCE0);
    gl.Disable(GL_DEPTH_CLAMP);
    gl.Enable(GL_DEPTH_TEST);
    shot.work.triangles += lamp == 0 && raised_m == 0.0 ? list_.triangles() : 0;
    shot.work.draws += static_cast<int>(casters.pieces.size());
}

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
