#include "scenarios/roads/opendrive/opendrive_parts.h"
#include "scenarios/roads/plan.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht::opendrive {
namespace {

/// Exporters write headings to 1e-4.
constexpr double reported_kink_rad = 0.01, reported_length_m = 0.01;

/// Beyond, a number is mistyped, and everything that walks along the road would take too long.
constexpr double longest_road_m = 1e6;

struct ElementNode {
    pugi::xml_node node;
    PlanElement element;
};

ParamPoly3 read_param_poly3(const XmlFile& xml, pugi::xml_node shape) {
    ParamPoly3 poly;
    poly.au = xml.number(shape, "aU"), poly.bu = xml.number(shape, "bU");
    poly.cu = xml.number(shape, "cU"), poly.du = xml.number(shape, "dU");
    poly.av = xml.number(shape, "aV"), poly.bv = xml.number(shape, "bV");
    poly.cv = xml.number(shape, "cV"), poly.dv = xml.number(shape, "dV");
    const std::string range = xml.text(shape, "pRange", "normalized"); // 1.4: normalized when absent
    if (range != "normalized" && range != "arcLength")
        xml.refuse(shape, "pRange", fmt::format("found '{}'", range), "'arcLength' or 'normalized'");
    poly.normalized = range == "normalized";
    return poly;
}

void read_shape(const XmlFile& xml, pugi::xml_node node, PlanElement& element) {
    const auto bounded = [&](pugi::xml_node shape, const char* key) {
        const double curvature = xml.number(shape, key);
        if (std::abs(curvature) * element.length_m > max_spiral_turn_rad)
            xml.refuse(shape, key, fmt::format("found {} over {} m", curvature, element.length_m),
                       fmt::format("a curve that turns by at most {} rad", max_spiral_turn_rad));
        return curvature;
    };
    for (const pugi::xml_node shape : node.children()) {
        const std::string_view name = shape.name();
        if (name == "line")
            element.shape = Line{};
        else if (name == "arc")
            element.shape = Arc{bounded(shape, "curvature")};
        else if (name == "spiral")
            element.shape = Spiral{bounded(shape, "curvStart"), bounded(shape, "curvEnd")};
        else if (name == "poly3")
            element.shape = Poly3{xml.number(shape, "a"), xml.number(shape, "b"), xml.number(shape, "c"), xml.number(shape, "d")};
        else if (name == "paramPoly3")
            element.shape = read_param_poly3(xml, shape);
        else
            continue; // userData and the like
        return;
    }
    xml.refuse(node, {}, "holds no shape", "line, spiral, arc, poly3 or paramPoly3");
}

std::optional<ElementNode> read_element(XmlFile& xml, pugi::xml_node node, const std::string& road_name) {
    ElementNode read{node, {}};
    PlanElement& element = read.element;
    element.s_m = xml.length(node, "s");
    element.x_m = xml.number(node, "x");
    element.y_m = xml.number(node, "y");
    element.heading_rad = xml.number(node, "hdg");
    element.length_m = xml.length(node, "length");
    if (element.s_m + element.length_m > longest_road_m)
        xml.refuse(node, {}, fmt::format("{} reaches s = {} m", road_name, element.s_m + element.length_m),
                   fmt::format("a road of at most {} m", longest_road_m));
    read_shape(xml, node, element);
    if (element.length_m == 0.0) {
        xml.warn(node, fmt::format("{}: the geometry at s = {} has no length and is left out", road_name, element.s_m));
        return {};
    }
    prepare(element);
    return read;
}

/// Metres on the curve per metre of s, least and greatest.
std::pair<double, double> speeds(const PlanElement& element) {
    constexpr int samples = 50;
    std::pair<double, double> range{plan_point(element, 0.0).speed, 0.0};
    for (int i = 0; i <= samples; ++i) {
        const double speed = plan_point(element, element.length_m * i / samples).speed;
        range = {std::min(range.first, speed), std::max(range.second, speed)};
    }
    return range;
}

void check_parameters(XmlFile& xml, const ElementNode& read, const std::string& road_name) {
    const auto* poly = std::get_if<ParamPoly3>(&read.element.shape);
    if (!poly)
        return;
    constexpr double reported_difference_m = 0.001, reported_speed = 0.05;
    const double length = read.element.length_m, drawn = drawn_length_m(read.element);
    if (!(std::abs(drawn - length) <= reported_difference_m))
        xml.warn_once(
            read.node, "paramPoly3 length",
            fmt::format("{}: the paramPoly3 at s = {} is {:.4f} m long, its length says {:.4f} m; its parameter is followed, so distances "
                        "along it are stretched",
                        road_name, read.element.s_m, drawn, length));
    if (const auto [least, most] = speeds(read.element); !(least >= 1.0 - reported_speed && most <= 1.0 + reported_speed))
        xml.warn_once(
            read.node, "paramPoly3 speed",
            fmt::format(
                "{}: the paramPoly3 at s = {} runs {:.2f} to {:.2f} m per metre of s; what stands along it by s is taken by its parameter",
                road_name, read.element.s_m, least, most));
    constexpr double negligible = 1e-6; // of the start: exporters leave rounding there
    if (std::abs(poly->au) > negligible || std::abs(poly->av) > negligible || std::abs(poly->bv) > negligible || poly->bu <= 0.0)
        xml.warn(read.node,
                 fmt::format("{}: the paramPoly3 at s = {} does not start at its own origin and heading (aU = {}, aV = {}, bU = {}, "
                             "bV = {}); it is rendered as written",
                             road_name, read.element.s_m, poly->au, poly->av, poly->bu, poly->bv));
}

double heading_difference(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * pi)); }

void check_join(XmlFile& xml, const ElementNode& from, const ElementNode& to, const std::string& road_name) {
    const PlanElement &a = from.element, &b = to.element;
    const double step = b.s_m - (a.s_m + a.length_m);
    if (std::abs(step) > reported_length_m)
        xml.warn(to.node, fmt::format("{}: the geometry at s = {} begins {:.3f} m {} the end of the one before", road_name, b.s_m,
                                      std::abs(step), step > 0.0 ? "after" : "before"));
    const PlanPoint end = plan_point(a, a.length_m), start = plan_point(b, 0.0);
    if (const double gap = std::hypot(end.x_m - start.x_m, end.y_m - start.y_m); !(gap <= reported_gap_m))
        xml.warn(to.node, fmt::format("{}: the reference line jumps by {:.3f} m at s = {}", road_name, gap, b.s_m));
    if (const double kink = heading_difference(end.heading_rad, start.heading_rad); !(kink <= reported_kink_rad))
        xml.warn(to.node, fmt::format("{}: the reference line turns by {:.2f} degrees at s = {}", road_name, degrees(kink), b.s_m));
}

} // namespace

void read_plan(XmlFile& xml, pugi::xml_node road_node, Road& road) {
    const std::string road_name = named("road", road.id);
    std::vector<ElementNode> read;
    for (const pugi::xml_node node : road_node.child("planView").children("geometry"))
        if (auto element = read_element(xml, node, road_name))
            read.push_back(std::move(*element));
    const auto ascending = [](const ElementNode& a, const ElementNode& b) { return a.element.s_m < b.element.s_m; };
    if (!std::is_sorted(read.begin(), read.end(), ascending)) {
        xml.warn(road_node.child("planView"),
                 fmt::format("{}: geometry elements are not in ascending order of s; they are sorted", road_name));
        std::stable_sort(read.begin(), read.end(), ascending);
    }
    if (read.empty())
        xml.refuse(road_node, "planView", fmt::format("{} has no geometry with a length", road_name), "at least one geometry element");
    for (std::size_t i = 0; i < read.size(); ++i) {
        check_parameters(xml, read[i], road_name);
        if (i > 0)
            check_join(xml, read[i - 1], read[i], road_name);
        road.plan.push_back(read[i].element);
    }
    if (road.plan.front().s_m > reported_length_m)
        xml.warn(read.front().node,
                 fmt::format("{}: the first geometry begins at s = {}; it is extended back to 0", road_name, road.plan.front().s_m));
    const double end = road.plan.back().s_m + road.plan.back().length_m;
    if (std::abs(end - road.length_m) > reported_length_m && road.length_m > 0.0)
        xml.warn(road_node, fmt::format("{}: its length is given as {} m, its geometry ends at {} m; the geometry holds", road_name,
                                        road.length_m, end));
    road.length_m = end;
}

void apply_offset(const RoadNetwork& network, Road& road) {
    const double c = std::cos(network.offset_heading_rad), s = std::sin(network.offset_heading_rad);
    for (PlanElement& element : road.plan) {
        const double x = element.x_m, y = element.y_m;
        element.x_m = network.offset_m.x + c * x - s * y;
        element.y_m = network.offset_m.y + s * x + c * y;
        element.heading_rad += network.offset_heading_rad;
    }
    if (network.offset_m.z == 0.0)
        return;
    if (road.elevation.empty() || road.elevation.front().s0 > 0.0)
        road.elevation.insert(road.elevation.begin(), Cubic{});
    for (Cubic& piece : road.elevation)
        piece.a += network.offset_m.z;
}

} // namespace fernlicht::opendrive
