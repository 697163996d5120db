// The parts of an OpenDRIVE file, each read by its own function into the plain values of a road network.
// An OpenDRIVE file as XML.
#pragma once

#include "scenarios/roads/road_network.h"
#include "scenarios/values/xml_file.h"

namespace fernlicht {

class OpenDriveXml : public XmlFile {
  public:
    /// Throws InputError (xml_file.h), and where the root is not OpenDRIVE.
    OpenDriveXml(const std::filesystem::path& path, FilesRead& opened);
};

/// Words for messages: "road '12'".
std::string named(std::string_view element, const std::string& id);

} // namespace fernlicht

namespace fernlicht::opendrive {

/// planView: elements ascending in s, prepared, in the header's axes. Gaps are warned of.
void read_plan(OpenDriveXml& xml, pugi::xml_node road_node, Road& road);
/// Moves and turns all elements by the header's offset.
void apply_offset(const RoadNetwork& network, Road& road);

/// elevationProfile and lateralProfile.
void read_profiles(OpenDriveXml& xml, pugi::xml_node road_node, Road& road);
/// Left of the outermost lane each profile goes on with the slope it has there, so that what lies beside the road stays near it.
/// Needs the lanes.
void end_shapes(Road& road);
/// a + b ds + c ds^2 + d ds^3 of each `element`; `start` names the attribute of its beginning. Ascending.
std::vector<Cubic> read_cubics(OpenDriveXml& xml, pugi::xml_node parent, const char* element, const char* start);

/// lanes: offset, sections, widths, borders, heights.
void read_lanes(OpenDriveXml& xml, pugi::xml_node road_node, Road& road);
/// The road marks of one lane.
std::vector<RoadMark> read_marks(OpenDriveXml& xml, pugi::xml_node lane_node);

void read_objects(OpenDriveXml& xml, pugi::xml_node road_node, Road& road);
void read_signals(OpenDriveXml& xml, pugi::xml_node road_node, Road& road);
void read_junctions(OpenDriveXml& xml, RoadNetwork& network);

/// Rules that span several parts: links between roads, lanes and junctions. Each breach is a warning.
void check_links(OpenDriveXml& xml, const RoadNetwork& network);

} // namespace fernlicht::opendrive
