// Rules of OpenDRIVE that span several parts of a file. What breaks them is played all the same: each breach is a warning.
#pragma once

#include "scenarios/roads/opendrive/opendrive_parts.h"
#include "scenarios/roads/route_links.h"

namespace fernlicht::opendrive {

/// An end of a road, at which its lanes meet others.
struct RoadEnd {
    const Road& road;
    bool start = true;
};
std::string name_of(const RoadEnd& end); ///< "the start of road '1'"
const LaneSection& section_of(const RoadEnd& end);

/// How two lanes meet that are said to be one: by how much their edges part.
struct LaneMeeting {
    bool without_width = false; ///< one of them has none there
    double gap_m = 0.0;
};
LaneMeeting meet(const RoadNetwork& network, const RoadEnd& from, int from_lane, const RoadEnd& to, int to_lane);

inline constexpr double told_gap_m = 0.01; ///< smaller steps are rounding of exporters
inline constexpr double no_width_m = 0.001;

/// Lanes of one section against those of the next, within each road.
void check_sections(OpenDriveXml& xml, const Road& road, pugi::xml_node road_node);
/// Roads that follow one another without a junction, and connecting roads against the roads they join.
void check_roads(OpenDriveXml& xml, const RoadNetwork& network, const std::vector<pugi::xml_node>& road_nodes);
/// Connections of junctions.
void check_junctions(OpenDriveXml& xml, const RoadNetwork& network);

/// The lane's element within its laneSection; the section itself when there is none.
pugi::xml_node lane_node(pugi::xml_node section, int id);
/// All predecessors or successors that the file names; the values keep the first only.
std::vector<int> lane_links(pugi::xml_node lane, const char* name);

} // namespace fernlicht::opendrive
