#include "runner/experiments/accuracy/reference_shots.h"

#include "scenarios/drives/play/camera.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

/// Where the pixel's centre meets what it shows, relative to the car.
glm::dvec3 shown_at(const Camera& camera, const View& view, const Frame& frame, int x, int y) {
    const Ray ray = pixel_ray(camera, view, x + 0.5, y + 0.5);
    return ray.origin_m + ray.direction * (static_cast<double>(frame.depth_m.at(x, y)) / glm::dot(ray.direction, camera.axis));
}

} // namespace

bool is_road(const Scene& scene, std::uint32_t id) {
    if (id == 0)
        return false;
    const Mesh& mesh = scene.meshes.at(id - 1);
    return std::ranges::any_of(mesh.batches, [&](const Batch& batch) {
        const SurfaceKind kind = scene.materials[batch.material].kind;
        return kind == SurfaceKind::road || kind == SurfaceKind::marking;
    });
}

Image<float> road_areas_m2(const Scene& scene, const Moment& moment, const View& view, const Frame& frame) {
    const Camera camera = camera_of(moment, view);
    std::vector<bool> road(scene.meshes.size() + 1);
    for (std::size_t id = 1; id < road.size(); ++id)
        road[id] = is_road(scene, static_cast<std::uint32_t>(id));
    Image<float> areas(view.width_px, view.height_px, -1.0F);
    const auto same = [&](int x, int y, std::uint32_t id) {
        return x >= 0 && y >= 0 && x < view.width_px && y < view.height_px && frame.ids.at(x, y) == id;
    };
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const std::uint32_t id = frame.ids.at(x, y);
            if (!road[id])
                continue;
            // Between the neighbours on both sides, or on one: metres a pixel.
            const auto step = [&](int dx, int dy) {
                const int before = same(x - dx, y - dy, id) ? 1 : 0, after = same(x + dx, y + dy, id) ? 1 : 0;
                if (before + after == 0)
                    return glm::dvec3(0.0);
                return (shown_at(camera, view, frame, x + after * dx, y + after * dy) -
                        shown_at(camera, view, frame, x - before * dx, y - before * dy)) /
                       static_cast<double>(before + after);
            };
            areas.at(x, y) = static_cast<float>(glm::length(glm::cross(step(1, 0), step(0, 1))));
        }
    return areas;
}

View resized(View view, int width_px, int height_px) {
    view.width_px = width_px;
    view.height_px = height_px;
    return view;
}

} // namespace fernlicht
