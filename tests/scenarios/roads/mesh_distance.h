// How far triangles lie from the surface that they stand for, measured through the inverse of surface_pose.
#pragma once

#include "tests/scenarios/roads/mesh_checks.h"

#include <algorithm>

namespace fernlicht::mesh_checks {

struct NearestPlace {
    double s_m = 0.0, t_m = 0.0;
    double off_surface_m = 0.0; ///< along the surface's normal, positive above
    bool found = false;
};

/// (s, t) under a point near the surface, by walking along the surface's own axes. Not found where that does not settle: beyond the
/// road's ends, and where the road is folded about the centre of a bend.
inline NearestPlace nearest_place(const RoadNetwork& network, const Road& road, const glm::dvec3& point, double s_m) {
    NearestPlace place{.s_m = s_m};
    for (int step = 0; step < 80; ++step) {
        const Pose pose = surface_pose(network, road, place.s_m, place.t_m);
        const glm::dvec3 miss = point - pose.position_m;
        const double along = glm::dot(miss, pose.forward()), across = glm::dot(miss, pose.left());
        place.off_surface_m = glm::dot(miss, pose.up());
        if (std::abs(along) < 1e-5 && std::abs(across) < 1e-5) {
            place.found = true;
            return place;
        }
        place.s_m = std::clamp(place.s_m + 0.6 * along, 0.0, road.length_m);
        place.t_m += across;
    }
    return place;
}

/// "road 12 s 120-180" -> 120 and 180.
inline std::pair<double, double> stations_of(const std::string& mesh_name) {
    const std::size_t at = mesh_name.rfind(" s ");
    const std::size_t dash = mesh_name.find('-', at);
    return {std::stod(mesh_name.substr(at + 3)), std::stod(mesh_name.substr(dash + 1))};
}

struct Distances {
    std::size_t samples = 0, lost = 0;
    double greatest_m = 0.0;
    glm::dvec3 where{0.0};
};

/// Samples every `stride`-th triangle of the mesh that is not a kerb's, at its middle and the middles of its sides.
inline Distances distances(const RoadNetwork& network, const Road& road, const Scene& scene, const Mesh& mesh, std::size_t stride) {
    Distances result;
    Scene one{.materials = scene.materials};
    one.meshes.push_back(mesh);
    const auto [from, to] = stations_of(mesh.name);
    std::vector<Pose> guides;
    const int steps = std::max(1, static_cast<int>(2.0 * (to - from)));
    for (int i = 0; i <= steps; ++i)
        guides.push_back(surface_pose(network, road, from + (to - from) * i / steps, 0.0));
    std::size_t count = 0;
    for (const Triangle& triangle : triangles(one, "")) {
        if (count++ % stride != 0 || triangle.material == index_of(RoadMaterial::kerb))
            continue;
        const auto& p = triangle.corners;
        for (const glm::dvec3& point : {(p[0] + p[1] + p[2]) / 3.0, (p[0] + p[1]) / 2.0, (p[1] + p[2]) / 2.0, (p[2] + p[0]) / 2.0}) {
            std::size_t nearest = 0;
            for (std::size_t i = 1; i < guides.size(); ++i)
                if (glm::distance(guides[i].position_m, point) < glm::distance(guides[nearest].position_m, point))
                    nearest = i;
            const NearestPlace place = nearest_place(network, road, point, from + (to - from) * static_cast<double>(nearest) / steps);
            ++result.samples;
            if (!place.found) {
                ++result.lost;
            } else if (std::abs(place.off_surface_m) > result.greatest_m) {
                result.greatest_m = std::abs(place.off_surface_m);
                result.where = point;
            }
        }
    }
    return result;
}

} // namespace fernlicht::mesh_checks
