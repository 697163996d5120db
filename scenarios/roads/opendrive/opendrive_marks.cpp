#include "scenarios/roads/opendrive/opendrive_parts.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace fernlicht::opendrive {
namespace {

constexpr double standard_width_m = 0.12, bold_width_m = 0.25, widest_mark_m = 10.0;
constexpr double once_m = 1e9; ///< the gap after a line that is not repeated

MarkKind mark_kind(OpenDriveXml& xml, pugi::xml_node node) {
    static constexpr std::array<std::pair<std::string_view, MarkKind>, 13> kinds{{{"none", MarkKind::none},
                                                                                  {"solid", MarkKind::solid},
                                                                                  {"broken", MarkKind::broken},
                                                                                  {"solid solid", MarkKind::solid_solid},
                                                                                  {"solid broken", MarkKind::solid_broken},
                                                                                  {"broken solid", MarkKind::broken_solid},
                                                                                  {"broken broken", MarkKind::broken_broken},
                                                                                  {"botts dots", MarkKind::botts_dots},
                                                                                  {"curb", MarkKind::curb},
                                                                                  {"custom", MarkKind::other},
                                                                                  {"edge", MarkKind::none}, // where nothing is painted
                                                                                  {"grass", MarkKind::none},
                                                                                  {"", MarkKind::none}}};
    const std::string name = xml.text(node, "type");
    for (const auto& [word, kind] : kinds)
        if (name == word)
            return kind;
    xml.warn_once(node, "mark type " + name,
                  fmt::format("the road mark type '{}' is unknown; it is not drawn unless its lines are given", name));
    return MarkKind::other;
}

double mark_width(OpenDriveXml& xml, pugi::xml_node node, const char* attribute, double fallback) {
    const double width = xml.number(node, attribute, fallback);
    if (width <= 0.0 || width > widest_mark_m) {
        xml.warn_once(node, "mark width", fmt::format("the road mark's width of {} m is taken as {} m", width, fallback));
        return fallback;
    }
    return width;
}

/// `type/line`: a pattern that repeats; `explicit/line`: lines that stand alone.
void read_stripes(OpenDriveXml& xml, pugi::xml_node node, RoadMark& mark) {
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

std::vector<RoadMark> read_marks(OpenDriveXml& xml, pugi::xml_node lane_node) {
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
            xml.warn_once(node, "sway", "the road mark's sway is left out: the mark is drawn along the lane's edge");
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
