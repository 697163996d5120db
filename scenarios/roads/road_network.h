// A road network as geometry: arc length to pose, lanes, marks, objects. Plain values, read from OpenDRIVE.
// A road network seen in a mirror: what lies left of a road lies right of it, and traffic keeps to the other side.
#pragma once

#include "scenarios/values/files.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace fernlicht {

/// a + b ds + c ds^2 + d ds^3 with ds = s - s0.
struct Cubic {
    double s0 = 0.0, a = 0.0, b = 0.0, c = 0.0, d = 0.0;
    double at(double s) const { return a + (s - s0) * (b + (s - s0) * (c + (s - s0) * d)); }
    double slope(double s) const { return b + (s - s0) * (2.0 * c + (s - s0) * 3.0 * d); }
};

struct Line {};
struct Arc {
    double curvature_per_m = 0.0;
};
struct Spiral {
    double start_per_m = 0.0, end_per_m = 0.0;
    std::vector<glm::dvec2> steps_m = {}; ///< cache of prepare(): local positions at equal steps; may be empty
};
/// v(u) in the element's own frame; s is the arc length of the curve, not u.
struct Poly3 {
    double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
    struct Knot {
        double s_m, u_m;
    };
    std::vector<Knot> knots = {}; ///< cache of prepare(): arc length against u; may be empty
};
struct ParamPoly3 {
    double au = 0.0, bu = 0.0, cu = 0.0, du = 0.0, av = 0.0, bv = 0.0, cv = 0.0, dv = 0.0;
    bool normalized = true; ///< parameter 0..1 over the element, else 0..length
};

/// One element of a reference line in the ground plane.
struct PlanElement {
    double s_m = 0.0, x_m = 0.0, y_m = 0.0, heading_rad = 0.0, length_m = 0.0;
    std::variant<Line, Arc, Spiral, Poly3, ParamPoly3> shape;
};

/// Lateral profile: height over t, piecewise cubic in t (OpenDRIVE `shape`).
struct ShapeProfile {
    double s_m = 0.0;
    std::vector<Cubic> over_t; ///< s0 is t here
};

enum class MarkKind { none, solid, broken, solid_solid, solid_broken, broken_solid, broken_broken, botts_dots, curb, other };

struct RoadMark {
    double s_m = 0.0; ///< from the lane section's start
    MarkKind kind = MarkKind::none;
    double width_m = 0.12;
    std::string colour = "white";
    /// explicit lines (OpenDRIVE `type`/`line`), else by kind: dash length, gap, lateral offset, start offset
    struct Stripe {
        double width_m, dash_m, gap_m, t_m, start_m;
    };
    std::vector<Stripe> stripes;
};

struct Lane {
    int id = 0; ///< left positive, right negative, 0 the centre without width
    std::string type = "driving";
    bool level = false;
    bool reversed = false;      ///< driven against the side's usual direction (OpenDRIVE 1.8 `direction`)
    std::vector<Cubic> widths;  ///< s0 relative to the section's start; empty when borders are given
    std::vector<Cubic> borders; ///< t of the outer edge; used when widths is empty
    std::vector<RoadMark> marks;
    struct Height {
        double s_m, inner_m, outer_m;
    };
    std::vector<Height> heights;
    std::optional<int> predecessor, successor;
};

struct LaneSection {
    double s_m = 0.0, end_m = 0.0;
    std::vector<Lane> lanes; ///< sorted by id, descending (leftmost first), id 0 included
};

struct RoadObject {
    std::string id, name, type;
    double s_m = 0.0, t_m = 0.0, z_offset_m = 0.0, heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
    double length_m = 0.0, width_m = 0.0, height_m = 0.0, radius_m = 0.0; ///< radius > 0: a post, else a box
    std::vector<glm::dvec3> outline_m;  ///< corners in the object's own frame (x, y, height above its base); empty: box or post
    std::vector<double> outline_base_m; ///< base of each corner above the object's origin; as many as corners
    bool closed_outline = true;
};

struct RoadSignal {
    std::string id;
    double s_m = 0.0, t_m = 0.0, z_offset_m = 0.0, heading_offset_rad = 0.0;
    double width_m = 0.0, height_m = 0.0; ///< 0: by type, else 0.6
    bool facing_forward = true;           ///< orientation "+": valid for traffic in +s, so its face looks towards -s
    bool dynamic = false;                 ///< traffic light
};

struct RoadLink {
    bool is_junction = false;
    std::string id;
    bool contact_start = true;
};

struct Road {
    std::string id, name, junction = "-1";
    double length_m = 0.0;
    bool left_hand_traffic = false;
    std::vector<PlanElement> plan;
    std::vector<Cubic> elevation, superelevation, lane_offset;
    std::vector<ShapeProfile> shapes;
    std::vector<LaneSection> sections;
    std::vector<RoadObject> objects;
    std::vector<RoadSignal> signals;
    std::optional<RoadLink> predecessor, successor;
};

struct Junction {
    struct Connection {
        std::string incoming_road, connecting_road;
        bool contact_start = true;
        std::vector<std::pair<int, int>> lane_links; ///< from incoming lane to connecting lane
    };
    std::string id;
    std::vector<Connection> connections;
};

struct RoadNetwork {
    std::string name;
    std::string geo_reference; ///< text of geoReference, "" if none
    glm::dvec3 offset_m{0.0};  ///< header offset that was added to every position
    double offset_heading_rad = 0.0;
    std::vector<Road> roads;
    std::vector<Junction> junctions;
    std::vector<std::string> warnings; ///< "file:line: what is wrong and how it was taken"
    FilesRead opened;

    const Road* find(const std::string& road_id) const;
};

/// Reads OpenDRIVE 1.4 to 1.8. Throws InputError with file, line and reason when the geometry cannot be meant;
/// what only looks odd is played and named in `warnings`.
RoadNetwork read_opendrive(const std::filesystem::path& path);

/// Pose on the reference line, without elevation: x, y, heading in `axes`. s is clamped to the road.
Pose plan_pose(const Road& road, double s_m);
/// Pose on the road's surface at (s, t): elevation, superelevation and lateral shape applied; x along s, z the surface normal.
/// t is measured from the reference line, left positive. Lane height offsets (kerbs) are not included.
Pose surface_pose(const RoadNetwork& network, const Road& road, double s_m, double t_m);

/// True when traffic on the lane moves towards growing s: by the side of the road and the traffic rule.
bool travels_with_s(const Road& road, const Lane& lane);

const LaneSection& section_at(const Road& road, double s_m);
/// Outer and inner edge of a lane as t (lane offset included), at s. Throws std::out_of_range for an unknown lane.
struct LaneEdges {
    double inner_t_m, outer_t_m;
};
LaneEdges lane_edges(const Road& road, const LaneSection& section, int lane_id, double s_m);

/// The last piece that begins at or before `s`; nullptr before the first: nothing is defined there, which OpenDRIVE takes as zero.
inline const Cubic* piece_at(const std::vector<Cubic>& pieces, double s) {
    if (pieces.size() == 1)
        return s >= pieces.front().s0 ? &pieces.front() : nullptr;
    const auto after = std::ranges::upper_bound(pieces, s, {}, &Cubic::s0);
    return after == pieces.begin() ? nullptr : &*(after - 1);
}

inline double value_at(const std::vector<Cubic>& pieces, double s) {
    const Cubic* piece = piece_at(pieces, s);
    return piece ? piece->at(s) : 0.0;
}

/// The same ground with y and -y exchanged (about the x-z plane). Lane ids change sign, as OpenDRIVE counts them from left to right; s, the
/// names of roads and the direction in which lanes are driven along s stay. Every pose on it is the mirror image of one on `network`, to
/// rounding; where a lateral profile has shapes these are written anew, elsewhere numbers only change their sign.
RoadNetwork mirrored(RoadNetwork network);

} // namespace fernlicht
