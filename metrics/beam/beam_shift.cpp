#include "metrics/beam/beam_shift.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace fernlicht {
namespace {

constexpr double furthest_deg = 2.0, coarse_deg = 0.1;
constexpr std::size_t fewest = 50;
constexpr double tukey_c = 4.685, mad_to_sigma = 1.4826;

/// Mean distance of the residuals from their median, each at most `cap`: what the coarse search makes small.
double misfit(const BeamField& against, std::span<const BeamSample> samples, const BeamShift& shift, std::size_t stride, double cap) {
    std::vector<double> values;
    for (std::size_t i = 0; i < samples.size(); i += stride)
        if (const auto r = residual(against, samples[i], shift))
            values.push_back(r->log_cd);
    if (values.size() < fewest / 2)
        return cap;
    const double centre = middle_of(values);
    double sum = 0.0;
    for (const double value : values)
        sum += std::min(std::abs(value - centre), cap);
    return sum / static_cast<double>(values.size());
}

/// The best of the shifts along one axis, then of finer ones round it.
void search_along(double BeamShift::*axis, BeamShift& best, const BeamField& against, std::span<const BeamSample> samples,
                  std::size_t stride) {
    for (const auto& [reach, step] : {std::pair(furthest_deg, coarse_deg), std::pair(coarse_deg, coarse_deg / 5.0)}) {
        const double centre = reach == furthest_deg ? 0.0 : best.*axis;
        double least = misfit(against, samples, best, stride, 1.0);
        for (int i = -static_cast<int>(std::lround(reach / step)); i <= static_cast<int>(std::lround(reach / step)); ++i) {
            BeamShift tried = best;
            tried.*axis = centre + i * step;
            if (const double now = misfit(against, samples, tried, stride, 1.0); now < least) {
                least = now;
                best = tried;
            }
        }
    }
}

BeamShift coarse_shift(const BeamField& against, std::span<const BeamSample> samples, BeamTurn turn) {
    BeamShift best{0.0, 0.0, turn};
    const std::size_t stride = std::max<std::size_t>(1, samples.size() / 1500);
    search_along(&BeamShift::up_deg, best, against, samples, stride);
    search_along(&BeamShift::right_deg, best, against, samples, stride);
    search_along(&BeamShift::up_deg, best, against, samples, stride);
    return best;
}

struct Row {
    double r = 0.0, sigma = 0.0;
    glm::dvec3 slope{0.0};   ///< of r by right_deg, up_deg, log level
    glm::dvec2 pulled{0.0};  ///< what noise alone makes of slope x r, expected, less its sign
    glm::dmat2 steeper{0.0}; ///< what it adds to slope x slope
};

using NodeWeights = std::vector<std::pair<std::size_t, double>>;

/// (b - a) / width, sample by sample.
NodeWeights slope_of(const NodeWeights& a, const NodeWeights& b, double width) {
    NodeWeights out;
    const auto add = [&](const NodeWeights& some, double factor) {
        for (const auto& [at, weight] : some) {
            const auto found = std::ranges::find(out, at, &std::pair<std::size_t, double>::first);
            if (found == out.end())
                out.emplace_back(at, factor * weight);
            else
                found->second += factor * weight;
        }
    };
    add(b, 1.0 / width);
    add(a, -1.0 / width);
    return out;
}

double product(const NodeWeights& a, const NodeWeights& b) {
    double sum = 0.0;
    for (const auto& [at, weight] : a)
        for (const auto& [other, value] : b)
            sum += at == other ? weight * value : 0.0;
    return sum;
}

/// Differences over 0.02 degrees, finer than any table's steps round a cut-off.
std::vector<Row> rows_at(const BeamField& against, std::span<const BeamSample> samples, const ShiftFit& fit) {
    constexpr double step_deg = 0.02;
    std::vector<Row> rows;
    for (const BeamSample& sample : samples) {
        const auto [h, v] = before_shift(sample.h_deg, sample.v_deg, fit.shift);
        if (!against.has(h, v))
            continue;
        Row row;
        row.r = sample.log_cd - against.at(h, v).log_cd - fit.log_level;
        row.sigma = sample.sigma;
        row.slope = {(against.at(h + step_deg / 2, v).log_cd - against.at(h - step_deg / 2, v).log_cd) / step_deg,
                     (against.at(h, v + step_deg / 2).log_cd - against.at(h, v - step_deg / 2).log_cd) / step_deg, -1.0};
        const NodeWeights here = against.weights(h, v);
        const NodeWeights along_h = slope_of(against.weights(h - step_deg / 2, v), against.weights(h + step_deg / 2, v), step_deg),
                          along_v = slope_of(against.weights(h, v - step_deg / 2), against.weights(h, v + step_deg / 2), step_deg);
        const double variance = sample.noise * sample.noise;
        row.pulled = variance * glm::dvec2(product(along_h, here), product(along_v, here));
        const double crossed = variance * product(along_h, along_v);
        row.steeper = {{variance * product(along_h, along_h), crossed}, {crossed, variance * product(along_v, along_v)}};
        rows.push_back(row);
    }
    return rows;
}

/// Scale of r / sigma, at least 1.
double scale_of(const std::vector<Row>& rows) {
    std::vector<double> sizes;
    for (const Row& row : rows)
        sizes.push_back(std::abs(row.r) / row.sigma);
    return std::max(1.0, mad_to_sigma * middle_of(sizes));
}

struct Normal {
    glm::dmat3 information{0.0}, scatter{0.0}; ///< of the light alone; of the light and its noise
    glm::dvec3 pull{0.0};
};

Normal normal_equations(const std::vector<Row>& rows, double scale) {
    Normal normal;
    for (const Row& row : rows) {
        const double u = row.r / (tukey_c * scale * row.sigma);
        if (std::abs(u) >= 1.0)
            continue;
        const double weight = (1.0 - u * u) * (1.0 - u * u) / (scale * scale * row.sigma * row.sigma);
        for (int c = 0; c < 3; ++c) {
            for (int k = 0; k < 3; ++k) {
                const double product = weight * row.slope[c] * row.slope[k];
                normal.scatter[c][k] += product;
                normal.information[c][k] += product - (c < 2 && k < 2 ? weight * row.steeper[c][k] : 0.0);
            }
            normal.pull[c] -= weight * (row.slope[c] * row.r + (c < 2 ? row.pulled[c] : 0.0));
        }
    }
    return normal;
}

/// Invertible well enough for a step: each figure is known to better than 10 degrees, or 1000 %.
bool is_solvable(const glm::dmat3& information) {
    const double determinant = glm::determinant(information);
    return std::isfinite(determinant) && determinant > 1e-6 && information[0][0] > 0.0 && information[1][1] > 0.0;
}

} // namespace

std::optional<FieldValue> residual(const BeamField& against, const BeamSample& sample, const BeamShift& shift) {
    const auto [h, v] = before_shift(sample.h_deg, sample.v_deg, shift);
    if (!against.has(h, v))
        return std::nullopt;
    const FieldValue value = against.at(h, v);
    return FieldValue{sample.log_cd - value.log_cd, value.uncertainty};
}

ShiftFit fit_shift(const BeamField& against, std::span<const BeamSample> samples, BeamTurn turn) {
    ShiftFit fit;
    fit.shift.turn = turn;
    if (samples.size() < fewest)
        return fit;
    std::vector<Row> rows = rows_at(against, samples, fit);
    if (rows.size() < fewest)
        return fit;
    if (scale_of(rows) > 2.0) // more than noise: the start may be far off
        fit.shift = coarse_shift(against, samples, turn);
    for (int iteration = 0; iteration < 25; ++iteration) {
        rows = rows_at(against, samples, fit);
        if (rows.size() < fewest)
            return fit;
        const double scale = scale_of(rows);
        const Normal normal = normal_equations(rows, scale);
        if (!is_solvable(normal.information))
            return fit;
        const glm::dmat3 inverse = glm::inverse(normal.information), covariance = inverse * normal.scatter * inverse;
        const glm::dvec3 step = inverse * normal.pull;
        fit.shift.right_deg += std::clamp(step.x, -0.2, 0.2);
        fit.shift.up_deg += std::clamp(step.y, -0.2, 0.2);
        fit.log_level += step.z;
        fit.right_error_deg = std::sqrt(covariance[0][0]);
        fit.up_error_deg = std::sqrt(covariance[1][1]);
        fit.scale = scale;
        if (std::abs(step.x) < 0.01 * fit.right_error_deg && std::abs(step.y) < 0.01 * fit.up_error_deg)
            break;
    }
    fit.found = std::abs(fit.shift.right_deg) <= furthest_deg && std::abs(fit.shift.up_deg) <= furthest_deg;
    return fit;
}

} // namespace fernlicht
