#include "runner/aliasing/motion.h"

#include "renderer/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace fernlicht {
namespace {

struct Seen {
    int x = 0, y = 0;
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
    return Seen{static_cast<int>(x), static_cast<int>(y), depth_m};
}

} // namespace

std::vector<Track> tracks_of(const std::vector<Moment>& moments, const View& view, const std::vector<Frame>& frames, std::size_t from,
                             int stride) {
    std::vector<Camera> cameras;
    for (const Moment& moment : moments)
        cameras.push_back(camera_of(moment, view));
    std::vector<Track> tracks;
    for (int y = stride / 2; y < view.height_px; y += stride)
        for (int x = stride / 2; x < view.width_px; x += stride) {
            const std::uint32_t id = frames[from].ids.at(x, y);
            if (id == 0)
                continue;
            const Ray ray = pixel_ray(cameras[from], view, x + 0.5, y + 0.5);
            const glm::dvec3 point_m = ray.origin_m + ray.direction * (static_cast<double>(frames[from].depth_m.at(x, y)) /
                                                                       glm::dot(ray.direction, cameras[from].axis));
            Track track;
            for (std::size_t i = 0; i < moments.size(); ++i) {
                const auto seen = seen_at(cameras[i], view, point_m + moments[from].ego.position_m - moments[i].ego.position_m);
                if (!seen || frames[i].ids.at(seen->x, seen->y) != id ||
                    std::abs(static_cast<double>(frames[i].depth_m.at(seen->x, seen->y)) - seen->depth_m) > 0.1 * seen->depth_m)
                    break;
                track.push_back(seen->y * view.width_px + seen->x);
            }
            if (track.size() == moments.size())
                tracks.push_back(std::move(track));
        }
    return tracks;
}

} // namespace fernlicht
