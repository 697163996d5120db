#include "renderer/gl/shadows/warped_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace fernlicht::gl {
namespace {

constexpr double widest_warped_texel = 2.0; // of the plain map's

using WarpPolygon = std::vector<glm::dvec3>;

constexpr double texels_beside_seen = 4.0; // a look-up's point is raised by 1.5, weighs texels up to 1 away, and the outermost are empty
constexpr double min_w_ratio = 1.0 / 256.0;

double above_plane(const glm::dvec4& plane, const glm::dvec3& p) { return glm::dot(glm::dvec3(plane), p) + plane.w; }

/// The points where the plane cuts the faces, in order round its normal.
WarpPolygon cap_of(std::vector<glm::dvec3> cut, const glm::dvec4& plane) {
    glm::dvec3 centre(0.0);
    for (const glm::dvec3& p : cut)
        centre += p / static_cast<double>(cut.size());
    const glm::dvec3 n(plane), any = std::abs(n.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 u = glm::normalize(glm::cross(any, n)), v = glm::cross(n, u);
    std::ranges::sort(cut, {}, [&](const glm::dvec3& p) { return std::atan2(glm::dot(v, p - centre), glm::dot(u, p - centre)); });
    return cut;
}

void clip_faces(std::vector<WarpPolygon>& faces, const glm::dvec4& plane) {
    std::vector<glm::dvec3> cut;
    bool all_inside = true;
    for (const WarpPolygon& face : faces)
        for (const glm::dvec3& p : face)
            all_inside = all_inside && above_plane(plane, p) >= 0.0;
    if (all_inside)
        return;
    std::vector<WarpPolygon> left;
    for (const WarpPolygon& face : faces) {
        WarpPolygon inside;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const glm::dvec3 &a = face[i], &b = face[(i + 1) % face.size()];
            const double da = above_plane(plane, a), db = above_plane(plane, b);
            if (da >= 0.0)
                inside.push_back(a);
            if ((da >= 0.0) != (db >= 0.0)) {
                inside.push_back(a + (b - a) * (da / (da - db)));
                cut.push_back(inside.back());
            }
        }
        if (!inside.empty())
            left.push_back(std::move(inside));
    }
    if (cut.size() > 2)
        left.push_back(cap_of(std::move(cut), plane));
    faces = std::move(left);
}

struct Span {
    double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();
    void add(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

/// Rows as they are written on paper.
glm::dmat3 from_rows(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& w) { return glm::transpose(glm::dmat3(x, y, w)); }

glm::dvec3 in_world_axes(const LitLamp& lamp, const glm::dvec3& v) {
    return -lamp.pose.left() * v.x + lamp.pose.up() * v.y + lamp.pose.forward() * v.z;
}

} // namespace

std::vector<MapPlan> WarpedMaps::plan(const Shot& shot) {
    const glm::dvec3 ego_m = casters_.ego_m();
    const Camera eye = eye_ ? camera_of(shot.moment, *eye_) : shot.camera;
    std::vector<Corners> boxes; // of all that can be seen, whether it is lit or not: pruning must not change the fit
    if (!eye.is_map && !shot.outputs.target) {
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
        const double plain_raise = max_raise_tangent(plan.texture_from_lamp, plan.spread, seen);
        const auto take = [&](const std::optional<glm::dmat3>& warp, double widest) {
            const auto fit = warp ? fitted(*warp, seen, settings_.width, settings_.height, shadow_slack_m) : std::nullopt;
            if (!fit)
                return false;
            const double spread = spread_of(*fit, settings_.width, settings_.height), raise = max_raise_tangent(*fit, spread, seen);
            if (raise > widest * plain_raise)
                return false;
            plan.texture_from_lamp = *fit;
            plan.spread = spread;
            plan.to_cover = seen;
            plan.max_raise = raise;
            return true;
        };
        const auto warp = warp_ == Warp::perspective ? perspective_warp(seen, eye, lamp.lamp, lamp.lamp_m)
                                                     : light_space_warp(seen, eye, lamp.lamp, lamp.lamp_m);
        if (take(warp, widest_warped_texel) || take(glm::dmat3(1.0), 1.0))
            casters_.widen(i, shadow_kept_slack * 2.0 * std::max(0.0, plan.max_raise - plain_raise));
    }
    return plans;
}

std::vector<glm::dvec3> clipped_box(const Corners& box, const std::vector<glm::dvec4>& planes) {
    std::vector<bool> cuts;
    for (const glm::dvec4& plane : planes) {
        const auto inside = std::ranges::count_if(box, [&](const glm::dvec3& p) { return above_plane(plane, p) >= 0.0; });
        if (inside == 0)
            return {};
        cuts.push_back(inside < 8);
    }
    if (std::ranges::none_of(cuts, [](bool cut) { return cut; }))
        return {box.begin(), box.end()};
    std::vector<WarpPolygon> faces;
    for (const auto& face : {std::array{0, 1, 3, 2}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4}, std::array{2, 3, 7, 6},
                             std::array{0, 2, 6, 4}, std::array{1, 3, 7, 5}}) {
        WarpPolygon polygon;
        for (const int corner : face)
            polygon.push_back(box[static_cast<std::size_t>(corner)]);
        faces.push_back(std::move(polygon));
    }
    for (std::size_t i = 0; i < planes.size(); ++i)
        if (cuts[i])
            clip_faces(faces, planes[i]);
    std::vector<glm::dvec3> points;
    for (const WarpPolygon& face : faces)
        points.insert(points.end(), face.begin(), face.end());
    return points;
}

std::vector<glm::dvec3> seen_in_beam(const std::vector<Corners>& boxes, const Camera& camera, const LitLamp& lamp, const glm::dvec3& lamp_m,
                                     const ShadowWindow& window, double slack_m) {
    std::vector<glm::dvec4> planes;
    const auto through = [&](const glm::dvec3& at, const glm::dvec3& inside, double slack) {
        const glm::dvec3 n = glm::normalize(inside);
        planes.emplace_back(n, slack - glm::dot(n, at));
    };
    const glm::dvec2 half = camera.half_extent;
    through(camera.eye_m, camera.axis, 0.0);
    through(camera.eye_m, camera.axis * half.x + camera.right, slack_m);
    through(camera.eye_m, camera.axis * half.x - camera.right, slack_m);
    through(camera.eye_m, camera.axis * half.y + camera.up, slack_m);
    through(camera.eye_m, camera.axis * half.y - camera.up, slack_m);
    through(lamp_m, in_world_axes(lamp, {0.0, 0.0, 1.0}), -map_begins_m);
    through(lamp_m, in_world_axes(lamp, {1.0, 0.0, -window.left}), 0.0);
    through(lamp_m, in_world_axes(lamp, {-1.0, 0.0, window.right}), 0.0);
    through(lamp_m, in_world_axes(lamp, {0.0, 1.0, -window.bottom}), 0.0);
    through(lamp_m, in_world_axes(lamp, {0.0, -1.0, window.top}), 0.0);
    std::vector<glm::dvec3> seen;
    for (const Corners& box : boxes)
        for (const glm::dvec3& point : clipped_box(box, planes))
            seen.push_back(to_lamp_space(lamp, point - lamp_m));
    return seen;
}

std::optional<glm::dmat3> light_space_warp(const std::vector<glm::dvec3>& seen, const Camera& camera, const LitLamp& lamp,
                                           const glm::dvec3& lamp_m) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& p : seen)
        middle += p / static_cast<double>(seen.size());
    const glm::dvec3 axis = to_lamp_space(lamp, camera.axis);
    // How the tangents move on the way along the view, times the distance from the lamp.
    const glm::dvec2 way = glm::dvec2(axis) - glm::dvec2(middle) / middle.z * axis.z;
    if (glm::length(way) < 1e-3)
        return std::nullopt;
    const glm::dvec2 along = glm::normalize(way), across(along.y, -along.x);
    Span a, b;
    for (const glm::dvec3& p : seen) {
        a.add(glm::dot(along, glm::dvec2(p)) / p.z);
        b.add(glm::dot(across, glm::dvec2(p)) / p.z);
    }
    if (a.most - a.least < 1e-6)
        return std::nullopt;
    Span first, last; // eye's distance over the lamp's, in the tenths at the two ends
    for (const glm::dvec3& p : seen) {
        const double at = (glm::dot(along, glm::dvec2(p)) / p.z - a.least) / (a.most - a.least);
        const double ratio = std::max(glm::dot(camera.axis, lamp_m + in_world_axes(lamp, p) - camera.eye_m), 0.1) / p.z;
        if (at <= 0.1)
            first.add(ratio);
        if (at >= 0.9)
            last.add(ratio);
    }
    const double rise = std::clamp(std::sqrt(last.least / first.least), 1.0 / 16.0, 16.0);
    const double k = (rise - 1.0) / (a.most - a.least), centre = 0.5 * (b.least + b.most);
    const glm::dvec3 row_a(along, 0.0), row_b(across, -centre), row_w = glm::dvec3(0.0, 0.0, 1.0 - k * a.least) + k * row_a;
    // The map's long side along what is more nearly level.
    return std::abs(along.x) > std::abs(along.y) ? from_rows(row_a, row_b, row_w) : from_rows(row_b, row_a, row_w);
}

std::optional<glm::dmat3> perspective_warp(const std::vector<glm::dvec3>& seen, const Camera& camera, const LitLamp& lamp,
                                           const glm::dvec3& lamp_m) {
    Span depth;
    for (const glm::dvec3& p : seen)
        depth.add(glm::dot(camera.axis, lamp_m + in_world_axes(lamp, p) - camera.eye_m));
    const double n = std::max(depth.least, 0.1), f = std::max(depth.most, 1.001 * n);
    // The camera's clip space, as a function of directions from the lamp, and the lamp's own place in it.
    const auto in_view = [&](const glm::dvec3& v) {
        return glm::dvec3(glm::dot(camera.right, v) / camera.half_extent.x, glm::dot(camera.up, v) / camera.half_extent.y,
                          glm::dot(camera.axis, v));
    };
    const double stretch = (f + n) / (f - n), shift = -2.0 * f * n / (f - n);
    const glm::dvec3 from_eye = in_view(lamp_m - camera.eye_m);
    const glm::dvec3 place(from_eye.x, from_eye.y, stretch * from_eye.z + shift);
    if (glm::length(place) < 1e-9)
        return std::nullopt;
    const glm::dvec3 look = -glm::normalize(place);
    const glm::dvec3 level = std::abs(look.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 right = glm::normalize(glm::cross(level, look)), up = glm::cross(look, right);
    glm::dmat3 rows(0.0); // columns: the images of lamp space's axes
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 unit(0.0);
        unit[i] = 1.0;
        const glm::dvec3 v = in_view(in_world_axes(lamp, unit)), c(v.x, v.y, stretch * v.z);
        rows[i] = {glm::dot(right, c), glm::dot(up, c), from_eye.z / glm::length(place) * glm::dot(look, c) + v.z};
    }
    return rows;
}

std::optional<glm::dmat3> fitted(const glm::dmat3& warp, const std::vector<glm::dvec3>& seen, int width, int height, double slack_m) {
    Span w, x, y;
    for (const glm::dvec3& p : seen) {
        w.add((warp * p).z / p.z);
        for (const auto& [dx, dy] : {std::pair(-1.0, -1.0), std::pair(1.0, -1.0), std::pair(-1.0, 1.0), std::pair(1.0, 1.0)}) {
            const glm::dvec3 q = warp * (p + slack_m * glm::dvec3(dx, dy, 0.0));
            w.add(q.z / p.z);
            if (!(q.z > 0.0))
                return std::nullopt;
            x.add(q.x / q.z);
            y.add(q.y / q.z);
        }
    }
    if (!(w.least > min_w_ratio * w.most) || !(x.most - x.least > 1e-9) || !(y.most - y.least > 1e-9))
        return std::nullopt;
    const double beside_x = texels_beside_seen * (x.most - x.least) / (width - 2.0 * texels_beside_seen),
                 beside_y = texels_beside_seen * (y.most - y.least) / (height - 2.0 * texels_beside_seen);
    const ShadowWindow window{x.least - beside_x, x.most + beside_x, y.least - beside_y, y.most + beside_y};
    return window_homography(window, width, height) * warp / w.least;
}

double max_raise_tangent(const glm::dmat3& texture_from_lamp, double spread, const std::vector<glm::dvec3>& seen) {
    double most = 0.0;
    for (const glm::dvec3& p : seen)
        most = std::max(most, spread * (texture_from_lamp * p).z / p.z);
    return most;
}

} // namespace fernlicht::gl
