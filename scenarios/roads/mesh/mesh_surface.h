// The paved surface of one road as chunks of triangles: where it is cut across, the rows of vertices there, and the triangles between them.
#pragma once

#include "scenarios/roads/mesh/mesh_builder.h"
#include "scenarios/roads/mesh/mesh_cross_section.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace fernlicht {

/// A place on the road's surface, lane height included.
struct RowPoint {
    double t_m = 0.0, h_m = 0.0;
    Pose pose; ///< position with the height; axes of the surface
};

/// The points of one station from right to left. Both stretches that meet there use the same ones, so that no edge of one ends inside
/// an edge of the other. A kerb has two points at one t.
struct Row {
    double s_m = 0.0;
    std::vector<RowPoint> points;
};

/// The points of one strip in a row.
struct Range {
    std::size_t first = 0, last = 0;
};

/// Points at every border of both cross-sections and at the crown lines; borders nearer than 0.1 mm are one. Where the heights of the
/// two differ (a kerb that begins with a lane section), those of `after` count, and the end of the stretch before is a ramp.
Row make_row(const RoadNetwork& network, const Road& road, double s_m, const std::vector<Strip>& before, const std::vector<Strip>& after,
             const std::vector<double>& crown);

/// Where each strip of one of the two cross-sections lies in the row.
std::vector<Range> ranges_in(const Row& row, const std::vector<Strip>& strips);

/// One side of a strip: its place in a cross-section there, and in a row.
struct StripEnd {
    const Strip& strip;
    const Row& row;
    Range range;
};

/// Triangles of one strip between two rows, `from` at the smaller s. Each advance takes the shorter diagonal. Where the road is
/// folded, because it is wider than the radius of its bend, the triangles beyond the bend's centre are turned over: all face up.
void append_strip(MeshBuilder& builder, std::uint32_t material, const StripEnd& from, const StripEnd& to);

/// A stretch between two neighbouring stations; all of it lies in one lane section and one chunk.
struct RoadStretch {
    std::size_t profile = 0; ///< into the road's profiles
    double from_s_m = 0.0, to_s_m = 0.0;
    std::size_t chunk = 0;
    double layout_s_m() const { return 0.5 * (from_s_m + to_s_m); }
};

/// How a road will be cut: all that is needed to compute any of its rows.
struct SurfacePlan {
    const Road* road = nullptr;
    std::vector<SectionProfile> profiles;
    /// Lateral positions, constant in t, that every row has where it reaches so far: the knots of the lateral shape and what bisection adds
    /// between them. Empty without shape.
    std::vector<double> crown;
    std::vector<RoadStretch> stretches; ///< of the whole road in order

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
