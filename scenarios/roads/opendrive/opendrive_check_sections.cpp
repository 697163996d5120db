#include "scenarios/roads/opendrive/opendrive_checks.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht::opendrive {
namespace {

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
void check_joint(OpenDriveXml& xml, const Side& before, const Side& after, const Lane& lane, const std::vector<int>& targets) {
    std::vector<int> sources;
    for (const Lane& other : before.section.lanes) {
        const std::vector<int> reached = lane_links(lane_node(before.node, other.id), "successor");
        if (std::any_of(reached.begin(), reached.end(),
                        [&](int id) { return std::find(targets.begin(), targets.end(), id) != targets.end(); }))
            sources.push_back(other.id);
    }
    const Span a = span_of(before, sources), b = span_of(after, targets);
    const double gap = std::max(std::abs(a.low - b.low), std::abs(a.high - b.high));
    if (gap > told_gap_m)
        xml.warn(lane_node(before.node, lane.id),
                 fmt::format("{}: the edges of lane {} jump by {:.3f} m at s = {}", named("road", before.road.id), lane.id, gap, before.s));
}

void check_lane(OpenDriveXml& xml, const Side& before, const Side& after, const Lane& lane) {
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
        if (std::find(back.begin(), back.end(), lane.id) == back.end())
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

void check_back(OpenDriveXml& xml, const Side& before, const Side& after, const Lane& lane) {
    const pugi::xml_node node = lane_node(after.node, lane.id);
    for (const int source : lane_links(node, "predecessor"))
        if (!lane_of(before.section, source))
            xml.warn(node, fmt::format("{}: lane {} comes from lane {}, which the section before s = {} does not have; it begins there",
                                       named("road", after.road.id), lane.id, source, after.s));
}

} // namespace

pugi::xml_node lane_node(pugi::xml_node section, int id) {
    for (const pugi::xml_node part : section.children())
        for (const pugi::xml_node lane : part.children("lane"))
            if (lane.attribute("id").as_int() == id)
                return lane;
    return section;
}

std::vector<int> lane_links(pugi::xml_node lane, const char* name) {
    std::vector<int> ids;
    for (const pugi::xml_node link : lane.child("link").children(name))
        ids.push_back(link.attribute("id").as_int());
    return ids;
}

void check_sections(OpenDriveXml& xml, const Road& road, pugi::xml_node road_node) {
    std::vector<pugi::xml_node> nodes;
    for (const pugi::xml_node node : road_node.child("lanes").children("laneSection"))
        nodes.push_back(node);
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

} // namespace fernlicht::opendrive
