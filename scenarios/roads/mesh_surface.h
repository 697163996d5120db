// The paved surface of one road as chunks of triangles.
#pragma once

#include "scenarios/roads/mesh_row.h"
#include "scenarios/roads/mesh_stations.h"

#include <functional>
#include <string>
#include <vector>

namespace fernlicht {

/// How a road will be cut: all that is needed to compute any of its rows.
struct SurfacePlan {
    const Road* road = nullptr;
    std::vector<SectionProfile> profiles;
    std::vector<double> crown;
    std::vector<Stretch> stretches;

    const SectionProfile& profile(const Stretch& stretch) const { return profiles[stretch.profile]; }
};

SurfacePlan plan_surface(const RoadNetwork& network, const Road& road, const RoadMeshOptions& options);

/// A stretch with its rows: what terrain joins to.
struct StretchRows {
    const Stretch* stretch;
    Row from, to;
};

/// Called with each cell (one strip of one stretch) before it is built; returns the material to use.
using Repaint = std::function<RoadMaterial(const Strip&, const Row& from, const Row& to, std::size_t strip)>;

/// Adds the meshes "road ID s 120-180" to the scene and returns the rows of every stretch, in order.
std::vector<StretchRows> append_surface(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan, const Repaint& repaint);

/// "road 12 s 120-180"
std::string chunk_name(const char* what, const SurfacePlan& plan, std::size_t first_stretch);

} // namespace fernlicht
