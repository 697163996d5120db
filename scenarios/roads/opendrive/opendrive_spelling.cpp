// Names that are not OpenDRIVE's but nearly so: whoever wrote them meant what is then not read. Names far from any are others' extensions.
#include "scenarios/roads/opendrive/opendrive_parts.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace fernlicht::opendrive {
namespace {

using Words = std::vector<std::string_view>;

/// An element of OpenDRIVE 1.4 to 1.8, wherever it stands: of elements of one name what any of them may have.
struct Element {
    std::string_view name;
    Words attributes, children;
};

const std::vector<Element>& elements() {
    static const Words link{"elementType", "elementId", "contactPoint", "elementS", "elementDir", "id"};
    static const std::vector<Element> all{
        {"OpenDRIVE", {}, {"header", "road", "controller", "junction", "junctionGroup", "station"}},
        {"header",
         {"revMajor", "revMinor", "name", "version", "date", "north", "south", "east", "west", "vendor"},
         {"geoReference", "offset", "license", "defaultRegulations"}},
        {"road",
         {"name", "length", "id", "junction", "rule"},
         {"link", "type", "planView", "elevationProfile", "lateralProfile", "lanes", "objects", "signals", "surface", "railroad"}},
        {"link", {}, {"predecessor", "successor", "neighbor"}},
        {"predecessor", link, {}},
        {"successor", link, {}},
        {"planView", {}, {"geometry"}},
        {"geometry", {"s", "x", "y", "hdg", "length"}, {"line", "spiral", "arc", "poly3", "paramPoly3"}},
        {"spiral", {"curvStart", "curvEnd"}, {}},
        {"arc", {"curvature"}, {}},
        {"paramPoly3", {"aU", "bU", "cU", "dU", "aV", "bV", "cV", "dV", "pRange"}, {}},
        {"elevationProfile", {}, {"elevation"}},
        {"lateralProfile", {}, {"superelevation", "crossfall", "shape", "crossSectionSurface"}},
        {"lanes", {}, {"laneOffset", "laneSection"}},
        {"laneSection", {"s", "singleSide"}, {"left", "center", "right"}},
        {"left", {}, {"lane"}},
        {"center", {}, {"lane"}},
        {"right", {}, {"lane"}},
        {"lane",
         {"id", "type", "level", "direction", "dynamicLaneDirection", "dynamicLaneType", "advisory", "roadWorks"},
         {"link", "width", "border", "roadMark", "material", "visibility", "speed", "access", "height", "rule"}},
        {"width", {"sOffset", "a", "b", "c", "d"}, {}},
        {"border", {"sOffset", "a", "b", "c", "d"}, {}},
        {"height", {"sOffset", "inner", "outer"}, {}},
        {"speed", {"sOffset", "max", "unit"}, {}},
        {"roadMark", {"sOffset", "type", "weight", "color", "material", "width", "laneChange", "height"}, {"sway", "type", "explicit"}},
        {"type", {"s", "type", "country", "name", "width"}, {"speed", "line"}},
        {"explicit", {}, {"line"}},
        {"line", {"length", "space", "tOffset", "sOffset", "rule", "width", "color"}, {}},
        {"objects", {}, {"object", "objectReference", "tunnel", "bridge"}},
        {"object",
         {"t",  "zOffset", "type",   "validLength", "orientation", "subtype", "dynamic", "hdg",        "name",        "pitch",
          "id", "roll",    "height", "s",           "length",      "width",   "radius",  "perpToRoad", "invalidated", "temporary"},
         {"repeat", "outline", "outlines", "skeleton", "material", "validity", "parkingSpace", "markings", "borders", "surface"}},
        {"repeat",
         {"s", "length", "distance", "tStart", "tEnd", "heightStart", "heightEnd", "zOffsetStart", "zOffsetEnd", "widthStart", "widthEnd",
          "lengthStart", "lengthEnd", "radiusStart", "radiusEnd", "detachFromReferenceLine"},
         {}},
        {"signals", {}, {"signal", "signalReference", "signalGroup", "boards"}},
        {"signal",
         {"s",    "t",       "id",        "name",       "dynamic", "orientation", "zOffset", "country", "countryRevision",
          "type", "subtype", "value",     "unit",       "height",  "width",       "length",  "hOffset", "pitch",
          "roll", "text",    "temporary", "invalidated"},
         {"validity", "dependency", "reference", "positionRoad", "positionInertial", "semantics", "staticBoard", "vmsBoard"}},
        {"junction",
         {"name", "id", "type", "mainRoad", "orientation", "sStart", "sEnd"},
         {"connection", "priority", "controller", "crossPath", "surface", "planView", "elevationGrid", "boundary", "roadSection", "objects",
          "signals"}},
        {"connection",
         {"id", "type", "incomingRoad", "connectingRoad", "contactPoint", "linkedRoad"},
         {"predecessor", "successor", "laneLink"}},
        {"laneLink", {"from", "to", "overlapZone"}, {}},
    };
    return all;
}

/// Words of OpenDRIVE 1.4 to 1.8 that an attribute may have.
struct Choice {
    std::string_view element, attribute;
    Words words;
};

const std::vector<Choice>& choices() {
    static const std::vector<Choice> all{
        {"roadMark", "weight", {"standard", "bold"}},
        {"roadMark", "color", {"standard", "black", "blue", "green", "red", "white", "yellow", "orange", "violet"}},
        {"roadMark", "laneChange", {"increase", "decrease", "both", "none"}},
        {"speed", "unit", {"m/s", "mph", "km/h"}},
    };
    return all;
}

/// The name that was meant; "" where `word` is one, or like none.
std::string meant(std::string_view word, const Words& names) {
    constexpr std::size_t shortest = 4, farthest = 2;
    if (word.size() < shortest || std::ranges::find(names, word) != names.end())
        return "";
    const std::string nearest = nearest_name(std::string(word), names);
    return edit_distance(word, nearest) <= farthest ? nearest : "";
}

void check_element(XmlFile& xml, pugi::xml_node node) {
    const std::string_view name = node.name();
    const auto known = std::ranges::find(elements(), name, &Element::name);
    if (known == elements().end())
        return;
    const auto tell = [&](pugi::xml_node where, const std::string& kind, std::string_view found, const std::string& nearest) {
        if (!nearest.empty())
            xml.warn_once(where, fmt::format("spelling of {} {}", kind, found),
                          fmt::format("the {} '{}' of '{}' is not OpenDRIVE's and is not read: is '{}' meant?", kind,
                                      printable(std::string(found)), name, nearest));
    };
    for (const pugi::xml_attribute attribute : node.attributes()) {
        tell(node, "attribute", attribute.name(), meant(attribute.name(), known->attributes));
        for (const Choice& choice : choices())
            if (choice.element == name && choice.attribute == attribute.name() &&
                std::ranges::find(choice.words, std::string_view(attribute.value())) == choice.words.end())
                xml.warn_once(node, fmt::format("{} {}", choice.attribute, attribute.value()),
                              fmt::format("the {} '{}' of '{}' is not OpenDRIVE's, which has {}", choice.attribute,
                                          printable(attribute.value()), name, fmt::join(choice.words, ", ")));
    }
    for (const pugi::xml_node child : node.children())
        if (child.type() == pugi::node_element) {
            tell(child, "element", child.name(), meant(child.name(), known->children));
            check_element(xml, child);
        }
}

} // namespace

void check_spelling(XmlFile& xml) { check_element(xml, xml.root()); }

} // namespace fernlicht::opendrive
