// Adding and subtracting candela tables, and how well a table predicts itself.
#include "scenarios/lamps/candela_table.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

/// A place on an axis: between samples `cell` and `cell + 1`, `fraction` of the way.
struct Place {
    std::size_t cell = 0;
    double fraction = 0.0;
};

/// `value` lies on the axis.
Place place_on(const std::vector<double>& axis, double value) {
    const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, value);
    const auto cell = static_cast<std::size_t>(above - axis.begin()) - 1;
    return {cell, (value - axis[cell]) / (axis[cell + 1] - axis[cell])};
}

bool is_gap(const CandelaTable& table, std::size_t v, std::size_t h) {
    return !table.gaps.empty() && table.gaps[v * (table.h_deg.size() - 1) + h] != 0;
}

/// Gaps are open: a direction on the border of a gap belongs to the neighbouring cell that has data, if there is one.
bool leave_gap(const CandelaTable& table, Place& v, Place& h) {
    const bool lower = v.fraction == 0.0 && v.cell > 0, left = h.fraction == 0.0 && h.cell > 0;
    for (const auto& [down, aside] : {std::pair(false, true), std::pair(true, false), std::pair(true, true)}) {
        if ((down && !lower) || (aside && !left) || is_gap(table, v.cell - down, h.cell - aside))
            continue;
        v = down ? Place{v.cell - 1, 1.0} : v;
        h = aside ? Place{h.cell - 1, 1.0} : h;
        return true;
    }
    return false;
}

/// False where there is no data, and when an angle is not a number.
bool place_with_data(const CandelaTable& table, double h_deg, double v_deg, Place& v, Place& h) {
    if (std::abs(h_deg) > 180.0)
        h_deg = std::remainder(h_deg, 360.0);
    const bool inside =
        h_deg >= table.h_deg.front() && h_deg <= table.h_deg.back() && v_deg >= table.v_deg.front() && v_deg <= table.v_deg.back();
    if (!inside)
        return false;
    v = place_on(table.v_deg, v_deg);
    h = place_on(table.h_deg, h_deg);
    return !is_gap(table, v.cell, h.cell) || leave_gap(table, v, h);
}

// Weighted so that both ends are exact.
double blend(double a, double b, double fraction) { return a * (1.0 - fraction) + b * fraction; }

/// The four samples of a cell.
struct Corners {
    double a, b, c, d; ///< lower left, lower right, upper left, upper right
    bool any_zero() const { return a == 0.0 || b == 0.0 || c == 0.0 || d == 0.0; }
    Corners logarithms() const { return {std::log(a), std::log(b), std::log(c), std::log(d)}; }
};

Corners corners(const CandelaTable& table, std::size_t v, std::size_t h) {
    return {table.at(v, h), table.at(v, h + 1), table.at(v + 1, h), table.at(v + 1, h + 1)};
}

double between(const Corners& k, double fv, double fh) { return blend(blend(k.a, k.b, fh), blend(k.c, k.d, fh), fv); }

/// By the table's rule.
double intensity_at(const CandelaTable& table, const Place& v, const Place& h) {
    const Corners k = corners(table, v.cell, h.cell);
    if (table.rule == BetweenSamples::linear_cd || k.any_zero())
        return between(k, v.fraction, h.fraction);
    return std::exp(between(k.logarithms(), v.fraction, h.fraction));
}

/// Weights of the lower and the upper sample in the integral of a linear function times cos V over one row of cells, radians.
/// With m the middle and s half the step: lower + upper = 2 cos m sin s, upper - lower = 2 sin m (cos s - sin s / s).
std::array<double, 2> cosine_weights(double v0_deg, double v1_deg) {
    const double middle = radians((v0_deg + v1_deg) / 2.0);
    const double half = radians((v1_deg - v0_deg) / 2.0);
    const double total = 2.0 * std::cos(middle) * std::sin(half);
    const double tilt = 2.0 * std::sin(middle) * (std::cos(half) - std::sin(half) / half);
    return {(total - tilt) / 2.0, (total + tilt) / 2.0};
}

/// Mean of exp over a line whose logarithm runs linearly from la to lb.
double logarithmic_mean(double la, double lb) {
    const double x = lb - la;
    if (std::abs(x) > 1e-3)
        return (std::exp(lb) - std::exp(la)) / x;
    return std::exp((la + lb) / 2.0) * (1.0 + x * x / 24.0); // sinh(x/2)/(x/2), next term x^4/1920
}

/// Integral over a cell per radian of H. Along H in closed form; along V by 8-point Gauss-Legendre on panels over which the
/// intensity changes by at most exp(4), where the rule's relative error is below 1e-12.
double log_cell_integral(const Corners& logs, double v0_deg, double v1_deg) {
    static constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    static constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    const double change = std::max(std::abs(logs.c - logs.a), std::abs(logs.d - logs.b));
    const double turn = radians(v1_deg - v0_deg);
    const int panels = 1 + static_cast<int>(std::max(change / 4.0, turn));
    const auto value = [&](double t) {
        return logarithmic_mean(blend(logs.a, logs.c, t), blend(logs.b, logs.d, t)) * std::cos(radians(blend(v0_deg, v1_deg, t)));
    };
    double integral = 0.0;
    for (int panel = 0; panel < panels; ++panel) {
        const double centre = (panel + 0.5) / panels;
        for (std::size_t i = 0; i < node.size(); ++i)
            integral += weight[i] * (value(centre - node[i] / (2.0 * panels)) + value(centre + node[i] / (2.0 * panels)));
    }
    return integral * turn / (2.0 * panels);
}

void check_axis(const std::vector<double>& axis, const char* name, double limit_deg) {
    const auto fail = [&](const std::string& what) { throw std::invalid_argument(fmt::format("candela table: {} axis {}", name, what)); };
    if (axis.size() < 2)
        fail(fmt::format("has {} samples, expected at least 2", axis.size()));
    for (std::size_t i = 0; i < axis.size(); ++i) {
        if (!(std::abs(axis[i]) <= limit_deg))
            fail(fmt::format("has {} at sample {}, expected -{} to {}", axis[i], i, limit_deg, limit_deg));
        if (i > 0 && !(axis[i] > axis[i - 1]))
            fail(fmt::format("has {} after {}, expected ascending angles", axis[i], axis[i - 1]));
    }
}

/// Width of the step that stands for a jump where one table ends, or has a gap, inside the other: narrow beside any goniometer's step
/// (0.01 degrees), wide beside the rounding of 180 in double (3e-14).
constexpr double jump_deg = 1e-9;

bool borders_gap(const CandelaTable& table, bool vertical, std::size_t sample) {
    const std::size_t rows = table.v_deg.size() - 1, columns = table.h_deg.size() - 1;
    if (table.gaps.empty() || sample == 0 || sample >= (vertical ? rows : columns))
        return false;
    const auto gap = [&](std::size_t cell, std::size_t other) {
        return vertical ? is_gap(table, cell, other) : is_gap(table, other, cell);
    };
    for (std::size_t other = 0; other < (vertical ? columns : rows); ++other)
        if (gap(sample - 1, other) != gap(sample, other))
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
    const auto &first = vertical ? a.v_deg : a.h_deg, &second = vertical ? b.v_deg : b.h_deg;
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

double intensity_cd(const CandelaTable& table, double h_deg, double v_deg) {
    Place v, h;
    return place_with_data(table, h_deg, v_deg, v, h) ? intensity_at(table, v, h) : 0.0;
}

std::optional<std::array<SampleWeight, 4>> sample_weights(const CandelaTable& table, double h_deg, double v_deg) {
    Place v, h;
    if (!place_with_data(table, h_deg, v_deg, v, h))
        return std::nullopt;
    const std::size_t columns = table.h_deg.size(), lower = v.cell * columns + h.cell, upper = lower + columns;
    std::array<SampleWeight, 4> weights{{{lower, (1.0 - v.fraction) * (1.0 - h.fraction)},
                                         {lower + 1, (1.0 - v.fraction) * h.fraction},
                                         {upper, v.fraction * (1.0 - h.fraction)},
                                         {upper + 1, v.fraction * h.fraction}}};
    if (table.rule == BetweenSamples::log_cd && !corners(table, v.cell, h.cell).any_zero())
        for (SampleWeight& one : weights)
            one.weight *= intensity_at(table, v, h) / table.cd[one.sample];
    return weights;
}

IntensityAcross::IntensityAcross(const CandelaTable& table, const std::vector<double>& h_deg) : table_(table), cd_(h_deg.size()) {
    for (const double asked_deg : h_deg) {
        const double h = std::abs(asked_deg) > 180.0 ? std::remainder(asked_deg, 360.0) : asked_deg;
        const bool inside = h >= table.h_deg.front() && h <= table.h_deg.back();
        const Place place = inside ? place_on(table.h_deg, h) : Place{};
        columns_.push_back({place.cell, place.fraction, inside});
    }
}

const std::vector<double>& IntensityAcross::at(double v_deg) {
    const bool inside = v_deg >= table_.v_deg.front() && v_deg <= table_.v_deg.back();
    const Place row = inside ? place_on(table_.v_deg, v_deg) : Place{};
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        Place v = row, h{columns_[i].cell, columns_[i].fraction};
        const bool has_data = inside && columns_[i].inside && (!is_gap(table_, v.cell, h.cell) || leave_gap(table_, v, h));
        cd_[i] = has_data ? intensity_at(table_, v, h) : 0.0;
    }
    return cd_;
}

bool has_data(const CandelaTable& table, double h_deg, double v_deg) {
    Place v, h;
    return place_with_data(table, h_deg, v_deg, v, h);
}

Peak peak_of(const CandelaTable& table) {
    const auto highest = std::max_element(table.cd.begin(), table.cd.end());
    if (highest == table.cd.end())
        return {};
    const auto index = static_cast<std::size_t>(highest - table.cd.begin());
    return {*highest, table.h_deg[index % table.h_deg.size()], table.v_deg[index / table.h_deg.size()]};
}

double flux_lm(const CandelaTable& table) {
    double flux = 0.0;
    for (std::size_t v = 0; v + 1 < table.v_deg.size(); ++v) {
        const double v0 = table.v_deg[v], v1 = table.v_deg[v + 1];
        const auto [lower, upper] = cosine_weights(v0, v1);
        double row = 0.0;
        for (std::size_t h = 0; h + 1 < table.h_deg.size(); ++h) {
            if (is_gap(table, v, h))
                continue;
            const Corners k = corners(table, v, h);
            const bool linear = table.rule == BetweenSamples::linear_cd || k.any_zero();
            const double per_radian =
                linear ? lower * (k.a + k.b) / 2.0 + upper * (k.c + k.d) / 2.0 : log_cell_integral(k.logarithms(), v0, v1);
            row += per_radian * radians(table.h_deg[h + 1] - table.h_deg[h]);
        }
        flux += row;
    }
    return flux;
}

void check_invariants(const CandelaTable& table) {
    check_axis(table.h_deg, "H", 180.0);
    check_axis(table.v_deg, "V", 90.0);
    const std::size_t samples = table.h_deg.size() * table.v_deg.size();
    if (table.cd.size() != samples)
        throw std::invalid_argument(fmt::format("candela table: has {} intensities, expected {}", table.cd.size(), samples));
    for (std::size_t i = 0; i < samples; ++i)
        if (!(std::isfinite(table.cd[i]) && table.cd[i] >= 0.0))
            throw std::invalid_argument(fmt::format("candela table: has {} cd at H {}, V {} deg, expected a finite intensity of at least 0",
                                                    table.cd[i], table.h_deg[i % table.h_deg.size()], table.v_deg[i / table.h_deg.size()]));
    const std::size_t cells = (table.h_deg.size() - 1) * (table.v_deg.size() - 1);
    if (!table.gaps.empty() && table.gaps.size() != cells)
        throw std::invalid_argument(fmt::format("candela table: has {} gap marks, expected none or {}", table.gaps.size(), cells));
}

CandelaTable scaled(CandelaTable table, double factor) {
    if (!(std::isfinite(factor) && factor >= 0.0))
        throw std::invalid_argument(fmt::format("candela table: scaled by {}, expected a factor of at least 0", factor));
    for (double& cd : table.cd)
        cd *= factor;
    return table;
}

CandelaTable mirrored(const CandelaTable& table) {
    CandelaTable out = table;
    std::reverse(out.h_deg.begin(), out.h_deg.end());
    for (double& h : out.h_deg)
        h = 0.0 - h; // not -h: no negative zero in files
    const auto reverse_rows = [](auto& values, std::size_t row_length) {
        for (auto row = values.begin(); row != values.end(); row += static_cast<std::ptrdiff_t>(row_length))
            std::reverse(row, row + static_cast<std::ptrdiff_t>(row_length));
    };
    reverse_rows(out.cd, out.h_deg.size());
    reverse_rows(out.gaps, out.h_deg.size() - 1);
    return out;
}

double finest_step(const std::vector<double>& axis) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < axis.size(); ++i)
        least = std::min(least, axis[i] - axis[i - 1]);
    return least;
}

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
