// Ground beside the roads, for light to fall on.
#pragma once

#include "scenarios/roads/mesh/mesh_footprint.h"

namespace fernlicht {

/// Verge (1.5 m) and terrain on both sides of a road, `options.verge_width_m` wide, narrower on the inside of bends so that it
/// does not fold. It starts on the road's outermost vertices and follows their height. Where it would cover another road it is
/// lowered to 5 cm below that road, loose from its own edge if need be: seen from above there is no hole. Over roads that lie
/// more than 4 m lower (bridges) it is left out.
void append_terrain(Scene& scene, const SurfacePlan& plan, std::size_t road_index, const SurfaceRows& surface, const Footprints& footprints,
                    const RoadMeshOptions& options);

} // namespace fernlicht
