#include "scenarios/lamps/spots/spot_fit.h"

#include "scenarios/lamps/goniometer.h"
#include "scenarios/lamps/spots/spot_refinement.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr std::size_t max_directions = 5000; // closest where the light changes: about 0.1 degrees at a low beam's cut-off
constexpr std::size_t max_axes = 1500;
constexpr int rounds = 3, steps_a_round = 8;

constexpr std::array<double, 12> cutoffs_deg{1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 17.0, 25.0, 36.0, 55.0, 90.0};
constexpr std::size_t exponents = 5; // 0, 2, 8, 32, 128: from 2 on each the square of the square of the one before

/// All exponents and cut-offs on one axis, in one pass over the directions.
Gain best_on_axis(const SpotDirections& d, const std::vector<double>& residual, const glm::dvec3& axis) {
    std::array<double, cutoffs_deg.size()> cosines{};
    std::ranges::transform(cutoffs_deg, cosines.begin(), [](double angle) { return std::max(std::cos(radians(angle)), 0.0); });
    std::array<std::array<double, exponents>, cutoffs_deg.size()> products{}, squares{};
    for (std::size_t i = 0; i < d.size(); ++i) {
        const double cosine = axis.x * d.x[i] + axis.y * d.y[i] + axis.z * d.z[i];
        if (cosine <= 0.0)
            continue;
        std::size_t ring = 0; // the narrowest cut-off that holds it
        while (ring + 1 < cosines.size() && cosine < cosines[ring])
            ++ring;
        double shape = 1.0, next = cosine * cosine;
        for (std::size_t e = 0; e < exponents; ++e) {
            products[ring][e] += d.weight_sr[i] * residual[i] * shape;
            squares[ring][e] += d.weight_sr[i] * shape * shape;
            shape = next;
            next = (next * next) * (next * next);
        }
    }
    Gain best;
    for (std::size_t e = 0; e < exponents; ++e) {
        double product = 0.0, square = 0.0;
        for (std::size_t ring = 0; ring < cosines.size(); ++ring) {
            product += products[ring][e];
            square += squares[ring][e];
            if (product > 0.0 && square > 0.0 && product * product / square > best.cd2_sr)
                best = {{degrees(std::atan2(axis.x, axis.z)), degrees(std::asin(std::clamp(axis.y, -1.0, 1.0))), product / square,
                         e == 0 ? 0.0 : std::pow(2.0, 2.0 * static_cast<double>(e) - 1.0), cutoffs_deg[ring]},
                        product * product / square};
        }
    }
    return best;
}

Gain best_addition(const SpotDirections& d, const std::vector<Spot>& spots) {
    const std::vector<double> residual = residual_of(d, spots);
    Gain best;
    for (std::size_t i = 0; i < d.size(); ++i)
        if (const Gain here = best_on_axis(d, residual, {d.x[i], d.y[i], d.z[i]}); here.cd2_sr > best.cd2_sr)
            best = here;
    return best;
}

void refine(const SpotDirections& d, std::vector<Spot>& spots) {
    for (int round = 0; round < rounds; ++round) {
        refine_together(d, spots, steps_a_round);
        for (std::size_t k = 0; k < spots.size(); ++k)
            refine_alone(d, spots, k, 0.5, 0.1);
    }
    refine_together(d, spots, steps_a_round);
}

/// Of a table whose peak is 1.
void measure(SpotFit& fit, const CandelaTable& unit, const SpotDirections& d) {
    const double left_over = left_over_cd2_sr(d, residual_of(d, fit.spots)) + d.within_cd2_sr;
    fit.relative_l2 = std::sqrt(left_over / d.total_cd2_sr);
    fit.rms_of_peak = std::sqrt(left_over / d.lit_sr);
    for (const double v : unit.v_deg)
        for (const double h : unit.h_deg) {
            if (std::abs(h) > 90.0)
                continue;
            double difference = intensity_cd(unit, h, v);
            for (const Spot& spot : fit.spots)
                difference -= intensity_cd(spot, h, v);
            if (std::abs(difference) > fit.worst_of_peak) {
                fit.worst_of_peak = std::abs(difference);
                fit.worst_h_deg = h;
                fit.worst_v_deg = v;
            }
        }
}

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

double intensity_cd(const Spot& spot, double h_deg, double v_deg) {
    const double cosine = glm::dot(direction_of(spot.h_deg, spot.v_deg), direction_of(h_deg, v_deg));
    return cosine <= 0.0 || cosine < std::cos(radians(spot.cutoff_deg)) ? 0.0 : spot.cd * std::pow(cosine, spot.exponent);
}

double flux_lm(const Spot& spot) {
    const double power = spot.exponent + 1.0;
    return 2.0 * pi * spot.cd * (1.0 - std::pow(std::max(std::cos(radians(spot.cutoff_deg)), 0.0), power)) / power;
}

SpotFit fit_spots(const CandelaTable& table, int count) {
    if (count < 1 || count > max_spots)
        throw std::invalid_argument(fmt::format("spot fit: {} spots, expected 1 to {}", count, max_spots));
    constexpr double worth_a_spot = 1e-9; // of the table's sum of squares: less is rounding
    SpotFit fit;
    fit.table_flux_lm = flux_lm(table);
    const double peak = peak_of(table).cd;
    if (peak <= 0.0)
        return fit;
    CandelaTable unit = table; // whose squares are in range
    for (double& cd : unit.cd)
        cd /= peak;
    const SpotDirections directions = spot_directions(unit, max_directions), coarse = spot_directions(unit, max_axes);
    if (directions.total_cd2_sr <= 0.0)
        return fit; // all its light goes backwards
    for (int k = 0; k < count; ++k) {
        const Gain next = best_addition(coarse, fit.spots);
        if (next.cd2_sr <= worth_a_spot * directions.total_cd2_sr)
            break;
        fit.spots.push_back(next.spot);
        refine_alone(directions, fit.spots, fit.spots.size() - 1, 2.0, 0.1);
        refine(directions, fit.spots);
    }
    std::erase_if(fit.spots, [](const Spot& spot) { return spot.cd <= 0.0; });
    measure(fit, unit, directions);
    for (Spot& spot : fit.spots) {
        spot.cd *= peak;
        fit.flux_lm += flux_lm(spot);
    }
    return fit;
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
