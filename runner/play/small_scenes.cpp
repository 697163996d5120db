#include "runner/play/small_scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace fernlicht::small_scenes {

CandelaTable constant_table(double cd) { return {{-85.0, 85.0}, {-85.0, 85.0}, {cd, cd, cd, cd}, {}, BetweenSamples::linear_cd}; }

CandelaTable cut_off_table() {
    CandelaTable table;
    for (int i = -300; i <= 300; ++i)
        table.h_deg.push_back(i * 0.1);
    for (int i = -200; i <= 100; ++i)
        table.v_deg.push_back(i * 0.05);
    for (const double v : table.v_deg)
        for (const double h : table.h_deg) {
            const double cut = -0.57 + (h > 0.0 ? std::min(h * 0.268, 2.0) : 0.0);
            table.cd.push_back(300.0 + 20000.0 / (1.0 + std::exp((v - cut) / 0.11)) * std::exp(-h * h / 200.0));
        }
    return table;
}

LitLamp lamp(CandelaTable table, const glm::dvec3& position_m, double yaw_rad, double pitch_rad) {
    auto file = std::make_shared<LampFile>();
    file->name = "trial";
    file->table = std::move(table);
    return {"lamp", std::move(file), Pose{position_m, axes_from_angles(yaw_rad, pitch_rad, 0.0)}, 1.0, LampColour{}, 0.0};
}

void add_sheet(Scene& scene, const std::string& name, std::uint32_t material, const glm::dvec3& corner_m, const glm::dvec3& edge_a,
               const glm::dvec3& edge_b) {
    Mesh mesh{name, corner_m + 0.5 * (edge_a + edge_b), {}, {0, 1, 2, 0, 2, 3}, {{material, 0, 6}}};
    const glm::vec3 normal(glm::normalize(glm::cross(edge_a, edge_b)));
    for (const auto& [a, b] : {std::pair(-0.5, -0.5), std::pair(0.5, -0.5), std::pair(0.5, 0.5), std::pair(-0.5, 0.5)})
        mesh.vertices.push_back({glm::vec3(a * edge_a + b * edge_b), normal});
    scene.meshes.push_back(std::move(mesh));
}

Scene empty_scene() {
    Material road{"road", SurfaceKind::road, glm::vec3(0.08F)};
    Material board{"board", SurfaceKind::board, glm::vec3(0.6F, 0.1F, 0.1F)};
    board.retro_rl = 180.0F;
    board.retro_reference_rad = 0.00576F;
    board.retro_falloff_rad = 0.0079F;
    return {{road, board}, {}, {}};
}

View camera(const glm::dvec3& position_m, double yaw_rad, double pitch_rad, double fov_deg, int width_px, int height_px) {
    View view;
    view.name = "camera";
    view.position_m = position_m;
    view.yaw_rad = yaw_rad;
    view.pitch_rad = pitch_rad;
    view.vertical_fov_rad = radians(fov_deg);
    view.width_px = width_px;
    view.height_px = height_px;
    return view;
}

} // namespace fernlicht::small_scenes
