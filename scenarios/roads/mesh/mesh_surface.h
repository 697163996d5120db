// The paved surface of one road as chunks of triangles.
// Where a road is cut across: at every place where something begins or ends, and between them as the chord error asks.
#pragma once

#include "scenarios/roads/mesh/mesh_cross_section.h"
#include "scenarios/roads/mesh/mesh_row.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace fernlicht {

/// A stretch between two neighbouring stations; all of it lies in one lane section and one chunk.
struct RoadStretch {
    std::size_t profile = 0; ///< into the road's profiles
    double from_s_m = 0.0, to_s_m = 0.0;
    std::size_t chunk = 0;
    double layout_s_m() const { return 0.5 * (from_s_m + to_s_m); }
};

/// Lateral positions, constant in t, that every row has where it reaches so far: the knots of the lateral shape and what
/// bisection adds between them. Empty without shape.
std::vector<double> crown_lines(const RoadNetwork& network, const Road& road, double chord_error_m);

/// Stretches of the whole road in order. `crown` from crown_lines.
/// Where the surface itself jumps (a profile with a step), stretches are not cut below 2 cm: the step becomes a steep ramp.
std::vector<RoadStretch> stretches_of(const RoadNetwork& network, const Road& road, const std::vector<SectionProfile>& profiles,
                                      const std::vector<double>& crown, const RoadMeshOptions& options);

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
