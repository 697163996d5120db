#include "scenarios/roads/road_mesh.h"

#include "scenarios/roads/mesh_materials.h"
#include "scenarios/roads/mesh_surface.h"

namespace fernlicht {

Scene build_scene(const RoadNetwork& network, const RoadMeshOptions& options) {
    Scene scene;
    scene.materials = road_materials();
    std::vector<SurfacePlan> plans;
    plans.reserve(network.roads.size());
    for (const Road& road : network.roads)
        plans.push_back(plan_surface(network, road, options));
    for (const SurfacePlan& plan : plans)
        append_surface(scene, network, plan, {});
    return scene;
}

} // namespace fernlicht
