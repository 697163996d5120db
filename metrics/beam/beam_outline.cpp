#include "metrics/beam/beam_outline.h"

#include "metrics/statistics/statistics.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double outline_column_deg = 0.5, outline_half_width_deg = 6.0, outline_reach_deg = 6.0, outline_row_deg = 0.05;
constexpr double least_window_deg = 0.5, least_gap_deg = 0.2;
constexpr double edge_factor = 5.0, edge_over_other_side = 2.0;
constexpr double column_share = 0.05;          // of the peak: a column that is looked at
constexpr double edge_light = 0.1;             // of the column's maximum, on the bright side of an edge
constexpr double darkest_outline_share = 1e-3; // of the peak: what is darker counts as this
constexpr double cone_deg = 15.0, spread_deg = 25.0;
constexpr double beside_middle_deg = 1.5;
constexpr std::size_t fewest_edge_columns = 8, fewest_side_columns = 3;
constexpr double edge_column_share = 0.6;

/// Sums of a column's light from its foot up, to take means of; rows outside the table's data end it.
struct OutlineColumn {
    double v_from_deg = 0.0;
    std::vector<double> sums{0.0};
    double most_cd = 0.0;

    double mean(std::size_t from, std::size_t to) const { return (sums[to] - sums[from]) / static_cast<double>(to - from); }
};

/// The rows round the peak that have data without a gap.
OutlineColumn column_at(const CandelaTable& t, double h_deg, double v_deg) {
    const auto rows = static_cast<int>(std::lround(outline_reach_deg / outline_row_deg));
    int first = 0, last = 0;
    while (first > -rows && has_data(t, h_deg, v_deg + outline_row_deg * (first - 1)))
        --first;
    while (last < rows && has_data(t, h_deg, v_deg + outline_row_deg * (last + 1)))
        ++last;
    OutlineColumn column;
    column.v_from_deg = v_deg + outline_row_deg * first;
    for (int i = first; i <= last; ++i) {
        const double cd = intensity_cd(t, h_deg, v_deg + outline_row_deg * i);
        column.most_cd = std::max(column.most_cd, cd);
        column.sums.push_back(column.sums.back() + cd);
    }
    return column;
}

struct OutlineFall {
    double v_deg = 0.0, log_factor = 0.0;
};

/// The deepest fall upwards or downwards. Where it is as deep over several rows, the middle of these.
OutlineFall deepest_fall(const OutlineColumn& column, bool upwards, double step_deg, double floor_cd) {
    const auto rows_of = [](double deg) { return static_cast<std::size_t>(std::lround(deg / outline_row_deg)); };
    const std::size_t window = rows_of(std::max(least_window_deg, step_deg)), gap = rows_of(std::max(least_gap_deg, step_deg));
    const std::size_t span = 2 * window + gap, rows = column.sums.size() - 1;
    std::vector<double> falls;
    for (std::size_t foot = 0; foot + span <= rows; ++foot) {
        const double low = column.mean(foot, foot + window), high = column.mean(foot + window + gap, foot + span);
        const double bright = upwards ? low : high, dark = upwards ? high : low;
        falls.push_back(bright < edge_light * column.most_cd ? 0.0 : std::log(std::max(bright, floor_cd) / std::max(dark, floor_cd)));
    }
    const auto top = std::ranges::max_element(falls);
    if (top == falls.end() || *top <= 0.0)
        return {};
    auto first = top, last = top;
    while (first != falls.begin() && *(first - 1) >= 0.95 * *top)
        --first;
    while (last + 1 != falls.end() && *(last + 1) >= 0.95 * *top)
        ++last;
    const double foot = static_cast<double>((first - falls.begin()) + (last - falls.begin())) / 2.0;
    return {column.v_from_deg + outline_row_deg * (foot + static_cast<double>(span - 1) / 2.0), *top};
}

void find_edges(const LampFile& lamp, BeamOutline& outline) {
    const CandelaTable& t = lamp.table;
    const double floor_cd = darkest_outline_share * outline.peak.cd;
    std::size_t columns = 0;
    for (double aside = -outline_half_width_deg; aside <= outline_half_width_deg + 1e-9; aside += outline_column_deg) {
        const double h = outline.middle_h_deg + aside;
        if (!has_data(t, h, outline.peak.v_deg))
            continue;
        const OutlineColumn column = column_at(t, h, outline.peak.v_deg);
        if (column.most_cd < column_share * outline.peak.cd)
            continue;
        ++columns;
        double step = 0.0;
        for (const double v : {-1.0, 0.0, 1.0})
            step = std::max(step, step_in_v(lamp, {h, outline.peak.v_deg + v}).value_or(0.0));
        const OutlineFall up = deepest_fall(column, true, step, floor_cd), down = deepest_fall(column, false, step, floor_cd);
        const auto is_edge = [](const OutlineFall& edge, const OutlineFall& other) {
            return edge.log_factor >= std::log(edge_factor) && edge.log_factor >= other.log_factor + std::log(edge_over_other_side);
        };
        if (is_edge(up, down))
            outline.upper_edge.push_back({h, up.v_deg});
        if (is_edge(down, up))
            outline.lower_edge.push_back({h, down.v_deg});
    }
    for (std::vector<Direction>* const edge : {&outline.upper_edge, &outline.lower_edge})
        if (edge->size() < fewest_edge_columns || static_cast<double>(edge->size()) < edge_column_share * static_cast<double>(columns))
            edge->clear();
}

/// cos of the angle between two directions.
double cos_between(Direction a, Direction b) {
    return std::sin(radians(a.v_deg)) * std::sin(radians(b.v_deg)) +
           std::cos(radians(a.v_deg)) * std::cos(radians(b.v_deg)) * std::cos(radians(a.h_deg - b.h_deg));
}

/// By the middles of the table's cells, which is near enough for a share.
double concentration_of(const CandelaTable& t, const Peak& peak) {
    double all = 0.0, near = 0.0;
    const double cos_cone = std::cos(radians(cone_deg));
    for (std::size_t y = 0; y + 1 < t.v_deg.size(); ++y)
        for (std::size_t x = 0; x + 1 < t.h_deg.size(); ++x) {
            const Direction middle{(t.h_deg[x] + t.h_deg[x + 1]) / 2.0, (t.v_deg[y] + t.v_deg[y + 1]) / 2.0};
            if (!t.gaps.empty() && t.gaps[y * (t.h_deg.size() - 1) + x] != 0)
                continue;
            const double cd = (t.at(y, x) + t.at(y, x + 1) + t.at(y + 1, x) + t.at(y + 1, x + 1)) / 4.0;
            const double light = cd * std::cos(radians(middle.v_deg)) * (t.h_deg[x + 1] - t.h_deg[x]) * (t.v_deg[y + 1] - t.v_deg[y]);
            all += light;
            if (cos_between(middle, {peak.h_deg, peak.v_deg}) >= cos_cone)
                near += light;
        }
    return all > 0.0 ? near / all : 0.0;
}

std::optional<double> height_to_width_of(const CandelaTable& t, const Peak& peak) {
    double n = 0.0, h1 = 0.0, h2 = 0.0, v1 = 0.0, v2 = 0.0;
    for (double v = -spread_deg; v <= spread_deg; v += outline_column_deg)
        for (double h = -spread_deg; h <= spread_deg; h += outline_column_deg) {
            const double cd = intensity_cd(t, peak.h_deg + h, peak.v_deg + v);
            if (cd < column_share * peak.cd)
                continue;
            n += cd;
            h1 += cd * h;
            h2 += cd * h * h;
            v1 += cd * v;
            v2 += cd * v * v;
        }
    const double width = h2 / n - h1 * h1 / (n * n), height = v2 / n - v1 * v1 / (n * n);
    return n > 0.0 && width > 0.0 ? std::optional(std::sqrt(std::max(0.0, height) / width)) : std::nullopt;
}

/// V of the columns of one side, between 1.5 degrees from the middle and the edge's end.
std::vector<double> side_of(const std::vector<Direction>& edge, double middle_h_deg, double side) {
    std::vector<double> v_deg;
    for (const Direction& one : edge)
        if (side * (one.h_deg - middle_h_deg) >= beside_middle_deg)
            v_deg.push_back(one.v_deg);
    return v_deg;
}

} // namespace

std::optional<double> BeamOutline::upper_level_deg() const {
    std::optional<double> lowest;
    for (const double side : {-1.0, 1.0})
        if (const std::vector<double> v_deg = side_of(upper_edge, middle_h_deg, side); v_deg.size() >= fewest_side_columns)
            lowest = std::min(lowest.value_or(90.0), middle_of(v_deg));
    return lowest;
}

std::optional<double> BeamOutline::lower_level_deg() const {
    std::optional<double> highest;
    for (const double side : {-1.0, 1.0})
        if (const std::vector<double> v_deg = side_of(lower_edge, middle_h_deg, side); v_deg.size() >= fewest_side_columns)
            highest = std::max(highest.value_or(-90.0), middle_of(v_deg));
    return highest;
}

std::optional<double> BeamOutline::rise_deg() const {
    const std::vector<double> left = side_of(upper_edge, middle_h_deg, -1.0), right = side_of(upper_edge, middle_h_deg, 1.0);
    if (left.size() < fewest_side_columns || right.size() < fewest_side_columns)
        return std::nullopt;
    return middle_of(right) - middle_of(left);
}

std::optional<double> BeamOutline::elbow_h_deg() const {
    const auto level = upper_level_deg();
    if (!level)
        return std::nullopt;
    std::vector<Direction> edge = upper_edge; // in the direction in which it rises
    const auto mean_of = [&](std::size_t from, std::size_t to) {
        double sum = 0.0;
        for (std::size_t i = from; i < to; ++i)
            sum += edge[i].v_deg / static_cast<double>(to - from);
        return sum;
    };
    const std::size_t third = edge.size() / 3;
    const bool rises_left = mean_of(edge.size() - third, edge.size()) < mean_of(0, third);
    if (rises_left) {
        std::ranges::reverse(edge);
        for (Direction& one : edge)
            one.h_deg = -one.h_deg;
    }
    constexpr double foot_deg = 0.15, top_deg = 0.45;
    const auto crossing = [&](double above_deg) -> std::optional<double> {
        for (std::size_t i = 1; i < edge.size(); ++i)
            if (const double v = *level + above_deg, from = edge[i - 1].v_deg, to = edge[i].v_deg; from < v && to >= v)
                return edge[i - 1].h_deg + (edge[i].h_deg - edge[i - 1].h_deg) * (v - from) / (to - from);
        return std::nullopt;
    };
    const auto foot = crossing(foot_deg), top = crossing(top_deg);
    if (!foot || !top)
        return std::nullopt;
    for (const Direction& one : edge)
        if (one.h_deg < *foot ? std::abs(one.v_deg - *level) > foot_deg : one.h_deg < *top && one.v_deg < *level + 0.5 * foot_deg)
            return std::nullopt;
    const double elbow = *foot - (*top - *foot) * foot_deg / (top_deg - foot_deg);
    return rises_left ? -elbow : elbow;
}

BeamOutline outline_of(const LampFile& lamp) {
    BeamOutline outline;
    outline.peak = peak_of(lamp.table);
    outline.flux_lm = flux_lm(lamp.table);
    if (!(outline.peak.cd > 0.0))
        return outline;
    outline.middle_h_deg = std::abs(outline.peak.h_deg) > 10.0 ? outline.peak.h_deg : 0.0;
    outline.concentration = concentration_of(lamp.table, outline.peak);
    outline.height_to_width = height_to_width_of(lamp.table, outline.peak);
    find_edges(lamp, outline);
    return outline;
}

std::optional<double> step_in_v(const LampFile& lamp, Direction at) {
    const CandelaTable& own = lamp.measured ? lamp.measured->table : lamp.table;
    const TwoAngles native = lamp.measured ? lamp.measured->system.to_native(at.h_deg, at.v_deg) : TwoAngles{at.h_deg, at.v_deg};
    const auto cell = [](const std::vector<double>& axis, double angle) -> std::optional<std::size_t> {
        if (!(angle >= axis.front() && angle <= axis.back()))
            return std::nullopt;
        const auto above = std::ranges::upper_bound(axis, angle);
        return std::min(static_cast<std::size_t>(above - axis.begin()), axis.size() - 1) - 1;
    };
    const auto x = cell(own.h_deg, native.h_deg), y = cell(own.v_deg, native.v_deg);
    if (!x || !y)
        return std::nullopt;
    if (!lamp.measured)
        return own.v_deg[*y + 1] - own.v_deg[*y];
    double low = 90.0, high = -90.0;
    for (const std::size_t i : {*x, *x + 1})
        for (const std::size_t j : {*y, *y + 1}) {
            const double v = lamp.measured->system.to_un(own.h_deg[i], own.v_deg[j]).v_deg;
            low = std::min(low, v);
            high = std::max(high, v);
        }
    return high - low;
}

} // namespace fernlicht
