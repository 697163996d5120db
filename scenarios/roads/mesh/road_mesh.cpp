#include "scenarios/roads/mesh/road_mesh.h"

#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/mesh_terrain.h"

namespace fernlicht {

namespace {

constexpr double same_height_m = 0.05;
constexpr double overlap_margin_m = 0.02;

/// Roads overlap in junctions, at the same height: which of two coplanar triangles is seen is left to rounding. So they must look the
/// same: whatever lies level with another road's paved surface is asphalt too, paint and verge of connecting roads included.
RoadMaterial junction_paint(const Footprints& footprints, std::size_t road, const StripEnd& from, const StripEnd& to) {
    const Strip& strip = from.strip;
    if (is_asphalt(strip.material) || strip.kerb_face)
        return strip.material;
    const auto place = [](const StripEnd& end, std::size_t point) { return end.row.points[point].pose.position_m; };
    const PlanQuad ground =
        ground_between({place(from, from.range.first), place(to, to.range.first), place(to, to.range.last), place(from, from.range.last)});
    bool covered = false;
    footprints.near(ground, [&](const RoadFootprint& other) {
        const bool level =
            other.paved.lowest_m < ground.highest_m + same_height_m && other.paved.highest_m > ground.lowest_m - same_height_m;
        covered = covered ||
                  (level && !footprints.continues(road, from.row.s_m, to.row.s_m, other) && overlap(ground, other.paved, overlap_margin_m));
    });
    return covered ? RoadMaterial::asphalt : strip.material;
}

} // namespace

Scene build_scene(const RoadNetwork& network, const RoadMeshOptions& options) {
    Scene scene;
    scene.materials = road_materials(options.surface);
    if (options.textures)
        add_road_textures(scene, options.seed);
    std::vector<SurfacePlan> plans;
    plans.reserve(network.roads.size());
    for (const Road& road : network.roads)
        plans.push_back(plan_surface(network, road, options));
    const Footprints footprints(network, plans);
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const SurfaceRows surface = append_surface(
            scene, network, plans[i], [&](const StripEnd& from, const StripEnd& to) { return junction_paint(footprints, i, from, to); });
        append_terrain(scene, plans[i], i, surface, footprints, options);
        append_objects(scene, network, plans[i], options);
        if (options.signals)
            append_signals(scene, network, plans[i]);
    }
    return scene;
}

} // namespace fernlicht
