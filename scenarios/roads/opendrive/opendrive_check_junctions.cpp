#include "scenarios/roads/opendrive/opendrive_checks.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace fernlicht::opendrive {
namespace {

struct Crossing {
    const RoadNetwork& network;
    const Junction& junction;
    const Junction::Connection& connection;
    pugi::xml_node node;
    std::string kind; ///< "default", "direct", "virtual"
};

std::string through(const Crossing& c) {
    return fmt::format("{}, from {} to {}", named("junction", c.junction.id), named("road", c.connection.incoming_road),
                       named("road", c.connection.connecting_road));
}

/// A connection that begins at a connecting road's start must come from the road which that names as its predecessor.
void check_contact(OpenDriveXml& xml, const Crossing& c, const Road& connecting) {
    const std::optional<RoadLink>& link = c.connection.contact_start ? connecting.predecessor : connecting.successor;
    if (!link || link->is_junction || link->id != c.connection.incoming_road)
        xml.warn(c.node, fmt::format("{}: the {} of the connecting road does not lead to the incoming road", through(c),
                                     c.connection.contact_start ? "start" : "end"));
}

/// The end of the incoming road that leads into the junction; a road may do so with both: then the one whose lane lies nearer.
LaneMeeting meet_incoming(const Crossing& c, const Road& incoming, int from, const RoadEnd& to, int to_lane) {
    LaneMeeting best{false, std::numeric_limits<double>::infinity()};
    for (const RoadEnd& end : {RoadEnd{incoming, true}, RoadEnd{incoming, false}}) {
        const std::optional<RoadLink>& link = end.start ? incoming.predecessor : incoming.successor;
        if (!link || !link->is_junction || link->id != c.junction.id || !lane_of(section_of(end), from))
            continue;
        const LaneMeeting meeting = meet(c.network, end, from, to, to_lane);
        if (meeting.gap_m < best.gap_m)
            best = meeting;
    }
    return best;
}

void check_lane_links(OpenDriveXml& xml, const Crossing& c, const Road* incoming, const RoadEnd& to) {
    double worst = 0.0;
    int worst_lane = 0;
    for (const auto& [from, to_lane] : c.connection.lane_links) {
        const Lane* lane = lane_of(section_of(to), to_lane);
        if (!lane) {
            xml.warn(c.node, fmt::format("{}: lane {} leads to lane {}, which does not exist; it ends there", through(c), from, to_lane));
            continue;
        }
        if (lane->type == "driving" && travels_with_s(to.road, *lane) != to.start)
            xml.warn_once(c.node, "against direction",
                          fmt::format("{}: lane {} leads into lane {} against its direction", through(c), from, to_lane));
        if (!incoming)
            continue;
        const LaneMeeting meeting = meet_incoming(c, *incoming, from, to, to_lane);
        if (meeting.without_width)
            xml.warn(c.node, fmt::format("{}: lanes {} and {} are linked, where one of them has no width", through(c), from, to_lane));
        if (std::isfinite(meeting.gap_m) && meeting.gap_m > worst)
            worst = meeting.gap_m, worst_lane = from;
    }
    if (worst > told_gap_m)
        xml.warn(c.node, fmt::format("{}: lane {} jumps by {:.3f} m", through(c), worst_lane, worst));
}

void check_connection(OpenDriveXml& xml, const Crossing& c) {
    const Road* incoming = c.network.find(c.connection.incoming_road);
    const Road* connecting = c.network.find(c.connection.connecting_road);
    if (!incoming && c.kind != "virtual")
        xml.warn(c.node, fmt::format("{}: the incoming road does not exist; nothing comes from there", through(c)));
    if (!connecting)
        xml.warn(c.node, fmt::format("{}: the connecting road does not exist; the connection is left out", through(c)));
    if (!connecting || c.kind != "default")
        return;
    if (!c.node.attribute("contactPoint"))
        xml.warn(c.node, fmt::format("{}: the contact point is missing; the connecting road's start is taken", through(c)));
    if (incoming && incoming->junction != "-1")
        xml.warn(c.node, fmt::format("{}: the incoming road is itself a connecting road", through(c)));
    check_contact(xml, c, *connecting);
    check_lane_links(xml, c, incoming, {*connecting, c.connection.contact_start});
}

} // namespace

void check_junctions(OpenDriveXml& xml, const RoadNetwork& network) {
    auto junction = network.junctions.begin();
    for (const pugi::xml_node node : xml.root().children("junction")) {
        std::set<std::pair<std::string, std::string>> pairs;
        auto connection = junction->connections.begin();
        for (const pugi::xml_node child : node.children("connection")) {
            const Crossing crossing{network, *junction, *connection, child, xml.text(node, "type", "default")};
            check_connection(xml, crossing);
            if (crossing.kind == "default" && !pairs.emplace(connection->incoming_road, connection->connecting_road).second)
                xml.warn(child, fmt::format("{}: a second connection of the same roads", through(crossing)));
            ++connection;
        }
        ++junction;
    }
}

} // namespace fernlicht::opendrive
