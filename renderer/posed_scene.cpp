#include "renderer/posed_scene.h"

namespace fernlicht {

Scene posed_scene(const Scene& scene, const std::vector<Body>& bodies) {
    Scene posed = scene;
    for (Mesh& mesh : posed.meshes) {
        if (mesh.body < 0)
            continue;
        const auto body = static_cast<std::size_t>(mesh.body);
        mesh.body = -1;
        if (body >= bodies.size() || !bodies[body].visible) {
            mesh.vertices.clear();
            mesh.indices.clear();
            mesh.batches.clear();
            continue;
        }
        const Pose& pose = bodies[body].pose;
        mesh.origin_m = to_parent(pose, mesh.origin_m);
        for (Vertex& vertex : mesh.vertices) {
            vertex.position_m = glm::vec3(pose.axes * glm::dvec3(vertex.position_m));
            vertex.normal = glm::vec3(pose.axes * glm::dvec3(vertex.normal));
        }
    }
    return posed;
}

} // namespace fernlicht
