// Distance along a lane's centre against s, in cells on which the geometry is smooth.
#include "scenarios/roads/gauss_legendre.h"
#include "scenarios/roads/route.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double longest_cell_m = 5.0;
constexpr double shortest_cell_m = 1e-9; ///< what lies between two borders that are the same but for rounding

/// Every s within (low, high) at which some polynomial of the road or of the section's lanes begins.
std::vector<double> borders(const Road& road, const LaneSection& section, double low, double high) {
    std::vector<double> at{low, high};
    const auto add = [&](double s) {
        if (s > low && s < high)
            at.push_back(s);
    };
    for (const PlanElement& element : road.plan)
        add(element.s_m);
    for (const auto* pieces : {&road.elevation, &road.superelevation, &road.lane_offset})
        for (const Cubic& piece : *pieces)
            add(piece.s0);
    for (const ShapeProfile& profile : road.shapes)
        add(profile.s_m);
    for (const Lane& lane : section.lanes)
        for (const auto* pieces : {&lane.widths, &lane.borders})
            for (const Cubic& piece : *pieces)
                add(section.s_m + piece.s0);
    std::sort(at.begin(), at.end());
    return at;
}

/// t of the lane's centre as one cubic over s = low .. high: through four inner points, exact where every width is one cubic.
Cubic centre_cubic(const Road& road, const LaneSection& section, int lane, double low, double high) {
    const double step = (high - low) / 5.0;
    std::array<double, 4> t{};
    for (std::size_t i = 0; i < 4; ++i) {
        const LaneEdges edges = lane_edges(road, section, lane, low + step * static_cast<double>(i + 1));
        t[i] = 0.5 * (edges.inner_t_m + edges.outer_t_m);
    }
    // Newton's divided differences at x = 1, 2, 3, 4 steps, written out in powers of x.
    const double d1 = t[1] - t[0], d2 = (t[2] - 2.0 * t[1] + t[0]) / 2.0, d3 = (t[3] - 3.0 * t[2] + 3.0 * t[1] - t[0]) / 6.0;
    const double a = t[0] - d1 + 2.0 * d2 - 6.0 * d3, b = d1 - 3.0 * d2 + 11.0 * d3, c = d2 - 6.0 * d3, d = d3;
    return {low, a, b / step, c / (step * step), d / (step * step * step)};
}

/// Metres along the lane's centre per metre of s.
double stretch(const SurfaceStrip& strip, const Cubic& centre, double s) {
    const SurfacePoint point = surface_point(strip, s, centre.at(s));
    return std::max(glm::length(point.by_s + centre.slope(s) * point.by_t), 1e-6);
}

} // namespace

void Route::add_cells(std::size_t leg_index) {
    const Leg leg = legs_[leg_index];
    const Road& road = network_->roads[leg.road];
    const LaneSection& section = road.sections[leg.section];
    std::vector<double> at = borders(road, section, std::min(leg.from_s_m, leg.to_s_m), std::max(leg.from_s_m, leg.to_s_m));
    if (!leg.with_s)
        std::reverse(at.begin(), at.end());
    for (std::size_t i = 1; i < at.size(); ++i) {
        const double span = at[i] - at[i - 1];
        if (std::abs(span) < shortest_cell_m)
            continue;
        const double parts = std::ceil(std::abs(span) / longest_cell_m);
        for (double part = 0.0; part < parts; part += 1.0) {
            Cell cell{};
            cell.start_m = length_m_;
            cell.leg = leg_index;
            cell.from_s_m = at[i - 1] + span * part / parts;
            cell.to_s_m = part + 1.0 == parts ? at[i] : at[i - 1] + span * (part + 1.0) / parts;
            cell.strip = strip_at(road, 0.5 * (cell.from_s_m + cell.to_s_m));
            cell.centre = centre_cubic(road, section, leg.lane, std::min(cell.from_s_m, cell.to_s_m), std::max(cell.from_s_m, cell.to_s_m));
            const double ds = cell.to_s_m - cell.from_s_m;
            for (std::size_t n = 0; n < gauss_node.size(); ++n)
                cell.length_m += gauss_weight[n] * std::abs(ds) * stretch(cell.strip, cell.centre, cell.from_s_m + gauss_node[n] * ds);
            const double side = ds > 0.0 ? 1.0 : -1.0;
            cell.from_slope = side / stretch(cell.strip, cell.centre, cell.from_s_m);
            cell.to_slope = side / stretch(cell.strip, cell.centre, cell.to_s_m);
            length_m_ += cell.length_m;
            cells_.push_back(cell);
        }
    }
}

const Route::Cell& Route::cell_at(double distance_m) const {
    const auto after =
        std::upper_bound(cells_.begin(), cells_.end(), distance_m, [](double d, const Cell& cell) { return d < cell.start_m; });
    return after == cells_.begin() ? *after : *(after - 1);
}

/// Cubic Hermite interpolation between the cell's ends: right to 1e-5 in speed, some 10 micrometres in place, on spirals of radius 30 m.
double Route::s_at(const Cell& cell, double distance_m) const {
    const double along = std::clamp(distance_m - cell.start_m, 0.0, cell.length_m), x = along / cell.length_m;
    const double ds = cell.to_s_m - cell.from_s_m, a = cell.from_slope * cell.length_m, b = cell.to_slope * cell.length_m;
    return cell.from_s_m + x * (a + x * (3.0 * ds - 2.0 * a - b + x * (a + b - 2.0 * ds)));
}

} // namespace fernlicht
