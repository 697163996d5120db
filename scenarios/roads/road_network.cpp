#include "scenarios/roads/road_network.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

/// t of the outer edge of a lane whose inner edge lies at `inner_t`. A width below zero counts as zero.
double outer_edge(const Lane& lane, double inner_t, double offset, double ds) {
    const double side = lane.id > 0 ? 1.0 : -1.0;
    if (!lane.widths.empty())
        return inner_t + side * std::max(0.0, value_at(lane.widths, ds));
    if (lane.borders.empty())
        return inner_t;
    const double border = offset + value_at(lane.borders, ds);
    return side * std::max(side * inner_t, side * border); // a border inside its inner neighbour leaves no width
}

} // namespace

bool travels_with_s(const Road& road, const Lane& lane) {
    const bool usual = (lane.id < 0) != road.left_hand_traffic;
    return usual != lane.reversed;
}

const LaneSection& section_at(const Road& road, double s_m) {
    static const LaneSection none{};
    if (road.sections.empty())
        return none;
    const auto after = std::ranges::upper_bound(road.sections, s_m, {}, &LaneSection::s_m);
    return after == road.sections.begin() ? *after : *(after - 1);
}

LaneEdges lane_edges(const Road& road, const LaneSection& section, int lane_id, double s_m) {
    const double offset = value_at(road.lane_offset, s_m), ds = s_m - section.s_m;
    LaneEdges edges{offset, offset};
    if (lane_id == 0)
        return edges;
    // Lanes run from the leftmost to the rightmost: left ones are met from the end of their part, right ones from its beginning.
    const auto found = [&](auto lane, auto end) { // outwards from the centre
        for (; lane != end; ++lane)
            if ((lane_id > 0 && lane->id > 0 && lane->id <= lane_id) || (lane_id < 0 && lane->id < 0 && lane->id >= lane_id)) {
                edges = {edges.outer_t_m, outer_edge(*lane, edges.outer_t_m, offset, ds)};
                if (lane->id == lane_id)
                    return true;
            }
        return false;
    };
    if (lane_id > 0 ? found(section.lanes.rbegin(), section.lanes.rend()) : found(section.lanes.begin(), section.lanes.end()))
        return edges;
    throw std::out_of_range(fmt::format("road '{}' has no lane {} at s = {}", road.id, lane_id, s_m));
}

namespace {

void flip(auto&... values) { ((values = 0.0 - values), ...); } // not -value: no negative zeros

void flip(std::vector<Cubic>& pieces) {
    for (Cubic& piece : pieces)
        flip(piece.a, piece.b, piece.c, piece.d);
}

void mirror(Line&) {}
void mirror(Arc& arc) { flip(arc.curvature_per_m); }
void mirror(Spiral& spiral) {
    flip(spiral.start_per_m, spiral.end_per_m);
    for (glm::dvec2& step : spiral.steps_m)
        flip(step.y);
}
void mirror(Poly3& curve) { flip(curve.a, curve.b, curve.c, curve.d); } // its knots tell arc length against u, which stays
void mirror(ParamPoly3& curve) { flip(curve.av, curve.bv, curve.cv, curve.dv); }

void mirror(PlanElement& element) {
    flip(element.y_m, element.heading_rad);
    std::visit([](auto& shape) { mirror(shape); }, element.shape);
}

/// h(-t): each piece from its other end, the lines that the profile goes on with beyond its ends as pieces of their own.
void mirror(ShapeProfile& profile) {
    constexpr double beyond_m = 1000.0; // no road is wider
    std::vector<Cubic> pieces;
    const std::vector<Cubic>& old = profile.over_t;
    if (old.empty())
        return;
    for (std::size_t i = old.size(); i-- > 0;) {
        const Cubic& piece = old[i];
        const double length = i + 1 < old.size() ? old[i + 1].s0 - piece.s0 : beyond_m;
        pieces.push_back({0.0 - (piece.s0 + length), piece.a + length * (piece.b + length * (piece.c + length * piece.d)),
                          0.0 - (piece.b + length * (2.0 * piece.c + length * 3.0 * piece.d)), piece.c + 3.0 * length * piece.d,
                          0.0 - piece.d});
    }
    pieces.push_back({0.0 - old.front().s0, old.front().a, 0.0 - old.front().b, 0.0, 0.0});
    profile.over_t = std::move(pieces);
}

void mirror(RoadMark& mark, bool on_centre_lane) {
    for (RoadMark::Stripe& stripe : mark.stripes)
        flip(stripe.t_m);
    // Named from left to right on the centre lane, elsewhere from the inner side to the outer.
    if (on_centre_lane && mark.kind == MarkKind::solid_broken)
        mark.kind = MarkKind::broken_solid;
    else if (on_centre_lane && mark.kind == MarkKind::broken_solid)
        mark.kind = MarkKind::solid_broken;
}

void mirror(Lane& lane) {
    for (RoadMark& mark : lane.marks)
        mirror(mark, lane.id == 0);
    lane.id = -lane.id;
    flip(lane.borders);
    for (std::optional<int>* link : {&lane.predecessor, &lane.successor})
        if (*link)
            *link = -**link;
}

void mirror(RoadObject& object) {
    flip(object.t_m, object.heading_rad, object.roll_rad);
    for (glm::dvec3& corner : object.outline_m)
        flip(corner.y);
    std::ranges::reverse(object.outline_m); // round it the same way as before
    std::ranges::reverse(object.outline_base_m);
}

void mirror(Road& road) {
    road.left_hand_traffic = !road.left_hand_traffic;
    for (PlanElement& element : road.plan)
        mirror(element);
    flip(road.superelevation);
    flip(road.lane_offset);
    for (ShapeProfile& profile : road.shapes)
        mirror(profile);
    for (LaneSection& section : road.sections) {
        for (Lane& lane : section.lanes)
            mirror(lane);
        std::ranges::reverse(section.lanes);
    }
    for (RoadObject& object : road.objects)
        mirror(object);
    for (RoadSignal& signal : road.signals)
        flip(signal.t_m, signal.heading_offset_rad);
}

} // namespace

RoadNetwork mirrored(RoadNetwork network) {
    flip(network.offset_m.y, network.offset_heading_rad);
    for (Road& road : network.roads)
        mirror(road);
    for (Junction& junction : network.junctions)
        for (Junction::Connection& connection : junction.connections)
            for (auto& [from, to] : connection.lane_links)
                from = -from, to = -to;
    return network;
}

} // namespace fernlicht
