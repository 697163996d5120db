// From a point of the world to the road under it: which road, where along it, how far beside its reference line, on which lane.
// Where a lane leads at the end of its lane section: the next section, the next road, a road through a junction.
#pragma once

#include "scenarios/roads/road_network.h"

#include <glm/vec2.hpp>
#include <unordered_map>

namespace fernlicht {

struct RoadPlace {
    std::size_t road = 0; ///< into network.roads
    double s_m = 0.0, t_m = 0.0;
    int lane = 0; ///< 0: beside all lanes
};

class RoadFinder {
  public:
    /// The network must outlive the finder.
    explicit RoadFinder(const RoadNetwork& network);

    /// The road on whose lanes the point lies; of several (junctions, ramps) `preferred` if it is among them, else the one whose direction
    /// (either way) is nearest to `heading_rad`; where it lies on none, the nearest. nullopt only for a network without geometry. Heights
    /// are not looked at: of two roads one above the other either may be meant, unless one is preferred.
    std::optional<RoadPlace> find(const glm::dvec2& point_m, std::optional<double> heading_rad = {},
                                  std::optional<std::size_t> preferred = {}) const;

  private:
    struct Sample {
        std::size_t road;
        double s_m, x_m, y_m;
    };
    struct Nearest {
        const Sample* sample;
        double square;
    };
    std::optional<RoadPlace> refined(const Sample& sample, const glm::dvec2& point_m) const;
    std::vector<Nearest> nearest_samples(const glm::dvec2& point_m) const;

    const RoadNetwork* network_;
    std::vector<Sample> samples_;
    std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

/// The lane at s and t; of lanes without width none. 0: beside all of them.
int lane_at(const Road& road, double s_m, double t_m);
/// t of a lane's centre; of lane 0 the lane offset. Throws std::out_of_range for an unknown lane.
double lane_centre_t(const Road& road, int lane, double s_m);

/// A lane of one lane section, with the direction in which it is followed.
struct LanePlace {
    std::size_t road = 0, section = 0; ///< into network.roads, road.sections
    int lane = 0;
    bool with_s = true;
    bool operator==(const LanePlace&) const = default;
};

/// The lane with this id; nullptr for none and for the centre.
const Lane* lane_of(const LaneSection& section, int id);

/// All places the lane leads to, the one with the least turn first; empty where the lane ends.
std::vector<LanePlace> next_places(const RoadNetwork& network, const LanePlace& from);

} // namespace fernlicht
