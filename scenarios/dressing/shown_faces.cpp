#include "scenarios/dressing/dressing.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace fernlicht {
namespace {

constexpr double every_m = 2.0; ///< of the route

const glm::dvec3 half_m = 0.5 * (eyes_high_m - eyes_low_m + glm::dvec3(every_m, 0.0, 0.0));

/// Where eyes and lamps may be about one place of the route: a box along its axes.
struct Abode {
    glm::dvec3 middle_m, forward, left, up;
    explicit Abode(const Pose& pose)
        : middle_m(to_parent(pose, 0.5 * (eyes_low_m + eyes_high_m))), forward(pose.forward()), left(pose.left()), up(pose.up()) {}

    /// Whether a face shows its front anywhere in the box, or in the part of the box that has the face before it.
    bool sees(const std::array<glm::dvec3, 3>& corners_m, const glm::dvec3& normal, bool ahead) const {
        const double along = glm::dot(normal, forward);
        double foremost_m = half_m.x;
        if (ahead) {
            double farthest_m = -half_m.x;
            for (const glm::dvec3& p : corners_m)
                farthest_m = std::max(farthest_m, glm::dot(forward, p - middle_m));
            if (farthest_m <= -half_m.x)
                return false;
            foremost_m = std::min(foremost_m, farthest_m);
        }
        return glm::dot(normal, middle_m - corners_m[0]) + std::max(along * foremost_m, along * -half_m.x) +
                   half_m.y * std::abs(glm::dot(normal, left)) + half_m.z * std::abs(glm::dot(normal, up)) >
               least_m;
    }
    static constexpr double least_m = 1e-3; ///< before the face: nearer, it is a line
};

} // namespace

void keep_shown_faces(Scene& scene, const Route& route, bool ahead, std::size_t first) {
    std::vector<Abode> abodes;
    for (double at = 0.0; at < route.length_m() + every_m; at += every_m)
        abodes.emplace_back(route.pose(at));
    std::size_t last = 0; ///< what saw one triangle often sees the next
    for (std::size_t m = first; m < scene.meshes.size(); ++m) {
        Mesh& mesh = scene.meshes[m];
        if (mesh.body >= 0)
            continue;
        const auto is_shown = [&](std::uint32_t k) {
            const auto at = [&](std::uint32_t i) { return mesh.origin_m + glm::dvec3(mesh.vertices[mesh.indices[k + i]].position_m); };
            const std::array<glm::dvec3, 3> p{at(0), at(1), at(2)};
            const glm::dvec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
            const double twice_m2 = glm::length(across);
            if (twice_m2 == 0.0)
                return false;
            if (std::abs(glm::dot(glm::dvec3(mesh.vertices[mesh.indices[k]].normal), across)) < 0.3 * twice_m2)
                return true; // a blade of grass, lit on both sides
            for (std::size_t n = 0; n < abodes.size(); ++n)
                if (const Abode& abode = abodes[(last + n) % abodes.size()]; abode.sees(p, across / twice_m2, ahead)) {
                    last = (last + n) % abodes.size();
                    return true;
                }
            return false;
        };
        std::vector<std::uint32_t> indices;
        for (Batch& batch : mesh.batches) {
            const auto from = static_cast<std::uint32_t>(indices.size());
            for (std::uint32_t k = batch.first; k + 2 < batch.first + batch.count; k += 3)
                if (is_shown(k))
                    indices.insert(indices.end(), {mesh.indices[k], mesh.indices[k + 1], mesh.indices[k + 2]});
            batch.first = from;
            batch.count = static_cast<std::uint32_t>(indices.size()) - from;
        }
        mesh.indices = std::move(indices);
        std::erase_if(mesh.batches, [](const Batch& batch) { return batch.count == 0; });
    }
    scene.meshes.erase(std::remove_if(scene.meshes.begin() + static_cast<std::ptrdiff_t>(first), scene.meshes.end(),
                                      [](const Mesh& mesh) { return mesh.indices.empty(); }),
                       scene.meshes.end());
}

void leave_out_shadows(Scene& scene, std::span<const std::string> shading, std::size_t first) {
    for (std::size_t m = first; m < scene.meshes.size(); ++m)
        if (Mesh& mesh = scene.meshes[m]; mesh.name.starts_with("bush, road ") || mesh.name.starts_with("field fence, road "))
            mesh.casts = mesh.casts && std::ranges::find(shading, mesh.name) != shading.end();
}

} // namespace fernlicht
