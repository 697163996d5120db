// A route through a network: follows one lane over road and junction borders; distance along it to pose and cross-section.
#pragma once

#include "scenarios/roads/plan.h"

#include <filesystem>
#include <span>

namespace fernlicht {

struct RouteLane {
    std::string name; ///< "own", "left 1", "right 1" ... as the driver sees it
    std::string type; ///< OpenDRIVE lane type: "driving", "shoulder", ...
    int road_lane_id = 0;
    bool same_direction = true;
    double left_m = 0.0; ///< offset of its left edge from the own lane's centre, left positive, seen in the direction of travel
    double right_m = 0.0;
};

struct CrossSection {
    std::vector<RouteLane> lanes;                   ///< from left to right as the driver sees them; every lane with width, driveable or not
    double paved_left_m = 0.0, paved_right_m = 0.0; ///< outer edges of driving, shoulder, stop, parking and biking lanes
};

/// Distances are metres along the centre of the own lane on the surface (what an odometer counts), not the reference line's s.
/// The network must outlive the route.
class Route {
  public:
    struct Start {
        std::string road; ///< id; "" = the first road that has driving lanes
        int lane = 0;     ///< 0 = outermost driving lane in travel direction of the traffic rule's side
        double s_m = 0.0;
        std::filesystem::path asked_in = {}; ///< the file that messages name; "": the road's
        std::string key = "route";           ///< of that file, in messages
    };
    /// Follows the lane in its direction of travel as far as the network goes, at junctions by the connection with the least turn,
    /// or by `via` (road ids in order) where given. A ring is driven once round. Throws InputError for unknown roads or lanes, naming
    /// those that exist, for a `via` that is never met, and for a start from which there is no way to go.
    Route(const RoadNetwork& network, Start start, const std::vector<std::string>& via = {});

    double length_m() const { return length_m_; }
    /// On the surface: x along travel, y left, z up (normal). `offset_left_m` from the own lane's centre. Distances are clamped to the
    /// route.
    Pose pose(double distance_m, double offset_left_m = 0.0) const;
    /// What does not depend on the offset, for callers that ask for many at one distance.
    struct Cut {
        double side, centre_t_m, centre_slope;
        SurfaceCut surface;
    };
    Cut cut(double distance_m) const;
    static Pose pose(const Cut& cut, double offset_left_m);
    /// The same for many offsets at one distance; as many poses as offsets.
    void poses(double distance_m, std::span<const double> offsets_left_m, std::span<Pose> poses) const;
    CrossSection cross_section(double distance_m) const;
    /// Road id and s, for reports.
    std::pair<std::string, double> place(double distance_m) const;

    struct Leg {
        std::size_t road; ///< into network.roads
        int lane;         ///< of the own lane in this leg
        bool with_s;      ///< travel towards growing s
        double from_s_m, to_s_m;
        double start_m;      ///< distance at which the leg begins
        std::size_t section; ///< into road.sections
    };
    const std::vector<Leg>& legs() const { return legs_; }

  private:
    /// A stretch on which every piece of the geometry is one polynomial and s a smooth function of the distance.
    struct Cell {
        double start_m, length_m; ///< distance
        double from_s_m, to_s_m;
        double from_slope, to_slope; ///< ds by distance at its ends
        Cubic centre;                ///< t of the lane's centre over s
        SurfaceStrip strip;
        std::size_t leg;
    };
    void add_cells(std::size_t leg);
    const Cell& cell_at(double distance_m) const;
    double s_at(const Cell& cell, double distance_m) const;

    const RoadNetwork* network_;
    std::vector<Leg> legs_; ///< one per road and lane section
    std::vector<Cell> cells_;
    double length_m_ = 0.0;
};

} // namespace fernlicht
