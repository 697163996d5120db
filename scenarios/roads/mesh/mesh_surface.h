// The paved surface of one road as chunks of triangles.
#pragma once

#include "scenarios/roads/mesh/mesh_row.h"
#include "scenarios/roads/mesh/mesh_stations.h"

#include <functional>
#include <string>
#include <vector>

namespace fernlicht {

/// How a road will be cut: all that is needed to compute any of its rows.
struct SurfacePlan {
    const Road* road = nullptr;
    std::vector<SectionProfile> profiles;
    std::vector<double> crown;
    std::vector<RoadStretch> stretches;

    const SectionProfile& profile(const RoadStretch& stretch) const { return profiles[stretch.profile]; }
};

SurfacePlan plan_surface(const RoadNetwork& network, const Road& road, const RoadMeshOptions& options);

/// The rows of a road, one a station, and where the strips of each stretch lie in the rows at its ends.
struct SurfaceRows {
    struct Ends {
        std::vector<Range> from, to;
    };
    std::vector<Row> rows;  ///< one more than there are stretches
    std::vector<Ends> ends; ///< of each stretch
    bool empty(std::size_t stretch) const { return ends[stretch].from.empty(); }
};

/// Called with each strip of each stretch before it is built; returns the material to use.
using Repaint = std::function<RoadMaterial(const StripEnd& from, const StripEnd& to)>;

/// Adds the meshes "road ID s 120-180" to the scene. Returns the rows, to which the terrain joins.
SurfaceRows append_surface(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan, const Repaint& repaint);

/// "road 12 s 120-180"
std::string chunk_name(const char* what, const SurfacePlan& plan, std::size_t first_stretch);

} // namespace fernlicht
