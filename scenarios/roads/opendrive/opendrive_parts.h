// The parts of an OpenDRIVE file, each read by its own function into the plain values of a road network.
#pragma once

#include "scenarios/roads/road_network.h"
#include "scenarios/values/xml_file.h"

namespace fernlicht::opendrive {

/// Words for messages: "road '12'".
std::string named(std::string_view element, const std::string& id);

/// Larger steps are told; smaller ones are rounding of exporters, who write positions to the centimetre.
inline constexpr double reported_gap_m = 0.01;

/// planView: elements ascending in s, prepared, in the header's axes. Gaps are warned of.
void read_plan(XmlFile& xml, pugi::xml_node road_node, Road& road);
/// Moves and turns all elements by the header's offset.
void apply_offset(const RoadNetwork& network, Road& road);

/// elevationProfile and lateralProfile.
void read_profiles(XmlFile& xml, pugi::xml_node road_node, Road& road);
/// Left of the outermost lane each profile goes on with the slope it has there, so that what lies beside the road stays near it.
/// Needs the lanes.
void end_shapes(Road& road);
/// a + b ds + c ds^2 + d ds^3 of each `element`; `start` names the attribute of its beginning. Ascending.
std::vector<Cubic> read_cubics(XmlFile& xml, pugi::xml_node parent, const char* element, const char* start);

/// lanes: offset, sections, widths, borders, heights.
void read_lanes(XmlFile& xml, pugi::xml_node road_node, Road& road);
/// The road marks of one lane.
std::vector<RoadMark> read_marks(XmlFile& xml, pugi::xml_node lane_node);

void read_objects(XmlFile& xml, pugi::xml_node road_node, Road& road);
void read_signals(XmlFile& xml, pugi::xml_node road_node, Road& road);

/// Rules that span several parts: links between roads, lanes and junctions. Each breach is a warning.
void check_links(XmlFile& xml, const RoadNetwork& network);
/// Warns of elements, attributes and words that are nearly OpenDRIVE's.
void check_spelling(XmlFile& xml);

} // namespace fernlicht::opendrive
