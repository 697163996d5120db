#include "metrics/beam/beam_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace fernlicht {
namespace {

constexpr double deg = std::numbers::pi / 180.0;

/// Four samples round a place on an axis (the outer ones repeat at its ends) with cubic and linear weights.
struct Weights {
    std::array<std::size_t, 4> index{};
    std::array<double, 4> cubic{}, linear{};
    bool is_sample() const { return linear[1] == 1.0 || linear[2] == 1.0; }
};

/// Cubic Hermite with the slopes of parabolas through three neighbours; on a sample its weight is exactly 1.
Weights weights_at(const std::vector<double>& axis, double place) {
    const std::size_t last = axis.size() - 1;
    const auto above = std::upper_bound(axis.begin(), axis.end(), place);
    const std::size_t i = std::min(above == axis.begin() ? 0 : static_cast<std::size_t>(above - axis.begin()) - 1, last - 1);
    Weights w;
    w.index = {i == 0 ? 0 : i - 1, i, i + 1, std::min(i + 2, last)};
    const double width = axis[i + 1] - axis[i];
    const double t = std::clamp((place - axis[i]) / width, 0.0, 1.0);
    w.linear = {0.0, 1.0 - t, t, 0.0};
    w.cubic = {0.0, 1.0 - t * t * (3.0 - 2.0 * t), t * t * (3.0 - 2.0 * t), 0.0};
    const auto add_slope = [&](std::size_t middle, double factor) { // factor * slope at that one of the four samples
        const std::size_t a = w.index[middle - 1], b = w.index[middle], c = w.index[middle + 1];
        const double left = axis[b] - axis[a], right = axis[c] - axis[b];
        if (left == 0.0 || right == 0.0) { // at the axis' end: the one side there is
            w.cubic[1] -= factor / width;
            w.cubic[2] += factor / width;
            return;
        }
        w.cubic[middle - 1] -= factor * right / (left * (left + right));
        w.cubic[middle] += factor * (right - left) / (left * right);
        w.cubic[middle + 1] += factor * left / (right * (left + right));
    };
    add_slope(1, width * t * (1.0 - t) * (1.0 - t));
    add_slope(2, -width * t * t * (1.0 - t));
    return w;
}

double slope(const std::vector<double>& axis, std::size_t i, auto value) {
    const std::size_t low = i == 0 ? 0 : i - 1, high = std::min(i + 1, axis.size() - 1);
    return (value(high) - value(low)) / (axis[high] - axis[low]);
}

} // namespace

BeamField::BeamField(const CandelaTable& table, double floor_cd, const AngleSystem* system)
    : table_(&table), system_(system), floor_cd_(floor_cd), log_cd_(table.cd.size()) {
    std::ranges::transform(table.cd, log_cd_.begin(), [&](double cd) { return std::log(std::max(cd, floor_cd)); });
}

/// What went from a sample's own angles to H and V and back is that sample again.
TwoAngles BeamField::on_axes(double h_deg, double v_deg) const {
    if (!system_)
        return {h_deg, v_deg};
    const auto snapped = [](const std::vector<double>& axis, double angle) {
        const auto above = std::ranges::lower_bound(axis, angle);
        for (const auto near : {above == axis.end() ? above - 1 : above, above == axis.begin() ? above : above - 1})
            if (std::abs(*near - angle) < 1e-7)
                return *near;
        return angle;
    };
    const TwoAngles native = system_->to_native(h_deg, v_deg);
    return {snapped(table_->h_deg, native.h_deg), snapped(table_->v_deg, native.v_deg)};
}

bool BeamField::has(double h_deg, double v_deg) const {
    const TwoAngles d = on_axes(h_deg, v_deg);
    return has_data(*table_, d.h_deg, d.v_deg);
}

double BeamField::cd(double h_deg, double v_deg) const {
    const TwoAngles d = on_axes(h_deg, v_deg);
    return intensity_cd(*table_, d.h_deg, d.v_deg);
}

std::size_t BeamField::nearest(double h_deg, double v_deg) const {
    const auto on_axis = [](const std::vector<double>& axis, double angle) {
        const auto above = std::ranges::lower_bound(axis, angle);
        if (above == axis.begin() || (above != axis.end() && *above - angle <= angle - *(above - 1)))
            return static_cast<std::size_t>(above - axis.begin());
        return static_cast<std::size_t>(above - axis.begin()) - 1;
    };
    const TwoAngles d = on_axes(h_deg, v_deg);
    return on_axis(table_->v_deg, d.v_deg) * table_->h_deg.size() + on_axis(table_->h_deg, d.h_deg);
}

std::vector<std::pair<std::size_t, double>> BeamField::weights(double h_deg, double v_deg) const {
    const TwoAngles d = on_axes(h_deg, v_deg);
    const Weights h = weights_at(table_->h_deg, d.h_deg), v = weights_at(table_->v_deg, d.v_deg);
    std::vector<std::pair<std::size_t, double>> out;
    for (std::size_t y = 0; y < 4; ++y)
        for (std::size_t x = 0; x < 4; ++x)
            if (const double weight = v.cubic[y] * h.cubic[x]; std::abs(weight) > 1e-9)
                out.emplace_back(v.index[y] * table_->h_deg.size() + h.index[x], weight);
    return out;
}

FieldValue BeamField::at(double h_deg, double v_deg) const {
    const TwoAngles d = on_axes(h_deg, v_deg);
    const Weights h = weights_at(table_->h_deg, d.h_deg), v = weights_at(table_->v_deg, d.v_deg);
    double cubic = 0.0, linear = 0.0, linear_cd = 0.0;
    for (std::size_t y = 0; y < 4; ++y) {
        double row_cubic = 0.0, row_linear = 0.0, row_linear_cd = 0.0;
        for (std::size_t x = 0; x < 4; ++x) {
            const double value = node(v.index[y], h.index[x]);
            row_cubic += h.cubic[x] * value;
            row_linear += h.linear[x] * value;
            row_linear_cd += h.linear[x] * table_->at(v.index[y], h.index[x]);
        }
        cubic += v.cubic[y] * row_cubic;
        linear += v.linear[y] * row_linear;
        linear_cd += v.linear[y] * row_linear_cd;
    }
    if (h.is_sample() && v.is_sample())
        return {cubic, 0.0}; // rounding of the sums is no choice of interpolation
    return {cubic, std::max(std::abs(cubic - linear), std::abs(cubic - std::log(std::max(linear_cd, floor_cd_))))};
}

std::pair<double, double> BeamField::gradient(std::size_t v, std::size_t h) const {
    return {slope(table_->h_deg, h, [&](std::size_t i) { return node(v, i); }),
            slope(table_->v_deg, v, [&](std::size_t i) { return node(i, h); })};
}

std::pair<double, double> before_shift(double h_deg, double v_deg, const BeamShift& shift) {
    if (shift.turn == BeamTurn::angles_shifted)
        return {h_deg - shift.right_deg, v_deg - shift.up_deg};
    const double pitch = shift.up_deg * deg, h = h_deg * deg - shift.right_deg * deg, v = v_deg * deg;
    const double x = std::cos(v) * std::sin(h), y = std::sin(v), z = std::cos(v) * std::cos(h);
    const double back_y = y * std::cos(pitch) - z * std::sin(pitch), back_z = y * std::sin(pitch) + z * std::cos(pitch);
    return {std::atan2(x, back_z) / deg, std::atan2(back_y, std::hypot(x, back_z)) / deg};
}

double rounding_of(const CandelaTable& table) {
    for (double step = 1000.0; step >= 1e-6; step /= 10.0) {
        const auto is_round = [&](double cd) { return std::abs(cd / step - std::round(cd / step)) < 1e-6; };
        if (std::ranges::all_of(table.cd, is_round))
            return step;
    }
    return 0.0;
}

namespace {

constexpr double widest_deg = 20.0, highest_deg = 4.0, min_fall_per_deg = 1.5, min_share_of_peak = 0.02;

std::optional<double> steepest_fall(const BeamField& beam, std::size_t h, double min_cd) {
    const CandelaTable& table = beam.table();
    double steepest = -min_fall_per_deg;
    std::optional<double> at_deg;
    for (std::size_t v = 1; v + 1 < table.v_deg.size(); ++v) {
        if (std::abs(table.v_deg[v]) > highest_deg || table.at(v - 1, h) < min_cd)
            continue;
        if (const double fall = beam.gradient(v, h).second; fall < steepest) {
            steepest = fall;
            at_deg = table.v_deg[v];
        }
    }
    return at_deg;
}

} // namespace

CutOffLine::CutOffLine(const BeamField& beam, double peak_cd) : h_deg_(beam.table().h_deg) {
    for (std::size_t h = 0; h < h_deg_.size(); ++h) {
        v_deg_.push_back(std::abs(h_deg_[h]) <= widest_deg ? steepest_fall(beam, h, min_share_of_peak * peak_cd) : std::nullopt);
        if (v_deg_.back())
            ++columns_;
    }
}

std::optional<double> CutOffLine::at(double h_deg) const {
    const auto above = std::ranges::lower_bound(h_deg_, h_deg);
    auto i = static_cast<std::size_t>(std::min(above, h_deg_.end() - 1) - h_deg_.begin());
    if (i > 0 && h_deg - h_deg_[i - 1] < h_deg_[i] - h_deg)
        --i;
    return v_deg_[i];
}

double CutOffLine::lowest_deg() const {
    std::vector<double> known;
    for (const std::optional<double>& v : v_deg_)
        if (v)
            known.push_back(*v);
    std::ranges::sort(known);
    return known.empty() ? std::numeric_limits<double>::quiet_NaN() : known[known.size() / 10];
}

} // namespace fernlicht
