#include "scenarios/openscenario/reader/read_parts.h"

#include "scenarios/values/errors.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht::osc {
namespace {

std::optional<Orientation> orientation_of(const OscNode& node) {
    const auto given = node.find("Orientation");
    if (!given)
        return {};
    return Orientation{given->has("type") && given->choice("type", {"absolute", "relative"}) == 1, given->angle_or_0("h"),
                       given->angle_or_0("p"), given->angle_or_0("r")};
}

std::string entity_of(const OscNode& node) { return node.entity(node.has("entityRef") ? "entityRef" : "object"); }

RoutePosition read_route_position(const OscNode& node) {
    RoutePosition position;
    const OscNode holder = node.require("RouteRef");
    position.route = read_route(holder);
    const auto inside = node.find("InRoutePosition");
    const OscNode where = (inside ? *inside : node).only("a position on the route");
    if (where.element() == "FromLaneCoordinates") {
        position.s_m = where.length("pathS");
        position.lane = where.whole("laneId");
        position.offset_m = where.length_or_0("laneOffset");
    } else if (where.element() == "FromRoadCoordinates") {
        position.s_m = where.length("pathS");
        position.t_m = where.length("t");
    } else if (where.element() == "FromCurrentEntity") {
        position.current_entity = where.entity("entityRef");
    } else {
        where.refuse("", "cannot be used here", "FromLaneCoordinates, FromRoadCoordinates or FromCurrentEntity");
    }
    return position;
}

decltype(Position::place) read_kind(const OscNode& node) {
    const std::string kind = node.element();
    if (kind == "WorldPosition") {
        for (const char* axis : {"x", "y", "z"})
            if (const double at = node.number_or(axis, 0.0); !(std::abs(at) <= 1e9))
                node.refuse(axis, fmt::format("found {}", at), "a place within 1e9 m of the origin");
        const auto angle = [&](const char* name) { return node.has(name) ? std::optional(node.angle_or_0(name)) : std::nullopt; };
        return WorldPosition{node.number("x"), node.number("y"), node.number_if("z"), angle("h"), angle("p"), angle("r")};
    }
    if (kind == "LanePosition")
        return LanePosition{node.text("roadId"), node.whole("laneId"), node.length("s"), node.length_or_0("offset")};
    if (kind == "RoadPosition")
        return RoadPosition{node.text("roadId"), node.length("s"), node.length("t")};
    if (kind == "RelativeLanePosition")
        return RelativeLanePosition{entity_of(node), node.whole("dLane"), node.length(node.has("dsLane") ? "dsLane" : "ds"),
                                    node.length_or_0("offset")};
    if (kind == "RelativeRoadPosition")
        return RelativeRoadPosition{entity_of(node), node.length("ds"), node.length("dt")};
    if (kind == "RelativeObjectPosition" || kind == "RelativeWorldPosition")
        return RelativePosition{entity_of(node), node.length("dx"), node.length("dy"), node.length_or_0("dz"),
                                kind == "RelativeWorldPosition"};
    if (kind == "RoutePosition")
        return read_route_position(node);
    if (kind == "TrajectoryPosition")
        return TrajectoryPosition{read_trajectory(node.require("TrajectoryRef")), node.length("s"), node.length_or_0("t")};
    if (kind == "GeoPosition") {
        node.unsupported("geographic positions");
        return WorldPosition{};
    }
    node.refuse("", "is no position", "one of OpenSCENARIO's positions");
}

Vertex vertex_of(const OscNode& node) {
    const std::optional<double> time = node.number_if("time");
    const double weight = node.number_or("weight", 1.0);
    return {time, read_position(node), weight};
}

void refuse_falling_times(const std::vector<OscNode>& points) {
    std::optional<double> before;
    for (const OscNode& point : points) {
        const std::optional<double> time = point.number_if("time");
        if (time && before && !(*time >= *before))
            point.refuse("time", fmt::format("found {} after {}", *time, *before), "times that do not fall");
        before = time ? time : before;
    }
}

ClothoidSegment read_segment(const OscNode& node) {
    const bool spline = node.element() == "ClothoidSplineSegment";
    ClothoidSegment segment;
    segment.length_m = node.number("length");
    if (!(segment.length_m > 0.0 && segment.length_m <= 1e6))
        node.refuse("length", fmt::format("found {}", segment.length_m), "a length above 0, at most 1e6 m");
    if (spline) {
        segment.curvature_per_m = node.number("curvatureStart");
        segment.end_curvature_per_m = node.number("curvatureEnd");
        segment.h_offset_rad = node.number_or("hOffset", 0.0);
        segment.time_start_s = node.number_if("timeStart");
        if (const auto start = node.find("PositionStart"))
            segment.start = read_position(start->find("Position").value_or(*start));
    } else {
        const char* dot = node.has("curvaturePrime") ? "curvaturePrime" : "curvatureDot";
        segment.curvature_per_m = node.number("curvature");
        segment.end_curvature_per_m = segment.curvature_per_m + node.number(dot) * segment.length_m;
        segment.time_start_s = node.number_if("startTime");
        segment.time_end_s = node.number_if("stopTime");
        segment.start = read_position(node);
    }
    return segment;
}

Nurbs read_nurbs(const OscNode& node) {
    Nurbs nurbs;
    nurbs.order = node.whole("order");
    for (const OscNode& point : node.children("ControlPoint"))
        nurbs.points.push_back(vertex_of(point));
    refuse_falling_times(node.children("ControlPoint"));
    for (const OscNode& knot : node.children("Knot"))
        nurbs.knots.push_back(knot.number("value"));
    if (nurbs.order < 2 || nurbs.order > 16 || nurbs.points.size() < static_cast<std::size_t>(nurbs.order))
        node.refuse("order", fmt::format("found {} with {} control points", nurbs.order, nurbs.points.size()),
                    "an order from 2 to 16 and at least as many control points");
    if (nurbs.knots.size() != nurbs.points.size() + static_cast<std::size_t>(nurbs.order))
        node.refuse("", fmt::format("has {} knots", nurbs.knots.size()),
                    fmt::format("{}: control points and order added", nurbs.points.size() + static_cast<std::size_t>(nurbs.order)));
    for (std::size_t i = 1; i < nurbs.knots.size(); ++i)
        if (nurbs.knots[i] < nurbs.knots[i - 1])
            node.refuse("Knot", fmt::format("found {} after {}", nurbs.knots[i], nurbs.knots[i - 1]), "knots that do not fall");
    return nurbs;
}

std::shared_ptr<const Trajectory> trajectory_of(const OscNode& node) {
    const OpenEntry open(node);
    auto trajectory = std::make_shared<Trajectory>();
    trajectory->closed = node.flag_or("closed", false);
    const OscNode shape = node.require("Shape").only("a polyline, clothoid or NURBS");
    if (shape.element() == "Polyline") {
        Polyline line;
        for (const OscNode& vertex : shape.children("Vertex"))
            line.push_back(vertex_of(vertex));
        refuse_falling_times(shape.children("Vertex"));
        if (line.size() < 2)
            shape.refuse("", fmt::format("has {} vertices", line.size()), "at least 2");
        trajectory->shape = std::move(line);
    } else if (shape.element() == "Clothoid") {
        trajectory->shape = ClothoidPath{read_segment(shape)};
    } else if (shape.element() == "ClothoidSpline") {
        ClothoidPath path;
        for (const OscNode& segment : shape.children("ClothoidSplineSegment"))
            path.push_back(read_segment(segment));
        if (path.empty())
            shape.refuse("", "has no segment", "at least one ClothoidSplineSegment");
        path.back().time_end_s = shape.number_if("timeEnd");
        trajectory->shape = std::move(path);
    } else if (shape.element() == "Nurbs") {
        trajectory->shape = read_nurbs(shape);
    } else {
        shape.refuse("", "is no shape of a trajectory", "Polyline, Clothoid, ClothoidSpline or Nurbs");
    }
    return trajectory;
}

} // namespace

Position read_position(const OscNode& node) {
    const OscNode position = node.element() == "Position" ? node : node.find("Position").value_or(node);
    const OscNode kind = position.only("a position");
    Position out{read_kind(kind), {}};
    if (!std::holds_alternative<WorldPosition>(out.place))
        out.orientation = orientation_of(kind);
    return out;
}

std::shared_ptr<const Route> read_route(const OscNode& holder) {
    const auto node = own_or_catalog(holder, "Route");
    if (!node)
        holder.refuse("", "has no route", "a Route or a CatalogReference");
    const OpenEntry open(*node);
    auto route = std::make_shared<Route>();
    for (const OscNode& point : node->children("Waypoint"))
        route->waypoints.push_back(read_position(point));
    if (route->waypoints.size() < 2)
        node->refuse("", fmt::format("has {} waypoints", route->waypoints.size()), "at least 2");
    return route;
}

std::shared_ptr<const Trajectory> read_trajectory(const OscNode& holder) {
    if (const auto node = own_or_catalog(holder, "Trajectory"))
        return trajectory_of(*node);
    holder.refuse("", "has no trajectory", "a Trajectory or a CatalogReference");
}

} // namespace fernlicht::osc
