#include "scenarios/roads/opendrive/opendrive_parts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht::opendrive {
namespace {

constexpr double widest_object_m = 2000.0; ///< of one object
constexpr double max_repeats = 100'000.0;
constexpr double longest_piece_m = 4.0; ///< of a continuous object: 5 mm of sagitta at a radius of 400 m

/// Refuses what measures too much.
void check_sizes(XmlFile& xml, pugi::xml_node node, const std::string& name, std::initializer_list<double> sizes) {
    for (const double size : sizes)
        if (size > widest_object_m)
            xml.refuse(node, {}, fmt::format("{} measures {} m", name, size), fmt::format("at most {} m", widest_object_m));
}

void check_place(XmlFile& xml, pugi::xml_node node, const std::string& name, double s_m, const Road& road) {
    if (s_m < 0.0 || s_m > road.length_m + 0.01)
        xml.warn(node, fmt::format("{} stands at s = {}, beyond {} of {} m; it is moved to the end", name, s_m, named("road", road.id),
                                   road.length_m));
}

/// The object's own frame on the road.
Pose object_frame(const Road& road, const RoadObject& object) {
    const Pose surface = surface_pose({}, road, object.s_m, object.t_m);
    const Pose stand{{0.0, 0.0, object.z_offset_m}, axes_from_angles(object.heading_rad, object.pitch_rad, object.roll_rad)};
    return compose(surface, stand);
}

void add_corner(XmlFile& xml, pugi::xml_node node, const Road& road, const Pose& frame, RoadObject& object) {
    const double height = xml.number(node, "height", 0.0);
    glm::dvec3 base;
    if (std::string_view(node.name()) == "cornerLocal") {
        base = {xml.number(node, "u"), xml.number(node, "v"), xml.number(node, "z", 0.0)};
    } else {
        const Pose surface = surface_pose({}, road, xml.number(node, "s"), xml.number(node, "t"));
        base = to_local(frame, surface.position_m + glm::dvec3(0.0, 0.0, xml.number(node, "dz", 0.0)));
    }
    object.outline_m.push_back({base.x, base.y, height});
    object.outline_base_m.push_back(base.z);
}

/// One object for each outer outline that has corners enough.
std::vector<RoadObject> with_outlines(XmlFile& xml, pugi::xml_node node, const Road& road, const RoadObject& object) {
    std::vector<pugi::xml_node> outlines;
    for (const pugi::xml_node parent : {node, node.child("outlines")}) // 1.4 has the outline in the object itself
        for (const pugi::xml_node outline : parent.children("outline"))
            outlines.push_back(outline);
    std::vector<RoadObject> objects;
    const Pose frame = object_frame(road, object);
    const auto inner = [&](pugi::xml_node outline) { return xml.text(outline, "outer", "true") == "false"; };
    const bool all_inner = std::all_of(outlines.begin(), outlines.end(), inner); // some exporters call their only outline an inner one
    for (const pugi::xml_node outline : outlines) {
        if (inner(outline) && !all_inner) {
            xml.warn_once(outline, "hole", fmt::format("{}: an inner outline (a hole) is left out", named("object", object.id)));
            continue;
        }
        RoadObject shaped = object;
        shaped.closed_outline = xml.text(outline, "closed", "true") != "false";
        for (const pugi::xml_node corner : outline.children())
            if (const std::string_view name = corner.name(); name == "cornerLocal" || name == "cornerRoad")
                add_corner(xml, corner, road, frame, shaped);
        const std::size_t least = shaped.closed_outline ? 3 : 2;
        if (shaped.outline_m.size() < least)
            xml.warn_once(outline, "few corners",
                          fmt::format("{}: an outline of {} corners encloses nothing and is left out", named("object", object.id),
                                      shaped.outline_m.size()));
        else
            objects.push_back(std::move(shaped));
    }
    return objects;
}

struct Ramp {
    double from = 0.0, to = 0.0;
    double at(double part) const { return from + part * (to - from); }
};

/// `nameStart` and `nameEnd` of a repeat, else the object's own value.
Ramp ramp(const XmlFile& xml, pugi::xml_node repeat, const std::string& name, double own) {
    const double from = xml.number(repeat, (name + "Start").c_str(), own);
    return {from, xml.number(repeat, (name + "End").c_str(), from)};
}

void append_repeats(XmlFile& xml, pugi::xml_node repeat, const RoadObject& object, const Road& road, std::vector<RoadObject>& objects) {
    const double start = xml.number(repeat, "s", object.s_m), distance = xml.length(repeat, "distance", 0.0);
    const double length = std::clamp(xml.length(repeat, "length", 0.0), 0.0, std::max(0.0, road.length_m - start));
    const Ramp t = ramp(xml, repeat, "t", object.t_m), z = ramp(xml, repeat, "zOffset", object.z_offset_m);
    const Ramp width = ramp(xml, repeat, "width", object.width_m), height = ramp(xml, repeat, "height", object.height_m);
    const Ramp size = ramp(xml, repeat, "length", object.length_m), radius = ramp(xml, repeat, "radius", object.radius_m);
    const bool continuous = distance == 0.0;
    const double steps = continuous ? std::ceil(length / longest_piece_m) : std::floor(length / distance + 1e-9) + 1.0;
    if (steps > max_repeats)
        xml.refuse(repeat, "distance", fmt::format("found {} over {} m", distance, length), fmt::format("at most {} objects", max_repeats));
    for (double i = 0.0; i < steps; i += 1.0) {
        const double along = continuous ? (i + 0.5) * length / steps : i * distance;
        const double part = length > 0.0 ? along / length : 0.0;
        RoadObject copy = object;
        copy.s_m = start + along;
        copy.t_m = t.at(part), copy.z_offset_m = z.at(part);
        copy.width_m = width.at(part), copy.height_m = height.at(part);
        copy.length_m = size.at(part), copy.radius_m = radius.at(part);
        if (continuous) {
            copy.length_m = length / steps;
            copy.radius_m = 0.0;
            copy.heading_rad = length > 0.0 ? std::atan2(t.to - t.from, length) : 0.0;
            copy.outline_m.clear();
            copy.outline_base_m.clear();
        }
        objects.push_back(std::move(copy));
    }
}

RoadObject read_object(XmlFile& xml, pugi::xml_node node) {
    RoadObject object;
    object.id = xml.text(node, "id"), object.name = xml.text(node, "name"), object.type = xml.text(node, "type", "none");
    object.s_m = xml.number(node, "s"), object.t_m = xml.number(node, "t");
    object.z_offset_m = xml.number(node, "zOffset", 0.0);
    object.heading_rad = xml.number(node, "hdg", 0.0);
    object.pitch_rad = xml.number(node, "pitch", 0.0), object.roll_rad = xml.number(node, "roll", 0.0);
    object.length_m = xml.length(node, "length", 0.0), object.width_m = xml.length(node, "width", 0.0);
    object.height_m = xml.length(node, "height", 0.0), object.radius_m = xml.length(node, "radius", 0.0);
    check_sizes(xml, node, named("object", object.id), {object.length_m, object.width_m, object.height_m, object.radius_m});
    return object;
}

bool has_size(const RoadObject& object) {
    return !object.outline_m.empty() || object.radius_m > 0.0 || (object.length_m > 0.0 && object.width_m > 0.0) || object.height_m > 0.0;
}

bool is_wall(const RoadObject& o) { return o.type == "barrier" || o.type == "soundBarrier" || o.type == "railing" || o.type == "building"; }

} // namespace

void read_objects(XmlFile& xml, pugi::xml_node road_node, Road& road) {
    for (const pugi::xml_node node : road_node.child("objects").children("object")) {
        const RoadObject object = read_object(xml, node);
        const std::string name = named("object", object.id);
        check_place(xml, node, name, object.s_m, road);
        for (const auto& [part, are] : {std::pair("skeleton", "is"), std::pair("markings", "are"), std::pair("borders", "are")})
            if (node.child(part))
                xml.warn_once(node, part, fmt::format("{}: its {} {} left out", name, part, are));
        if (object.radius_m > 0.0 && (object.length_m > 0.0 || object.width_m > 0.0))
            xml.warn_once(node, "radius and length", name + " has a radius beside length or width; the radius holds");
        std::vector<RoadObject> shaped = with_outlines(xml, node, road, object);
        if (shaped.empty())
            shaped.push_back(object);
        for (const RoadObject& one : shaped) {
            const std::size_t before = road.objects.size();
            for (const pugi::xml_node repeat : node.children("repeat"))
                append_repeats(xml, repeat, one, road, road.objects);
            if (road.objects.size() == before)
                road.objects.push_back(one);
            if (!has_size(road.objects.back()))
                xml.warn_once(node, "no size", name + " has no size: it is not rendered");
            else if (is_wall(one) && one.outline_m.empty() && one.length_m == 0.0 && !node.child("repeat"))
                xml.warn_once(node, "no length", name + " has no length: it is 0.1 m long");
        }
    }
}

void read_signals(XmlFile& xml, pugi::xml_node road_node, Road& road) {
    for (const pugi::xml_node node : road_node.child("signals").children("signal")) {
        RoadSignal signal;
        signal.id = xml.text(node, "id");
        signal.s_m = xml.number(node, "s"), signal.t_m = xml.number(node, "t");
        signal.z_offset_m = xml.number(node, "zOffset", 0.0);
        signal.heading_offset_rad = xml.number(node, "hOffset", 0.0);
        signal.width_m = xml.length(node, "width", 0.0), signal.height_m = xml.length(node, "height", 0.0);
        const std::string name = named("signal", signal.id);
        check_sizes(xml, node, name, {signal.width_m, signal.height_m});
        signal.facing_forward = xml.text(node, "orientation", "+") != "-";
        signal.dynamic = xml.text(node, "dynamic", "no") == "yes";
        check_place(xml, node, name, signal.s_m, road);
        if (node.child("positionInertial") || node.child("positionRoad"))
            xml.warn_once(node, "physical position", name + ": its physical position is left out; it stands at its s and t");
        road.signals.push_back(std::move(signal));
    }
}

} // namespace fernlicht::opendrive
