#include "scenarios/roads/road_mesh.h"

#include "scenarios/roads/mesh_materials.h"
#include "scenarios/roads/mesh_objects.h"
#include "scenarios/roads/mesh_terrain.h"

namespace fernlicht {

Scene build_scene(const RoadNetwork& network, const RoadMeshOptions& options) {
    Scene scene;
    scene.materials = road_materials();
    std::vector<SurfacePlan> plans;
    plans.reserve(network.roads.size());
    for (const Road& road : network.roads)
        plans.push_back(plan_surface(network, road, options));
    const Footprints footprints(network, plans);
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const SurfaceRows surface = append_surface(scene, network, plans[i], {});
        append_terrain(scene, plans[i], i, surface, footprints, options);
        append_objects(scene, network, plans[i], options);
        append_signals(scene, network, plans[i]);
    }
    return scene;
}

} // namespace fernlicht
