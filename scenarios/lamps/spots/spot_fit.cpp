#include "scenarios/lamps/spots/spot_fit.h"

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

constexpr std::size_t most_directions = 5000; // closest where the light changes: about 0.1 degrees at a low beam's cut-off
constexpr std::size_t most_axes = 1500;
constexpr int rounds = 3, steps_a_round = 8;

/// What one more spot could gain: (sum w r s)^2 / sum w s^2 for its best intensity.
struct Candidate {
    Spot spot;
    double gain = 0.0;
};

constexpr std::array<double, 12> cutoffs_deg{1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 17.0, 25.0, 36.0, 55.0, 90.0};
constexpr std::size_t exponents = 5; // 0, 2, 8, 32, 128: from 2 on each the square of the square of the one before

/// All exponents and cut-offs on one axis, in one pass over the directions.
Candidate best_on_axis(const SpotDirections& d, const std::vector<double>& residual, const glm::dvec3& axis) {
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
    Candidate best;
    for (std::size_t e = 0; e < exponents; ++e) {
        double product = 0.0, square = 0.0;
        for (std::size_t ring = 0; ring < cosines.size(); ++ring) {
            product += products[ring][e];
            square += squares[ring][e];
            if (product > 0.0 && square > 0.0 && product * product / square > best.gain)
                best = {{degrees(std::atan2(axis.x, axis.z)), degrees(std::asin(std::clamp(axis.y, -1.0, 1.0))), product / square,
                         e == 0 ? 0.0 : std::pow(2.0, 2.0 * static_cast<double>(e) - 1.0), cutoffs_deg[ring]},
                        product * product / square};
        }
    }
    return best;
}

Candidate best_addition(const SpotDirections& d, const std::vector<Spot>& spots) {
    const std::vector<double> residual = residual_of(d, spots);
    Candidate best;
    for (std::size_t i = 0; i < d.size(); ++i)
        if (const Candidate here = best_on_axis(d, residual, {d.x[i], d.y[i], d.z[i]}); here.gain > best.gain)
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
    if (count < 1 || count > most_spots)
        throw std::invalid_argument(fmt::format("spot fit: {} spots, expected 1 to {}", count, most_spots));
    constexpr double worth_a_spot = 1e-9; // of the table's sum of squares: less is rounding
    SpotFit fit;
    fit.table_flux_lm = flux_lm(table);
    const double peak = peak_of(table).cd;
    if (peak <= 0.0)
        return fit;
    CandelaTable unit = table; // whose squares are in range
    for (double& cd : unit.cd)
        cd /= peak;
    const SpotDirections directions = spot_directions(unit, most_directions), coarse = spot_directions(unit, most_axes);
    if (directions.total_cd2_sr <= 0.0)
        return fit; // all its light goes backwards
    for (int k = 0; k < count; ++k) {
        const Candidate next = best_addition(coarse, fit.spots);
        if (next.gain <= worth_a_spot * directions.total_cd2_sr)
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

} // namespace fernlicht
