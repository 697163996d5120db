#include "scenarios/roads/opendrive/opendrive_checks.h"
#include "scenarios/roads/plan.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>

namespace fernlicht::opendrive {
namespace {

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

struct Meeting {
    const RoadNetwork& network;
    RoadEnd from, to;
    pugi::xml_node node;    ///< of the link
    pugi::xml_node section; ///< of the first road, at its end
};

/// All lanes that the first road links across this meeting.
void check_lanes(OpenDriveXml& xml, const Meeting& m) {
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
    if (worst > told_gap_m)
        xml.warn(m.node, fmt::format("lane {} jumps by {:.3f} m from {} to {}", worst_lane, worst, name_of(m.from), name_of(m.to)));
}

void check_meeting(OpenDriveXml& xml, const Meeting& m) {
    const PlanPoint here = plan_point(m.from.road, end_s(m.from)), there = plan_point(m.to.road, end_s(m.to));
    const bool plain = m.from.road.junction == "-1" && m.to.road.junction == "-1"; // through junctions reference lines may part
    if (const double gap = std::hypot(here.x_m - there.x_m, here.y_m - there.y_m); plain && gap > told_gap_m)
        xml.warn(m.node, fmt::format("{} lies {:.3f} m from {}, which it is linked to", name_of(m.from), gap, name_of(m.to)));
    const std::optional<RoadLink>& back = m.to.start ? m.to.road.predecessor : m.to.road.successor;
    const std::string& junction = m.from.road.junction;
    const bool leads_back = back && (back->is_junction ? junction == back->id || junction == "-1" : back->id == m.from.road.id);
    if (!leads_back)
        xml.warn(m.node, fmt::format("{} leads to {}, which does not lead back", name_of(m.from), name_of(m.to)));
    check_lanes(xml, m);
}

bool has_junction(const RoadNetwork& network, const std::string& id) {
    return std::any_of(network.junctions.begin(), network.junctions.end(), [&](const Junction& junction) { return junction.id == id; });
}

void check_link(OpenDriveXml& xml, const RoadNetwork& network, const RoadEnd& end, pugi::xml_node road_node) {
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
        if (!has_junction(network, link->id))
            xml.warn(node,
                     fmt::format("{} leads to {}, which does not exist; the road ends there", name_of(end), named("junction", link->id)));
        return;
    }
    std::vector<pugi::xml_node> sections;
    for (const pugi::xml_node section : road_node.child("lanes").children("laneSection"))
        sections.push_back(section);
    const std::size_t last = std::min(end.road.sections.size(), sections.size()); // sections beyond the road's end were left out
    const pugi::xml_node section = last == 0 ? pugi::xml_node() : sections[end.start ? 0 : last - 1];
    if (const Road* to = network.find(link->id))
        check_meeting(xml, {network, end, {*to, link->contact_start}, node, section});
    else
        xml.warn(node, fmt::format("{} leads to {}, which does not exist; the road ends there", name_of(end), named("road", link->id)));
}

/// Where several roads go on from one end, a junction must say which is taken.
void check_forks(OpenDriveXml& xml, const RoadNetwork& network, const std::vector<pugi::xml_node>& road_nodes) {
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

} // namespace

std::string name_of(const RoadEnd& end) { return fmt::format("the {} of {}", end.start ? "start" : "end", named("road", end.road.id)); }

const LaneSection& section_of(const RoadEnd& end) { return end.start ? end.road.sections.front() : end.road.sections.back(); }

LaneMeeting meet(const RoadNetwork& network, const RoadEnd& from, int from_lane, const RoadEnd& to, int to_lane) {
    const Edges here = edge_points(network, from, from_lane);
    Edges there = edge_points(network, to, to_lane);
    if (from.start == to.start) // the roads run against each other: left is right
        std::swap(there.a_m, there.b_m);
    if (glm::distance(here.a_m, here.b_m) < no_width_m || glm::distance(there.a_m, there.b_m) < no_width_m)
        return {true, 0.0};
    return {false, std::max(glm::distance(here.a_m, there.a_m), glm::distance(here.b_m, there.b_m))};
}

void check_roads(OpenDriveXml& xml, const RoadNetwork& network, const std::vector<pugi::xml_node>& road_nodes) {
    for (std::size_t i = 0; i < network.roads.size(); ++i)
        for (const bool start : {true, false})
            check_link(xml, network, {network.roads[i], start}, road_nodes[i]);
    check_forks(xml, network, road_nodes);
}

void check_links(OpenDriveXml& xml, const RoadNetwork& network) {
    std::vector<pugi::xml_node> road_nodes;
    for (const pugi::xml_node node : xml.root().children("road"))
        road_nodes.push_back(node);
    for (std::size_t i = 0; i < network.roads.size(); ++i)
        check_sections(xml, network.roads[i], road_nodes[i]);
    check_roads(xml, network, road_nodes);
    check_junctions(xml, network);
}

} // namespace fernlicht::opendrive
