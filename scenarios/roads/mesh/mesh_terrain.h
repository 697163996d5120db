// Ground beside the roads, for light to fall on.
// Ground beyond the terrain beside the roads, so that by day no sky is seen below the horizon.
#pragma once

#include "scenarios/roads/mesh/mesh_footprint.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

/// Verge (1.5 m) and terrain on both sides of a road, `options.verge_width_m` wide, narrower on the inside of bends so that it
/// does not fold. It starts on the road's outermost vertices and follows their height. Where it would cover another road it is
/// lowered to 5 cm below that road, loose from its own edge if need be: seen from above there is no hole. Over roads that lie
/// more than 4 m lower (bridges) it is left out.
void append_terrain(Scene& scene, const SurfacePlan& plan, std::size_t road_index, const SurfaceRows& surface, const Footprints& footprints,
                    const RoadMeshOptions& options);

/// Adds level tiles of terrain's reflectance below all that the scene has, half a metre under its lowest point and 2.5 km farther than it
/// reaches. They are seen and lit, stand in no light's way and in no map. Nothing for an empty scene.
void add_far_ground(Scene& scene);

} // namespace fernlicht
