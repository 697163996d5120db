#include "scenarios/roads/opendrive/opendrive_parts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht::opendrive {

std::vector<Cubic> read_cubics(XmlFile& xml, pugi::xml_node parent, const char* element, const char* start) {
    std::vector<Cubic> pieces;
    for (const pugi::xml_node node : parent.children(element))
        pieces.push_back(
            {xml.number(node, start), xml.number(node, "a"), xml.number(node, "b"), xml.number(node, "c"), xml.number(node, "d")});
    const auto ascending = [](const Cubic& a, const Cubic& b) { return a.s0 < b.s0; };
    if (!std::is_sorted(pieces.begin(), pieces.end(), ascending)) {
        xml.warn(parent.child(element), fmt::format("{} elements are not in ascending order of {}; they are sorted", element, start));
        std::stable_sort(pieces.begin(), pieces.end(), ascending);
    }
    return pieces;
}

namespace {

/// Before its first piece a profile is zero by the standard: a step there is told.
void check_beginning(XmlFile& xml, pugi::xml_node parent, const char* element, const std::vector<Cubic>& pieces) {
    if (!pieces.empty() && pieces.front().s0 > 0.01 && pieces.front().a != 0.0)
        xml.warn(parent.child(element), fmt::format("the first {} begins at s = {}; before it, zero holds", element, pieces.front().s0));
}

/// A road that leans by more than 80 degrees is mistyped, most likely in degrees instead of radians.
void check_roll(XmlFile& xml, pugi::xml_node lateral, const Road& road) {
    constexpr double steepest_rad = 1.4;
    constexpr int samples = 20;
    for (std::size_t i = 0; i < road.superelevation.size(); ++i) {
        const Cubic& piece = road.superelevation[i];
        const double end = std::min(road.length_m, i + 1 < road.superelevation.size() ? road.superelevation[i + 1].s0 : road.length_m);
        for (int n = 0; n <= samples && piece.s0 < end; ++n) {
            const double s = piece.s0 + (end - piece.s0) * n / samples;
            if (!(std::abs(piece.at(s)) <= steepest_rad))
                xml.refuse(lateral.child("superelevation"), {},
                           fmt::format("{} rolls by {} rad at s = {}", named("road", road.id), piece.at(s), s),
                           fmt::format("at most {} rad", steepest_rad));
        }
    }
}

std::vector<ShapeProfile> read_shapes(XmlFile& xml, pugi::xml_node lateral) {
    std::vector<std::pair<double, Cubic>> entries; // by s
    for (const pugi::xml_node node : lateral.children("shape"))
        entries.push_back(
            {xml.number(node, "s"),
             {xml.number(node, "t"), xml.number(node, "a"), xml.number(node, "b"), xml.number(node, "c"), xml.number(node, "d")}});
    std::ranges::stable_sort(entries, {}, [](const auto& entry) { return std::pair(entry.first, entry.second.s0); });
    std::vector<ShapeProfile> profiles;
    for (const auto& [s, cubic] : entries) {
        if (profiles.empty() || profiles.back().s_m != s)
            profiles.push_back({s, {}});
        profiles.back().over_t.push_back(cubic);
    }
    return profiles;
}

double leftmost_edge(const Road& road, double s) {
    const LaneSection& section = section_at(road, s);
    return section.lanes.empty() ? 0.0 : lane_edges(road, section, section.lanes.front().id, s).outer_t_m;
}

} // namespace

void end_shapes(Road& road) {
    for (std::size_t i = 0; i < road.shapes.size(); ++i) {
        ShapeProfile& profile = road.shapes[i];
        const double next_s = i + 1 < road.shapes.size() ? road.shapes[i + 1].s_m : road.length_m;
        const double t = std::max(leftmost_edge(road, profile.s_m), leftmost_edge(road, next_s));
        const Cubic& last = profile.over_t.back();
        if (t > last.s0)
            profile.over_t.push_back({t, last.at(t), last.slope(t), 0.0, 0.0});
    }
}

void read_profiles(XmlFile& xml, pugi::xml_node road_node, Road& road) {
    const pugi::xml_node elevation = road_node.child("elevationProfile"), lateral = road_node.child("lateralProfile");
    road.elevation = read_cubics(xml, elevation, "elevation", "s");
    road.superelevation = read_cubics(xml, lateral, "superelevation", "s");
    check_beginning(xml, elevation, "elevation", road.elevation);
    check_beginning(xml, lateral, "superelevation", road.superelevation);
    check_roll(xml, lateral, road);
    road.shapes = read_shapes(xml, lateral);
    if (const pugi::xml_node surface = lateral.child("crossSectionSurface")) {
        const bool both = lateral.child("shape") || lateral.child("superelevation");
        xml.warn(surface,
                 fmt::format("{}: its crossSectionSurface is left out{}", named("road", road.id),
                             both ? "; superelevation and shape, which must not stand beside it, hold" : "; the cross-section is flat"));
    }
    if (const pugi::xml_node crossfall = lateral.child("crossfall"))
        xml.warn(crossfall, fmt::format("{}: its crossfall is left out; the cross-section is flat", named("road", road.id)));
}

} // namespace fernlicht::opendrive
