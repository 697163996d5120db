#include "runner/experiments/aliasing/motion.h"

#include "scenarios/drives/play/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace fernlicht {
namespace {

struct Seen {
    int x = 0, y = 0;              ///< pixel
    double at_x = 0.0, at_y = 0.0; ///< the same in pixels with centres at .5
    double depth_m = 0.0;
};

std::optional<Seen> seen_at(const Camera& camera, const View& view, const glm::dvec3& point_m) {
    const glm::dvec3 p = point_m - camera.eye_m;
    const double depth_m = glm::dot(p, camera.axis);
    if (!(depth_m > 0.0))
        return std::nullopt;
    const double x = (1.0 + glm::dot(p, camera.right) / depth_m / camera.half_extent.x) * 0.5 * view.width_px;
    const double y = (1.0 - glm::dot(p, camera.up) / depth_m / camera.half_extent.y) * 0.5 * view.height_px;
    if (!(x >= 0.0 && y >= 0.0 && x < view.width_px && y < view.height_px))
        return std::nullopt;
    return Seen{static_cast<int>(x), static_cast<int>(y), x, y, depth_m};
}

/// One frame and whence it was seen.
struct Shot {
    const Moment& moment;
    const Frame& frame;
    Camera camera;
};

/// What pixel (x, y) shows, relative to the eye's car of that moment; something is seen there.
glm::dvec3 point_at(const Shot& shot, const View& view, int x, int y) {
    const Ray ray = pixel_ray(shot.camera, view, x + 0.5, y + 0.5);
    return ray.origin_m + ray.direction * (static_cast<double>(shot.frame.depth_m.at(x, y)) / glm::dot(ray.direction, shot.camera.axis));
}

/// Where a point of `from` with that id is seen in `to`; nullopt where it is hidden or outside.
std::optional<Seen> found_in(const Shot& from, const Shot& to, const View& view, const glm::dvec3& point_m, std::uint32_t id) {
    const auto seen = seen_at(to.camera, view, point_m + from.moment.ego.position_m - to.moment.ego.position_m);
    if (!seen || to.frame.ids.at(seen->x, seen->y) != id ||
        std::abs(static_cast<double>(to.frame.depth_m.at(seen->x, seen->y)) - seen->depth_m) > 0.1 * seen->depth_m)
        return std::nullopt;
    return seen;
}

} // namespace

std::vector<PixelTrack> tracks_of(const std::vector<Moment>& moments, const View& view, const std::vector<Frame>& frames, std::size_t from,
                                  int stride) {
    std::vector<Shot> shots;
    for (std::size_t i = 0; i < moments.size(); ++i)
        shots.push_back({moments[i], frames[i], camera_of(moments[i], view)});
    std::vector<PixelTrack> tracks;
    for (int y = stride / 2; y < view.height_px; y += stride)
        for (int x = stride / 2; x < view.width_px; x += stride) {
            const std::uint32_t id = frames[from].ids.at(x, y);
            if (id == 0)
                continue;
            const glm::dvec3 point_m = point_at(shots[from], view, x, y);
            PixelTrack track;
            for (const Shot& shot : shots) {
                const auto seen = found_in(shots[from], shot, view, point_m, id);
                if (!seen)
                    break;
                track.push_back(seen->y * view.width_px + seen->x);
            }
            if (track.size() == moments.size())
                tracks.push_back(std::move(track));
        }
    return tracks;
}

KnownFlow known_flow(const std::vector<Moment>& moments, const View& view, const std::vector<Frame>& frames, std::size_t from,
                     std::size_t to) {
    const Shot first{moments[from], frames[from], camera_of(moments[from], view)},
        second{moments[to], frames[to], camera_of(moments[to], view)};
    const Image<float> none(view.width_px, view.height_px);
    KnownFlow found{{none, none}, Image<std::uint8_t>(view.width_px, view.height_px)};
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const std::uint32_t id = first.frame.ids.at(x, y);
            if (id == 0)
                continue;
            const auto seen = found_in(first, second, view, point_at(first, view, x, y), id);
            if (!seen)
                continue;
            found.known.at(x, y) = 1;
            found.flow.dx_px.at(x, y) = static_cast<float>(seen->at_x - (x + 0.5));
            found.flow.dy_px.at(x, y) = static_cast<float>(seen->at_y - (y + 0.5));
        }
    return found;
}

Image<Ground> ground_of(Device& device, const Scene& scene, const Moment& moment, const View& view) {
    Scene glowing = scene; // nothing returns light; what is looked for glows
    for (Material& material : glowing.materials) {
        const float glow = material.kind == SurfaceKind::road ? 1.0F : material.kind == SurfaceKind::marking ? 2.0F : 0.0F;
        material.albedo = glm::vec3(0.0F);
        material.retro_rl = 0.0F;
        material.texture = -1;
        material.emission_cdm2 = glm::vec3(glow);
    }
    Moment dark = moment;
    dark.lamps.clear();
    dark.daylight = {};
    Renderer renderer(device, glowing, {});
    const Frame frame = renderer.draw(dark, view, {.luminance = true});
    Image<Ground> ground(view.width_px, view.height_px, Ground::other);
    std::ranges::transform(frame.luminance_cdm2.pixels(), ground.pixels().begin(), [](float glow) {
        return glow > 1.5F ? Ground::mark : glow > 0.5F ? Ground::road : Ground::other;
    });
    return ground;
}

} // namespace fernlicht
