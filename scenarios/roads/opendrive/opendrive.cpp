#include "scenarios/roads/opendrive/opendrive_parts.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/refusals.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using namespace opendrive;

void read_header(XmlFile& xml, RoadNetwork& network) {
    const pugi::xml_node header = xml.root().child("header");
    if (!header) {
        xml.warn(xml.root(), "the header is missing; the file is read as OpenDRIVE 1.8");
        return;
    }
    const int major = xml.integer(header, "revMajor", 1), minor = xml.integer(header, "revMinor", 8);
    if (!header.attribute("revMajor") || !header.attribute("revMinor"))
        xml.warn(header, "the version is missing; the file is read as OpenDRIVE 1.8");
    else if (major != 1 || minor < 4 || minor > 8)
        xml.warn(header, fmt::format("the version {}.{} is read as if it were one from 1.4 to 1.8", major, minor));
    network.name = xml.text(header, "name");
    network.geo_reference = header.child("geoReference").text().get();
    if (const pugi::xml_node offset = header.child("offset")) {
        network.offset_m = {xml.number(offset, "x", 0.0), xml.number(offset, "y", 0.0), xml.number(offset, "z", 0.0)};
        network.offset_heading_rad = xml.number(offset, "hdg", 0.0);
    }
}

std::optional<RoadLink> read_road_link(XmlFile& xml, pugi::xml_node node) {
    if (!node)
        return {};
    return RoadLink{xml.text(node, "elementType", "road") == "junction", xml.text(node, "elementId"),
                    xml.text(node, "contactPoint", "start") != "end"};
}

Road read_road(XmlFile& xml, pugi::xml_node node, const RoadNetwork& network) {
    Road road;
    road.id = xml.text(node, "id");
    if (road.id.empty())
        xml.refuse(node, "id", "is missing", "the road's id");
    road.name = xml.text(node, "name");
    road.junction = xml.text(node, "junction", "-1");
    road.length_m = xml.length(node, "length", 0.0);
    const std::string rule = xml.text(node, "rule", "RHT");
    if (rule != "RHT" && rule != "LHT")
        xml.refuse(node, "rule", fmt::format("found '{}'", rule), "'RHT' or 'LHT'");
    road.left_hand_traffic = rule == "LHT";
    road.predecessor = read_road_link(xml, node.child("link").child("predecessor"));
    road.successor = read_road_link(xml, node.child("link").child("successor"));
    read_plan(xml, node, road);
    read_profiles(xml, node, road);
    read_lanes(xml, node, road);
    end_shapes(road);
    read_objects(xml, node, road);
    read_signals(xml, node, road);
    apply_offset(network, road);
    return road;
}

void read_junctions(XmlFile& xml, RoadNetwork& network) {
    for (const pugi::xml_node node : xml.root().children("junction")) {
        Junction junction;
        junction.id = xml.text(node, "id");
        for (const pugi::xml_node child : node.children("connection")) {
            Junction::Connection connection;
            connection.incoming_road = xml.text(child, "incomingRoad");
            // In direct junctions roads meet without a connecting road between them.
            connection.connecting_road = xml.text(child, "connectingRoad", xml.text(child, "linkedRoad"));
            connection.contact_start = xml.text(child, "contactPoint", "start") != "end";
            for (const pugi::xml_node link : child.children("laneLink"))
                connection.lane_links.emplace_back(xml.integer(link, "from"), xml.integer(link, "to"));
            junction.connections.push_back(std::move(connection));
        }
        network.junctions.push_back(std::move(junction));
    }
}

} // namespace

RoadNetwork read_opendrive(const std::filesystem::path& path) {
    RoadNetwork network;
    XmlFile xml(path, network.opened, "OpenDRIVE", "an OpenDRIVE file");
    read_header(xml, network);
    EachRead each;
    for (const pugi::xml_node node : xml.root().children("road"))
        each([&] {
            Road road = read_road(xml, node, network);
            if (network.find(road.id))
                xml.refuse(node, "id", fmt::format("found a second {}", named("road", road.id)), "each id once");
            network.roads.push_back(std::move(road));
        });
    each.end();
    if (network.roads.empty())
        xml.refuse(xml.root(), {}, "holds no road", "at least one road");
    read_junctions(xml, network);
    check_links(xml, network);
    check_spelling(xml);
    network.warnings = xml.take_warnings();
    return network;
}

const Road* RoadNetwork::find(const std::string& road_id) const {
    const auto road = std::ranges::find(roads, road_id, &Road::id);
    return road == roads.end() ? nullptr : &*road;
}

std::string opendrive::named(std::string_view element, const std::string& id) { return fmt::format("{} '{}'", element, printable(id)); }

} // namespace fernlicht
