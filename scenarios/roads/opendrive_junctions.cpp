#include "scenarios/roads/opendrive_parts.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht::opendrive {

void read_junctions(OpenDriveXml& xml, RoadNetwork& network) {
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

namespace {

bool has_junction(const RoadNetwork& network, const std::string& id) {
    return std::any_of(network.junctions.begin(), network.junctions.end(), [&](const Junction& junction) { return junction.id == id; });
}

void check_road_link(OpenDriveXml& xml, const RoadNetwork& network, pugi::xml_node node) {
    if (!node)
        return;
    const bool junction = xml.text(node, "elementType", "road") == "junction";
    const std::string id = xml.text(node, "elementId");
    if (junction ? !has_junction(network, id) : network.find(id) == nullptr)
        xml.warn(node, fmt::format("the {} leads to {}, which does not exist; the road ends there", node.name(),
                                   named(junction ? "junction" : "road", id)));
}

} // namespace

void check_links(OpenDriveXml& xml, const RoadNetwork& network) {
    for (const pugi::xml_node node : xml.root().children("road")) {
        check_road_link(xml, network, node.child("link").child("predecessor"));
        check_road_link(xml, network, node.child("link").child("successor"));
    }
}

} // namespace fernlicht::opendrive
