// Adding and subtracting candela tables, and how well a table predicts itself.
#include "scenarios/lamps/candela_table.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// Width of the step that stands for a jump where one table ends, or has a gap, inside the other: narrow beside any goniometer's step
/// (0.01 degrees), wide beside the rounding of 180 in double (3e-14).
constexpr double jump_deg = 1e-9;

bool starts_gap(const CandelaTable& t, bool vertical, std::size_t border, std::size_t other) {
    const auto gap = [&](std::size_t cell) {
        const std::size_t columns = t.h_deg.size() - 1;
        return t.gaps[vertical ? cell * columns + other : other * columns + cell] != 0;
    };
    const std::size_t cells = (vertical ? t.v_deg.size() : t.h_deg.size()) - 1;
    return border > 0 && border < cells && gap(border - 1) != gap(border);
}

bool borders_gap(const CandelaTable& table, bool vertical, std::size_t sample) {
    if (table.gaps.empty())
        return false;
    const std::size_t others = (vertical ? table.h_deg.size() : table.v_deg.size()) - 1;
    for (std::size_t other = 0; other < others; ++other)
        if (starts_gap(table, vertical, sample, other))
            return true;
    return false;
}

/// The samples of one axis, with a second one beside every jump.
void add_samples(const CandelaTable& table, bool vertical, std::vector<double>& out) {
    const std::vector<double>& axis = vertical ? table.v_deg : table.h_deg;
    for (std::size_t i = 0; i < axis.size(); ++i) {
        out.push_back(axis[i]);
        const bool gap = borders_gap(table, vertical, i);
        if (i == 0 || gap)
            out.push_back(axis[i] - jump_deg);
        if (i + 1 == axis.size() || gap)
            out.push_back(axis[i] + jump_deg);
    }
}

std::vector<double> union_axis(const CandelaTable& a, const CandelaTable& b, bool vertical) {
    std::vector<double> axis;
    add_samples(a, vertical, axis);
    add_samples(b, vertical, axis);
    const auto& first = vertical ? a.v_deg : a.h_deg;
    const auto& second = vertical ? b.v_deg : b.h_deg;
    const double low = std::min(first.front(), second.front()), high = std::max(first.back(), second.back());
    std::erase_if(axis, [&](double angle) { return angle < low || angle > high; });
    std::sort(axis.begin(), axis.end());
    axis.erase(std::unique(axis.begin(), axis.end()), axis.end());
    return axis;
}

/// A cell of the union is a gap where neither table has data.
void mark_gaps(CandelaTable& out, const CandelaTable& a, const CandelaTable& b) {
    bool any = false;
    std::vector<unsigned char> gaps;
    gaps.reserve((out.v_deg.size() - 1) * (out.h_deg.size() - 1));
    for (std::size_t v = 0; v + 1 < out.v_deg.size(); ++v)
        for (std::size_t h = 0; h + 1 < out.h_deg.size(); ++h) {
            const double h_middle = (out.h_deg[h] + out.h_deg[h + 1]) / 2.0, v_middle = (out.v_deg[v] + out.v_deg[v + 1]) / 2.0;
            gaps.push_back(!has_data(a, h_middle, v_middle) && !has_data(b, h_middle, v_middle));
            any = any || gaps.back() != 0;
        }
    if (any)
        out.gaps = std::move(gaps);
}

template <class Combine> CandelaTable combined(const CandelaTable& a, const CandelaTable& b, Combine combine) {
    check_invariants(a);
    check_invariants(b);
    CandelaTable out;
    out.h_deg = union_axis(a, b, false);
    out.v_deg = union_axis(a, b, true);
    out.rule = a.rule == b.rule ? a.rule : BetweenSamples::linear_cd;
    out.cd.reserve(out.h_deg.size() * out.v_deg.size());
    for (const double v : out.v_deg)
        for (const double h : out.h_deg)
            out.cd.push_back(combine(intensity_cd(a, h, v), intensity_cd(b, h, v)));
    mark_gaps(out, a, b);
    return out;
}

/// Every second index, from the first one on; all of them when there are too few to leave any out.
std::vector<std::size_t> every_second(std::size_t count) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < count; i += count >= 3 ? 2 : 1)
        kept.push_back(i);
    return kept;
}

CandelaTable thinned(const CandelaTable& table, const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns) {
    CandelaTable out;
    out.rule = table.rule;
    for (const std::size_t h : columns)
        out.h_deg.push_back(table.h_deg[h]);
    for (const std::size_t v : rows) {
        out.v_deg.push_back(table.v_deg[v]);
        for (const std::size_t h : columns)
            out.cd.push_back(table.at(v, h));
    }
    if (table.gaps.empty())
        return out;
    for (std::size_t v = 0; v + 1 < rows.size(); ++v)
        for (std::size_t h = 0; h + 1 < columns.size(); ++h) {
            unsigned char gap = 0;
            for (std::size_t y = rows[v]; y < rows[v + 1]; ++y)
                for (std::size_t x = columns[h]; x < columns[h + 1]; ++x)
                    gap |= table.gaps[y * (table.h_deg.size() - 1) + x];
            out.gaps.push_back(gap);
        }
    return out;
}

} // namespace

CandelaTable sum(const CandelaTable& a, const CandelaTable& b) {
    return combined(a, b, [](double x, double y) { return x + y; });
}

CandelaTable difference(const CandelaTable& a, const CandelaTable& b, std::size_t& clamped) {
    // Below this a negative difference is the rounding of two equal interpolations, not more light to take than there is.
    const double rounding_cd = 1e-12 * std::max(peak_of(a).cd, peak_of(b).cd);
    clamped = 0;
    return combined(a, b, [&](double x, double y) {
        clamped += x - y < -rounding_cd;
        return std::max(x - y, 0.0);
    });
}

InterpolationError interpolation_error(const CandelaTable& table) {
    InterpolationError error;
    const double peak = peak_of(table).cd;
    const std::vector<std::size_t> rows = every_second(table.v_deg.size()), columns = every_second(table.h_deg.size());
    const bool too_small = rows.size() < 2 || columns.size() < 2 || rows.size() * columns.size() == table.cd.size();
    if (too_small || peak <= 0.0)
        return error;
    const CandelaTable coarse = thinned(table, rows, columns);
    std::vector<double> relative;
    for (std::size_t v = 0; v <= rows.back(); ++v)
        for (std::size_t h = 0; h <= columns.back(); ++h) {
            const bool kept = std::binary_search(rows.begin(), rows.end(), v) && std::binary_search(columns.begin(), columns.end(), h);
            if (kept || !has_data(coarse, table.h_deg[h], table.v_deg[v]))
                continue;
            relative.push_back(std::abs(intensity_cd(coarse, table.h_deg[h], table.v_deg[v]) - table.at(v, h)) / peak);
            if (relative.back() > error.worst_relative)
                error = {0, 0.0, 0.0, relative.back(), table.h_deg[h], table.v_deg[v]};
        }
    if (relative.empty())
        return error;
    std::sort(relative.begin(), relative.end());
    error.samples = relative.size();
    error.median_relative = relative[(relative.size() - 1) / 2];
    error.p95_relative = relative[static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(relative.size()))) - 1];
    return error;
}

} // namespace fernlicht
