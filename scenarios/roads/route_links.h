// Where a lane leads at the end of its lane section: the next section, the next road, a road through a junction.
#pragma once

#include "scenarios/roads/road_network.h"

namespace fernlicht {

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
