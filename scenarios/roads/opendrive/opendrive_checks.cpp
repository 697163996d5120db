// Rules of OpenDRIVE that span several parts of a file. What breaks them is played all the same: each breach is a warning.
#include "scenarios/roads/opendrive/opendrive_parts.h"
#include "scenarios/roads/plan.h"
#include "scenarios/roads/road_finder.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <set>

namespace fernlicht::opendrive {
namespace {

constexpr double no_width_m = 0.001;

std::vector<pugi::xml_node> children(pugi::xml_node parent, const char* name) {
    const auto all = parent.children(name);
    return {all.begin(), all.end()};
}

/// The lane's element within its laneSection; the section itself when there is none.
pugi::xml_node lane_node(pugi::xml_node section, int id) {
    for (const pugi::xml_node part : section.children())
        for (const pugi::xml_node lane : part.children("lane"))
            if (lane.attribute("id").as_int() == id)
                return lane;
    return section;
}

/// All predecessors or successors that the file names; the values keep the first only.
std::vector<int> lane_links(pugi::xml_node lane, const char* name) {
    std::vector<int> ids;
    for (const pugi::xml_node link : lane.child("link").children(name))
        ids.push_back(link.attribute("id").as_int());
    return ids;
}

/// An end of a road, at which its lanes meet others.
struct RoadEnd {
    const Road& road;
    bool start = true;
};

/// "the start of road '1'"
std::string name_of(const RoadEnd& end) { return fmt::format("the {} of {}", end.start ? "start" : "end", named("road", end.road.id)); }

const LaneSection& section_of(const RoadEnd& end) { return end.start ? end.road.sections.front() : end.road.sections.back(); }

double end_s(const RoadEnd& end) { return end.start ? 0.0 : end.road.length_m; }

struct Edges {
    glm::dvec3 a_m, b_m;
};

/// A lane's two edges at the road's end, the one on the left of growing s first.
Edges edge_points(const RoadNetwork& network, const RoadEnd& end, int lane) {
    const double s = end_s(end);
    const LaneEdges edges = lane_edges(end.road, section_of(end), lane, s);
    return {surface_pose(network, end.road, s, std::max(edges.inner_t_m, edges.outer_t_m)).position_m,
            surface_pose(network, end.road, s, std::min(edges.inner_t_m, edges.outer_t_m)).position_m};
}

/// How two lanes meet that are said to be one: by how much their edges part.
struct LaneMeeting {
    bool without_width = false; ///< one of them has none there
    double gap_m = 0.0;
};

LaneMeeting meet(const RoadNetwork& network, const RoadEnd& from, int from_lane, const RoadEnd& to, int to_lane) {
    const Edges here = edge_points(network, from, from_lane);
    Edges there = edge_points(network, to, to_lane);
    if (from.start == to.start) // the roads run against each other: left is right
        std::swap(there.a_m, there.b_m);
    if (glm::distance(here.a_m, here.b_m) < no_width_m || glm::distance(there.a_m, there.b_m) < no_width_m)
        return {true, 0.0};
    return {false, std::max(glm::distance(here.a_m, there.a_m), glm::distance(here.b_m, there.b_m))};
}

struct Meeting {
    const RoadNetwork& network;
    RoadEnd from, to;
    pugi::xml_node node;    ///< of the link
    pugi::xml_node section; ///< of the first road, at its end
};

/// All lanes that the first road links across this meeting.
void check_lanes(XmlFile& xml, const Meeting& m) {
    double worst = 0.0;
    int worst_lane = 0;
    for (const Lane& lane : section_of(m.from).lanes) {
        if (lane.id == 0)
            continue;
        const std::vector<int> targets = lane_links(lane_node(m.section, lane.id), m.from.start ? "predecessor" : "successor");
        if (targets.size() > 1)
            xml.warn_once(m.node, "several successors",
                          fmt::format("lane {} at {} leads to several lanes; the first is followed", lane.id, name_of(m.from)));
        for (const int target : targets) {
            if (!lane_of(section_of(m.to), target)) {
                xml.warn(m.node, fmt::format("lane {} at {} leads to lane {}, which {} does not have; it ends there", lane.id,
                                             name_of(m.from), target, name_of(m.to)));
                continue;
            }
            const LaneMeeting meeting = meet(m.network, m.from, lane.id, m.to, target);
            if (meeting.without_width)
                xml.warn(m.node, fmt::format("lane {} at {} is linked to lane {}, where one of them has no width", lane.id, name_of(m.from),
                                             target));
            if (meeting.gap_m > worst && targets.size() == 1)
                worst = meeting.gap_m, worst_lane = lane.id;
        }
    }
    if (worst > reported_gap_m)
        xml.warn(m.node, fmt::format("lane {} jumps by {:.3f} m from {} to {}", worst_lane, worst, name_of(m.from), name_of(m.to)));
}

void check_meeting(XmlFile& xml, const Meeting& m) {
    const PlanPoint here = plan_point(m.from.road, end_s(m.from)), there = plan_point(m.to.road, end_s(m.to));
    const bool plain = m.from.road.junction == "-1" && m.to.road.junction == "-1"; // through junctions reference lines may part
    if (const double gap = std::hypot(here.x_m - there.x_m, here.y_m - there.y_m); plain && gap > reported_gap_m)
        xml.warn(m.node, fmt::format("{} lies {:.3f} m from {}, which it is linked to", name_of(m.from), gap, name_of(m.to)));
    const std::optional<RoadLink>& back = m.to.start ? m.to.road.predecessor : m.to.road.successor;
    const std::string& junction = m.from.road.junction;
    const bool leads_back = back && (back->is_junction ? junction == back->id || junction == "-1" : back->id == m.from.road.id);
    if (!leads_back)
        xml.warn(m.node, fmt::format("{} leads to {}, which does not lead back", name_of(m.from), name_of(m.to)));
    check_lanes(xml, m);
}

void check_link(XmlFile& xml, const RoadNetwork& network, const RoadEnd& end, pugi::xml_node road_node) {
    const std::optional<RoadLink>& link = end.start ? end.road.predecessor : end.road.successor;
    const pugi::xml_node node = road_node.child("link").child(end.start ? "predecessor" : "successor");
    if (!link) {
        for (const Lane& lane : section_of(end).lanes)
            if (lane.id != 0 && (end.start ? lane.predecessor : lane.successor))
                xml.warn_once(road_node, "lane without road " + end.road.id,
                              fmt::format("lane {} leads on from {}, which leads nowhere; it ends there", lane.id, name_of(end)));
        return;
    }
    if (link->is_junction) {
        if (std::ranges::find(network.junctions, link->id, &Junction::id) == network.junctions.end())
            xml.warn(node,
                     fmt::format("{} leads to {}, which does not exist; the road ends there", name_of(end), named("junction", link->id)));
        return;
    }
    const std::vector<pugi::xml_node> sections = children(road_node.child("lanes"), "laneSection");
    const std::size_t last = std::min(end.road.sections.size(), sections.size()); // sections beyond the road's end were left out
    const pugi::xml_node section = last == 0 ? pugi::xml_node() : sections[end.start ? 0 : last - 1];
    if (const Road* to = network.find(link->id))
        check_meeting(xml, {network, end, {*to, link->contact_start}, node, section});
    else
        xml.warn(node, fmt::format("{} leads to {}, which does not exist; the road ends there", name_of(end), named("road", link->id)));
}

/// Where several roads go on from one end, a junction must say which is taken.
void check_forks(XmlFile& xml, const RoadNetwork& network, const std::vector<pugi::xml_node>& road_nodes) {
    std::map<std::pair<std::string, bool>, std::vector<std::size_t>> comers;
    for (std::size_t i = 0; i < network.roads.size(); ++i)
        for (const auto& link : {network.roads[i].predecessor, network.roads[i].successor})
            if (link && !link->is_junction && network.roads[i].junction == "-1")
                comers[{link->id, link->contact_start}].push_back(i);
    for (const auto& [end, roads] : comers)
        if (roads.size() > 1)
            xml.warn(road_nodes[roads.back()],
                     fmt::format("{} roads are linked to the {} of {} without a junction; the one that it names is taken", roads.size(),
                                 end.second ? "start" : "end", named("road", end.first)));
}

struct Side {
    const Road& road;
    const LaneSection& section;
    pugi::xml_node node;
    double s;
};

double width_of(const Side& side, int lane) {
    const LaneEdges edges = lane_edges(side.road, side.section, lane, side.s);
    return std::abs(edges.outer_t_m - edges.inner_t_m);
}

struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
};

Span span_of(const Side& side, const std::vector<int>& lanes) {
    Span span;
    for (const int lane : lanes) {
        const LaneEdges edges = lane_edges(side.road, side.section, lane, side.s);
        span.low = std::min({span.low, edges.inner_t_m, edges.outer_t_m});
        span.high = std::max({span.high, edges.inner_t_m, edges.outer_t_m});
    }
    return span;
}

/// A lane that splits, or lanes that join, cover the same width before and after.
void check_joint(XmlFile& xml, const Side& before, const Side& after, const Lane& lane, const std::vector<int>& targets) {
    std::vector<int> sources;
    for (const Lane& other : before.section.lanes) {
        const std::vector<int> reached = lane_links(lane_node(before.node, other.id), "successor");
        if (std::ranges::find_first_of(reached, targets) != reached.end())
            sources.push_back(other.id);
    }
    const Span a = span_of(before, sources), b = span_of(after, targets);
    const double gap = std::max(std::abs(a.low - b.low), std::abs(a.high - b.high));
    if (gap > reported_gap_m)
        xml.warn(lane_node(before.node, lane.id),
                 fmt::format("{}: the edges of lane {} jump by {:.3f} m at s = {}", named("road", before.road.id), lane.id, gap, before.s));
}

void check_lane(XmlFile& xml, const Side& before, const Side& after, const Lane& lane) {
    const pugi::xml_node node = lane_node(before.node, lane.id);
    const std::string road_name = named("road", before.road.id);
    std::vector<int> targets = lane_links(node, "successor");
    if (targets.empty() && lane_of(after.section, lane.id) && width_of(before, lane.id) > no_width_m &&
        width_of(after, lane.id) > no_width_m)
        xml.warn_once(node, "unlinked lane " + before.road.id,
                      fmt::format("{}: lane {} has no link over s = {}; a lane that goes on there is taken for the same", road_name,
                                  lane.id, before.s));
    if (targets.size() > 1)
        xml.warn_once(node, "several successors",
                      fmt::format("{}: lane {} has several successors at s = {}; the first is followed", road_name, lane.id, before.s));
    for (const int target : targets) {
        if (!lane_of(after.section, target)) {
            xml.warn(node, fmt::format("{}: lane {} leads to lane {}, which the section at s = {} does not have; it ends there", road_name,
                                       lane.id, target, before.s));
            continue;
        }
        const std::vector<int> back = lane_links(lane_node(after.node, target), "predecessor");
        if (std::ranges::find(back, lane.id) == back.end())
            xml.warn(node,
                     fmt::format("{}: lane {} leads to lane {} at s = {}, which does not lead back", road_name, lane.id, target, before.s));
        if (width_of(before, lane.id) < no_width_m || width_of(after, target) < no_width_m)
            xml.warn(node, fmt::format("{}: lanes {} and {} are linked at s = {}, where one of them has no width", road_name, lane.id,
                                       target, before.s));
    }
    std::erase_if(targets, [&](int id) { return !lane_of(after.section, id); });
    if (!targets.empty())
        check_joint(xml, before, after, lane, targets);
}

void check_back(XmlFile& xml, const Side& before, const Side& after, const Lane& lane) {
    const pugi::xml_node node = lane_node(after.node, lane.id);
    for (const int source : lane_links(node, "predecessor"))
        if (!lane_of(before.section, source))
            xml.warn(node, fmt::format("{}: lane {} comes from lane {}, which the section before s = {} does not have; it begins there",
                                       named("road", after.road.id), lane.id, source, after.s));
}

void check_sections(XmlFile& xml, const Road& road, pugi::xml_node road_node) {
    const std::vector<pugi::xml_node> nodes = children(road_node.child("lanes"), "laneSection");
    for (std::size_t i = 1; i < road.sections.size() && i < nodes.size(); ++i) {
        const double s = road.sections[i].s_m;
        const Side before{road, road.sections[i - 1], nodes[i - 1], s}, after{road, road.sections[i], nodes[i], s};
        for (const Lane& lane : before.section.lanes)
            if (lane.id != 0)
                check_lane(xml, before, after, lane);
        for (const Lane& lane : after.section.lanes)
            if (lane.id != 0)
                check_back(xml, before, after, lane);
    }
}

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
void check_contact(XmlFile& xml, const Crossing& c, const Road& connecting) {
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

void check_lane_links(XmlFile& xml, const Crossing& c, const Road* incoming, const RoadEnd& to) {
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
    if (worst > reported_gap_m)
        xml.warn(c.node, fmt::format("{}: lane {} jumps by {:.3f} m", through(c), worst_lane, worst));
}

void check_connection(XmlFile& xml, const Crossing& c) {
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

void check_junctions(XmlFile& xml, const RoadNetwork& network) {
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

} // namespace

void check_links(XmlFile& xml, const RoadNetwork& network) {
    const std::vector<pugi::xml_node> road_nodes = children(xml.root(), "road");
    for (std::size_t i = 0; i < network.roads.size(); ++i)
        check_sections(xml, network.roads[i], road_nodes[i]);
    for (std::size_t i = 0; i < network.roads.size(); ++i)
        for (const bool start : {true, false})
            check_link(xml, network, {network.roads[i], start}, road_nodes[i]);
    check_forks(xml, network, road_nodes);
    check_junctions(xml, network);
}

} // namespace fernlicht::opendrive
