#include "scenarios/roads/road_network.h"

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

} // namespace fernlicht
