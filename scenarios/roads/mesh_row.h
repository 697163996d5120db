// Rows of vertices across a road, and the triangles between two of them.
#pragma once

#include "scenarios/roads/mesh_builder.h"
#include "scenarios/roads/mesh_cross_section.h"

#include <vector>

namespace fernlicht {

/// A place on the road's surface, lane height included.
struct RowPoint {
    double t_m = 0.0, h_m = 0.0;
    Pose pose; ///< position with the height; axes of the surface
};

/// The points of one station from right to left, as one of the two stretches that meet there sees them: its own strips, with the
/// other's borders inserted. Both have a point at every t where either has one, so no edge of one ends inside an edge of the other.
struct Row {
    struct Range {
        std::size_t first = 0, last = 0; ///< into points
    };
    double s_m = 0.0;
    std::vector<RowPoint> points;
    std::vector<Range> strips; ///< the points of each strip

    bool empty() const { return points.empty(); }
};

/// Every t of both cross-sections and of the crown, ascending; those nearer than 0.1 mm are one.
std::vector<double> common_borders(const std::vector<Strip>& before, const std::vector<Strip>& after, const std::vector<double>& crown);

Row make_row(const RoadNetwork& network, const Road& road, double s_m, const std::vector<Strip>& strips,
             const std::vector<double>& borders);

/// Triangles between strip `index` of two rows, `from` at the smaller s. Each advance takes the shorter diagonal.
void append_strip(MeshBuilder& builder, std::uint32_t material, const Strip& at_from, const Row& from, const Strip& at_to, const Row& to,
                  std::size_t index);

/// Upright faces where the heights of two cross-sections at one station differ (a kerb that begins with a lane section).
void append_risers(MeshBuilder& builder, const Row& before, const Row& after);

} // namespace fernlicht
