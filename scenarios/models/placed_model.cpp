
#include "scenarios/models/model.h"
#include "scenarios/roads/route.h"

#include <glm/common.hpp>

namespace fernlicht {
namespace {

Mesh moved(const Mesh& mesh, const Pose& pose, double scale, std::uint32_t first_material) {
    Mesh out = mesh;
    out.origin_m = glm::round(to_parent(pose, scale * mesh.origin_m));
    const glm::mat3 turn(pose.axes);
    for (Vertex& vertex : out.vertices) {
        vertex.position_m = glm::vec3(to_parent(pose, scale * (mesh.origin_m + glm::dvec3(vertex.position_m))) - out.origin_m);
        vertex.normal = turn * vertex.normal;
    }
    for (Batch& batch : out.batches)
        batch.material += first_material;
    return out;
}

/// Where a placed model's frame lies in the world.
Pose world_pose(const PlacedModel& placed, const Route& route) {
    const Pose own{{}, axes_from_angles(placed.yaw_rad, placed.pitch_rad, placed.roll_rad)};
    if (!placed.along_route)
        return {placed.position_m, own.axes};
    const Pose there = route.pose(placed.position_m.x, placed.position_m.y);
    return compose(there, {{0.0, 0.0, placed.position_m.z}, own.axes});
}

} // namespace

void add_model(Scene& scene, const Model& model, const Pose& pose, double scale, SurfaceKind kind) {
    const auto first_material = static_cast<std::uint32_t>(scene.materials.size());
    const int first_texture = static_cast<int>(scene.textures.size());
    for (Material material : model.materials) {
        material.kind = kind;
        material.texture += material.texture < 0 ? 0 : first_texture;
        scene.materials.push_back(std::move(material));
    }
    scene.textures.insert(scene.textures.end(), model.textures.begin(), model.textures.end());
    for (const Mesh& mesh : model.meshes)
        scene.meshes.push_back(moved(mesh, pose, scale, first_material));
}

void add_scenery(Scene& scene, const std::vector<PlacedModel>& scenery, const Route& route) {
    for (const PlacedModel& placed : scenery)
        add_model(scene, *placed.model, world_pose(placed, route), placed.scale,
                  placed.ground ? SurfaceKind::terrain : SurfaceKind::object);
    if (!scenery.empty())
        unify_texture_sizes(scene);
}

} // namespace fernlicht
