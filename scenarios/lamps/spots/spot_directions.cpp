#include "scenarios/lamps/spots/spot_directions.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double coarsest_deg = 5.0;

/// A sample of one axis and the stretch that it stands for.
struct DegreeStretch {
    double at_deg, from_deg, to_deg;
};

/// Even stretches of at most 5 degrees with their samples in the middle.
void fill(std::vector<DegreeStretch>& axis, double from_deg, double to_deg) {
    if (!(to_deg > from_deg))
        return;
    const int parts = static_cast<int>(std::ceil((to_deg - from_deg) / coarsest_deg));
    const double step = (to_deg - from_deg) / parts;
    for (int i = 0; i < parts; ++i)
        axis.push_back({from_deg + (i + 0.5) * step, from_deg + i * step, from_deg + (i + 1) * step});
}

/// From -90 to 90 degrees: the table's samples with half of the way to their neighbours, and filled where there are none.
std::vector<DegreeStretch> stretches(const std::vector<double>& samples) {
    std::vector<DegreeStretch> axis;
    std::vector<double> own;
    std::copy_if(samples.begin(), samples.end(), std::back_inserter(own), [](double angle) { return std::abs(angle) <= 90.0; });
    if (own.size() < 2) {
        fill(axis, -90.0, 90.0);
        return axis;
    }
    // Between samples more than 5 degrees apart the table's rule is sampled too.
    const auto reach = [](double a, double b) { return std::min(0.5 * (b - a), 0.5 * coarsest_deg); };
    fill(axis, -90.0, own.front());
    for (std::size_t i = 0; i < own.size(); ++i) {
        const double from = i == 0 ? own[i] : own[i] - reach(own[i - 1], own[i]);
        const double to = i + 1 == own.size() ? own[i] : own[i] + reach(own[i], own[i + 1]);
        axis.push_back({own[i], from, to});
        if (i + 1 < own.size())
            fill(axis, to, own[i + 1] - reach(own[i], own[i + 1]));
    }
    fill(axis, own.back(), 90.0);
    return axis;
}

double width_rad(const DegreeStretch& s) { return radians(s.to_deg - s.from_deg); }
double band(const DegreeStretch& s) { return std::sin(radians(s.to_deg)) - std::sin(radians(s.from_deg)); }

/// The table on both axes' samples.
struct Samples {
    std::vector<DegreeStretch> h, v;
    std::vector<double> cd; ///< rows of V

    double at(std::size_t row, std::size_t column) const { return cd[row * h.size() + column]; }
};

Samples samples_of(const CandelaTable& table) {
    Samples s{stretches(table.h_deg), stretches(table.v_deg), {}};
    s.cd.reserve(s.h.size() * s.v.size());
    for (const DegreeStretch& row : s.v)
        for (const DegreeStretch& column : s.h)
            s.cd.push_back(intensity_cd(table, column.at_deg, row.at_deg));
    return s;
}

/// How much happens from each sample of an axis to the next, in shares of the whole: half of it the change of light, half of it the way.
std::vector<double> change_along(const Samples& s, bool across) {
    const std::size_t count = across ? s.h.size() : s.v.size(), others = across ? s.v.size() : s.h.size();
    std::vector<double> change(count - 1);
    double total = 0.0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        double square = 0.0;
        for (std::size_t k = 0; k < others; ++k) {
            const double step = across ? s.at(k, i + 1) - s.at(k, i) : s.at(i + 1, k) - s.at(i, k);
            square += step * step * (across ? band(s.v[k]) : width_rad(s.h[k]));
        }
        change[i] = std::sqrt(square);
        total += change[i];
    }
    const std::vector<DegreeStretch>& axis = across ? s.h : s.v;
    for (std::size_t i = 0; i + 1 < count; ++i)
        change[i] = (total > 0.0 ? 0.5 * change[i] / total : 0.0) + 0.5 * (axis[i + 1].at_deg - axis[i].at_deg) / 180.0;
    return change;
}

/// First index of each group and the end: neighbours between which less than 1 / `most` of everything happens go together.
std::vector<std::size_t> groups(const std::vector<double>& change, std::size_t most) {
    std::vector<std::size_t> first{0};
    double since = 0.0;
    for (std::size_t i = 0; i < change.size(); ++i) {
        since += change[i];
        if (since * static_cast<double>(most) >= 1.0 || change.size() < most) {
            first.push_back(i + 1);
            since = 0.0;
        }
    }
    first.push_back(change.size() + 1);
    return first;
}

struct Range {
    std::size_t first, end;
    bool single() const { return end - first == 1; }
};

void add_group(SpotDirections& out, const Samples& s, Range rows, Range columns) {
    double weight = 0.0, first = 0.0, second = 0.0;
    glm::dvec3 sum(0.0);
    for (std::size_t row = rows.first; row < rows.end; ++row)
        for (std::size_t column = columns.first; column < columns.end; ++column) {
            const double w = width_rad(s.h[column]) * band(s.v[row]), cd = s.at(row, column);
            weight += w;
            first += w * cd;
            second += w * cd * cd;
            sum += w * direction_of(s.h[column].at_deg, s.v[row].at_deg);
            out.lit_sr += cd > 0.0 ? w : 0.0;
        }
    const bool single = rows.single() && columns.single();
    const glm::dvec3 d = single ? direction_of(s.h[columns.first].at_deg, s.v[rows.first].at_deg) : glm::normalize(sum);
    out.x.push_back(d.x);
    out.y.push_back(d.y);
    out.z.push_back(d.z);
    out.cd.push_back(single ? s.at(rows.first, columns.first) : first / weight);
    out.weight_sr.push_back(weight);
    out.total_cd2_sr += second;
    out.within_cd2_sr += single ? 0.0 : std::max(second - first / weight * first, 0.0);
}

} // namespace

glm::dvec3 direction_of(double h_deg, double v_deg) {
    const double h = radians(h_deg), v = radians(v_deg);
    return {std::sin(h) * std::cos(v), std::sin(v), std::cos(h) * std::cos(v)};
}

SpotDirections spot_directions(const CandelaTable& table, std::size_t most) {
    const Samples s = samples_of(table);
    const bool all = s.cd.size() <= most;
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(most)));
    const std::vector<std::size_t> columns = groups(change_along(s, true), all ? s.h.size() : side),
                                   rows = groups(change_along(s, false), all ? s.v.size() : side);
    SpotDirections out;
    for (std::size_t r = 0; r + 1 < rows.size(); ++r)
        for (std::size_t c = 0; c + 1 < columns.size(); ++c)
            add_group(out, s, {rows[r], rows[r + 1]}, {columns[c], columns[c + 1]});
    return out;
}

} // namespace fernlicht
