#include "scenarios/roads/opendrive/opendrive_parts.h"

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

} // namespace fernlicht::opendrive
