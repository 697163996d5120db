#include "scenarios/roads/road_network.h"

#include <algorithm>

namespace fernlicht {
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
