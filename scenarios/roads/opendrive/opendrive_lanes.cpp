#include "scenarios/roads/opendrive/opendrive_parts.h"
#include "scenarios/roads/road_network.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace fernlicht::opendrive {
namespace {

/// No lane edge lies further from the reference line; beyond, a number is mistyped.
constexpr double widest_m = 1000.0;
constexpr double widest_lane_m = 30.0; ///< to drive on; squares have wider ones, but few

std::optional<int> read_link(XmlFile& xml, pugi::xml_node lane_node, const char* name) {
    const pugi::xml_node link = lane_node.child("link").child(name);
    return link ? std::optional(xml.integer(link, "id")) : std::nullopt;
}

/// e_laneType of OpenDRIVE 1.4 to 1.8.
constexpr std::array<std::string_view, 32> lane_types{
    "shoulder",      "border",   "driving",  "stop",     "none",      "restricted", "parking", "median",
    "biking",        "sidewalk", "curb",     "exit",     "entry",     "onRamp",     "offRamp", "connectingRamp",
    "slipLane",      "walking",  "HOV",      "bus",      "taxi",      "shared",     "tram",    "rail",
    "bidirectional", "special1", "special2", "special3", "roadWorks", "mwyEntry",   "mwyExit", "roadMarks"};

Lane read_lane(XmlFile& xml, pugi::xml_node node) {
    Lane lane;
    lane.id = xml.integer(node, "id");
    lane.type = xml.text(node, "type", "none");
    if (std::ranges::find(lane_types, lane.type) == lane_types.end()) {
        const std::string nearest = nearest_name(lane.type, lane_types);
        xml.warn_once(node, "lane type " + lane.type,
                      fmt::format("the lane type '{}' is none of OpenDRIVE's{}: nobody drives there", lane.type,
                                  nearest.empty() ? "" : " (the nearest is '" + nearest + "')"));
    }
    const std::string level = xml.text(node, "level", "false");
    lane.level = level == "true" || level == "1";
    lane.reversed = xml.text(node, "direction") == "reversed";
    lane.predecessor = read_link(xml, node, "predecessor");
    lane.successor = read_link(xml, node, "successor");
    lane.marks = read_marks(xml, node);
    if (lane.id == 0)
        return lane;
    lane.widths = read_cubics(xml, node, "width", "sOffset");
    lane.borders = read_cubics(xml, node, "border", "sOffset");
    if (lane.widths.empty() && lane.borders.empty() && lane.type != "none")
        xml.warn_once(node, "no width", fmt::format("lane {} ({}) has neither width nor border: it has no surface", lane.id, lane.type));
    if (!lane.widths.empty() && !lane.borders.empty()) {
        xml.warn(node, fmt::format("lane {} has widths and borders; the widths hold", lane.id));
        lane.borders.clear();
    }
    for (const pugi::xml_node height : node.children("height"))
        lane.heights.push_back({xml.number(height, "sOffset"), xml.number(height, "inner"), xml.number(height, "outer")});
    std::stable_sort(lane.heights.begin(), lane.heights.end(), [](const auto& a, const auto& b) { return a.s_m < b.s_m; });
    return lane;
}

template <class Belongs>
void read_side(XmlFile& xml, pugi::xml_node side, LaneSection& section, const char* expected, const Belongs& belongs) {
    for (const pugi::xml_node node : side.children("lane")) {
        section.lanes.push_back(read_lane(xml, node));
        if (const int id = section.lanes.back().id; !belongs(id))
            xml.refuse(node, "id", fmt::format("found lane {} in '{}'", id, side.name()), expected);
    }
}

LaneSection read_section(XmlFile& xml, pugi::xml_node node, const std::string& road_name) {
    LaneSection section;
    section.s_m = xml.length(node, "s");
    read_side(xml, node.child("left"), section, "an id above 0", [](int id) { return id > 0; });
    read_side(xml, node.child("center"), section, "the id 0", [](int id) { return id == 0; });
    read_side(xml, node.child("right"), section, "an id below 0", [](int id) { return id < 0; });
    auto& lanes = section.lanes;
    if (std::none_of(lanes.begin(), lanes.end(), [](const Lane& lane) { return lane.id == 0; }))
        lanes.push_back({});
    std::stable_sort(lanes.begin(), lanes.end(), [](const Lane& a, const Lane& b) { return a.id > b.id; });
    for (std::size_t i = 1; i < lanes.size(); ++i) {
        if (lanes[i].id == lanes[i - 1].id)
            xml.refuse(node, "id", fmt::format("found lane {} twice in {}, section at s = {}", lanes[i].id, road_name, section.s_m),
                       "each id once");
        if (lanes[i].id != lanes[i - 1].id - 1)
            xml.warn(node, fmt::format("{}: lanes {} and {} of the section at s = {} are numbered with a gap", road_name, lanes[i - 1].id,
                                       lanes[i].id, section.s_m));
    }
    return section;
}

bool has_roll(const Road& road) {
    return std::any_of(road.superelevation.begin(), road.superelevation.end(),
                       [](const Cubic& piece) { return piece.a != 0.0 || piece.b != 0.0 || piece.c != 0.0 || piece.d != 0.0; });
}

/// Edges in steps over the section: cubics may run away, or cross, between the values that look sane.
void check_edges(XmlFile& xml, pugi::xml_node node, const Road& road, const LaneSection& section) {
    constexpr int samples = 20;
    constexpr double reported_overlap_m = 0.001;
    const std::string road_name = named("road", road.id);
    for (const Lane& lane : section.lanes) {
        double overlap = 0.0, overlap_s = 0.0;
        for (int i = 0; i <= samples && lane.id != 0; ++i) {
            const double s = section.s_m + (section.end_m - section.s_m) * i / samples, ds = s - section.s_m;
            const LaneEdges edges = lane_edges(road, section, lane.id, s);
            if (!(std::abs(edges.outer_t_m) <= widest_m))
                xml.refuse(node, {},
                           fmt::format("the edge of lane {} of {} lies at t = {} m at s = {}", lane.id, road_name, edges.outer_t_m, s),
                           fmt::format("at most {} m from the reference line", widest_m));
            const double side = lane.id > 0 ? 1.0 : -1.0;
            const double width = !lane.widths.empty() ? value_at(lane.widths, ds)
                                 : !lane.borders.empty()
                                     ? side * (value_at(road.lane_offset, s) + value_at(lane.borders, ds) - edges.inner_t_m)
                                     : 0.0;
            if (lane.type == "driving" && width > widest_lane_m)
                xml.warn_once(node, "wide lane", fmt::format("{}: lane {} is {:g} m wide at s = {:g}", road_name, lane.id, width, s));
            if (-width > overlap)
                overlap = -width, overlap_s = s;
        }
        if (overlap > reported_overlap_m)
            xml.warn(node, fmt::format("{}: lane {} overlaps its inner neighbour by {:.3f} m at s = {}; it has no width there", road_name,
                                       lane.id, overlap, overlap_s));
        if (lane.id != 0 && !lane.borders.empty() && !road.lane_offset.empty())
            xml.warn(node,
                     fmt::format("{}: lane {} has borders although the road has a lane offset; they are counted from the shifted centre",
                                 road_name, lane.id));
        if (lane.level && (has_roll(road) || !road.shapes.empty()))
            xml.warn_once(node, "level",
                          fmt::format("{}: lane {} is to stay level; it follows the road's superelevation and shape all the same",
                                      road_name, lane.id));
    }
}

constexpr double standard_width_m = 0.12, bold_width_m = 0.25, widest_mark_m = 10.0;
constexpr double once_m = 1e9; ///< the gap after a line that is not repeated

MarkKind mark_kind(XmlFile& xml, pugi::xml_node node) {
    static constexpr std::string_view names[]{"none",          "solid",      "broken", "solid solid", "solid broken", "broken solid",
                                              "broken broken", "botts dots", "curb",   "custom"}; // in MarkKind's order
    const std::string name = xml.text(node, "type");
    if (name.empty() || name == "edge" || name == "grass") // where nothing is painted
        return MarkKind::none;
    if (const auto known = std::ranges::find(names, name); known != std::end(names))
        return static_cast<MarkKind>(known - names);
    xml.warn_once(node, "mark type " + name,
                  fmt::format("the road mark type '{}' is unknown; it is not rendered unless its lines are given", name));
    return MarkKind::other;
}

double mark_width(XmlFile& xml, pugi::xml_node node, const char* attribute, double fallback) {
    const double width = xml.number(node, attribute, fallback);
    if (width <= 0.0 || width > widest_mark_m) {
        xml.warn_once(node, "mark width", fmt::format("the road mark's width of {} m is taken as {} m", width, fallback));
        return fallback;
    }
    return width;
}

/// `type/line`: a pattern that repeats; `explicit/line`: lines that stand alone.
void read_stripes(XmlFile& xml, pugi::xml_node node, RoadMark& mark) {
    for (const pugi::xml_node type : node.children("type")) {
        const double width = mark_width(xml, type, "width", mark.width_m);
        for (const pugi::xml_node line : type.children("line"))
            mark.stripes.push_back({mark_width(xml, line, "width", width), xml.length(line, "length", 0.0), xml.length(line, "space", 0.0),
                                    xml.number(line, "tOffset", 0.0), xml.number(line, "sOffset", 0.0)});
    }
    for (const pugi::xml_node line : node.child("explicit").children("line"))
        mark.stripes.push_back({mark_width(xml, line, "width", mark.width_m), xml.length(line, "length"), once_m,
                                xml.number(line, "tOffset", 0.0), xml.number(line, "sOffset", 0.0)});
}

} // namespace

void read_lanes(XmlFile& xml, pugi::xml_node road_node, Road& road) {
    const pugi::xml_node lanes = road_node.child("lanes");
    const std::string road_name = named("road", road.id);
    road.lane_offset = read_cubics(xml, lanes, "laneOffset", "s");
    std::vector<pugi::xml_node> nodes;
    for (const pugi::xml_node node : lanes.children("laneSection")) {
        LaneSection section = read_section(xml, node, road_name);
        if (!road.sections.empty() && section.s_m <= road.sections.back().s_m)
            xml.refuse(node, "s", fmt::format("found {} after {} in {}", section.s_m, road.sections.back().s_m, road_name),
                       "lane sections in ascending order");
        if (section.s_m >= road.length_m) {
            xml.warn(node,
                     fmt::format("{}: the lane section at s = {} lies beyond the road's end and is left out", road_name, section.s_m));
            continue;
        }
        road.sections.push_back(std::move(section));
        nodes.push_back(node);
    }
    if (road.sections.empty()) {
        xml.warn(road_node, fmt::format("{} has no lane section: it is a reference line without surface", road_name));
        road.sections.push_back({0.0, road.length_m, {Lane{}}});
        nodes.push_back(road_node);
    }
    if (road.sections.front().s_m > 0.0)
        xml.warn(nodes.front(), fmt::format("{}: the first lane section begins at s = {}; it is extended back to 0", road_name,
                                            road.sections.front().s_m));
    for (std::size_t i = 0; i < road.sections.size(); ++i) {
        road.sections[i].end_m = i + 1 < road.sections.size() ? road.sections[i + 1].s_m : road.length_m;
        check_edges(xml, nodes[i], road, road.sections[i]);
    }
}

std::vector<RoadMark> read_marks(XmlFile& xml, pugi::xml_node lane_node) {
    std::vector<RoadMark> marks;
    for (const pugi::xml_node node : lane_node.children("roadMark")) {
        RoadMark mark;
        mark.s_m = xml.number(node, "sOffset", 0.0);
        mark.kind = mark_kind(xml, node);
        const bool bold = xml.text(node, "weight") == "bold";
        if (mark.kind != MarkKind::none)
            mark.width_m = mark_width(xml, node, "width", bold ? bold_width_m : standard_width_m);
        mark.colour = xml.text(node, "color", "standard");
        if (mark.colour == "standard" || mark.colour.empty())
            mark.colour = "white";
        if (mark.kind != MarkKind::none)
            read_stripes(xml, node, mark);
        if (node.child("sway"))
            xml.warn_once(node, "sway", "the road mark's sway is left out: the mark runs along the lane's edge");
        marks.push_back(std::move(mark));
    }
    const auto ascending = [](const RoadMark& a, const RoadMark& b) { return a.s_m < b.s_m; };
    if (!std::is_sorted(marks.begin(), marks.end(), ascending)) {
        xml.warn(lane_node, "road marks are not in ascending order of sOffset; they are sorted");
        std::stable_sort(marks.begin(), marks.end(), ascending);
    }
    return marks;
}

} // namespace fernlicht::opendrive
