// Rows of vertices across a road, and the triangles between two of them.
#pragma once

#include "scenarios/roads/mesh/mesh_builder.h"
#include "scenarios/roads/mesh/mesh_cross_section.h"

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

} // namespace fernlicht
