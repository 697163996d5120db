#include "metrics/beam/received_beam.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fernlicht {
namespace {

/// `low`, the axis samples inside, `high`.
std::vector<double> pieces(const std::vector<double>& axis, double low, double high) {
    std::vector<double> edges{low};
    for (auto it = std::upper_bound(axis.begin(), axis.end(), low); it != axis.end() && *it < high; ++it)
        edges.push_back(*it);
    edges.push_back(high);
    return edges;
}

double widening(double v_deg) { return 1.0 / std::max(0.1, std::cos(radians(v_deg))); }

/// Weighted sums over the parts that have data.
struct LightSums {
    double light = 0.0, weight = 0.0;
    void add(const CandelaTable& table, double h, double v, double w) {
        if (w <= 0.0 || !has_data(table, h, v))
            return;
        light += w * intensity_cd(table, h, v);
        weight += w;
    }
};

/// The same, sample by sample.
struct SampleSums {
    std::vector<SampleWeight> samples = {};
    double weight = 0.0;
    void add(const CandelaTable& table, double h, double v, double w) {
        const auto weights = w > 0.0 ? sample_weights(table, h, v) : std::nullopt;
        if (!weights)
            return;
        for (const SampleWeight& one : *weights)
            samples.push_back({one.sample, w * one.weight});
        weight += w;
    }
};

/// Over [h0, h1] x [v0, v1], one cell's piece or less.
template <class Sums> void add_piece(Sums& sums, const CandelaTable& table, double h0, double h1, double v0, double v1) {
    const double area = (h1 - h0) * (v1 - v0), h = (h0 + h1) / 2.0, v = (v0 + v1) / 2.0;
    if (table.rule == BetweenSamples::linear_cd) {
        sums.add(table, h, v, area);
        return;
    }
    const double dh = (h1 - h0) / (2.0 * std::sqrt(3.0)), dv = (v1 - v0) / (2.0 * std::sqrt(3.0));
    for (const double x : {-dh, dh})
        for (const double y : {-dv, dv})
            sums.add(table, h + x, v + y, area / 4.0);
}

template <class Sums> Sums over_square(const CandelaTable& table, double half, Direction to) {
    const double half_h = half * widening(to.v_deg);
    const std::vector<double> h = pieces(table.h_deg, to.h_deg - half_h, to.h_deg + half_h);
    const std::vector<double> v = pieces(table.v_deg, to.v_deg - half, to.v_deg + half);
    Sums sums;
    for (std::size_t j = 0; j + 1 < v.size(); ++j)
        for (std::size_t i = 0; i + 1 < h.size(); ++i)
            add_piece(sums, table, h[i], h[i + 1], v[j], v[j + 1]);
    return sums;
}

/// v = middle + radius sin t, a chord's half length radius cos t: the area element is 2 radius^2 cos^2 t dt.
template <class Sums> Sums over_disc(const CandelaTable& table, double radius, Direction to) {
    static constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    static constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    const double wide = widening(to.v_deg);
    const std::vector<double> v = pieces(table.v_deg, to.v_deg - radius, to.v_deg + radius);
    Sums sums;
    const auto add_chord = [&](double t, double w) {
        const double chord_v = to.v_deg + radius * std::sin(t), half = radius * std::cos(t) * wide;
        const std::vector<double> h = pieces(table.h_deg, to.h_deg - half, to.h_deg + half);
        for (std::size_t i = 0; i + 1 < h.size(); ++i) {
            const double share = w * std::cos(t) * std::cos(t) * (h[i + 1] - h[i]) / (2.0 * half), middle = (h[i] + h[i + 1]) / 2.0;
            if (table.rule == BetweenSamples::linear_cd) {
                sums.add(table, middle, chord_v, share);
                continue;
            }
            const double dh = (h[i + 1] - h[i]) / (2.0 * std::sqrt(3.0));
            sums.add(table, middle - dh, chord_v, share / 2.0);
            sums.add(table, middle + dh, chord_v, share / 2.0);
        }
    };
    for (std::size_t j = 0; j + 1 < v.size(); ++j) {
        const double t0 = std::asin(std::clamp((v[j] - to.v_deg) / radius, -1.0, 1.0));
        const double t1 = std::asin(std::clamp((v[j + 1] - to.v_deg) / radius, -1.0, 1.0));
        for (std::size_t i = 0; i < node.size(); ++i)
            for (const double side : {-1.0, 1.0})
                add_chord((t0 + t1) / 2.0 + side * node[i] * (t1 - t0) / 2.0, weight[i] * (t1 - t0) / 2.0);
    }
    return sums;
}

template <class Sums> Sums over_receiver(const CandelaTable& table, const Receiver& receiver, Direction to) {
    const double half = receiver.size_deg / 2.0;
    return receiver.shape == Receiver::Shape::square ? over_square<Sums>(table, half, to) : over_disc<Sums>(table, half, to);
}

/// The samples from the last one at or below `low` to the first one at or above `high`.
std::pair<std::size_t, std::size_t> around(const std::vector<double>& axis, double low, double high) {
    auto first = std::upper_bound(axis.begin(), axis.end(), low);
    if (first != axis.begin())
        --first;
    auto last = std::lower_bound(axis.begin(), axis.end(), high);
    if (last == axis.end())
        --last;
    return {static_cast<std::size_t>(first - axis.begin()), static_cast<std::size_t>(std::max(first, last) - axis.begin())};
}

} // namespace

std::optional<double> received_cd(const CandelaTable& table, const Receiver& receiver, Direction to) {
    if (!has_data(table, to.h_deg, to.v_deg))
        return std::nullopt;
    if (receiver.size_deg <= 0.0)
        return intensity_cd(table, to.h_deg, to.v_deg);
    const auto sums = over_receiver<LightSums>(table, receiver, to);
    return sums.weight > 0.0 ? sums.light / sums.weight : intensity_cd(table, to.h_deg, to.v_deg);
}

std::vector<SampleWeight> received_weights(const CandelaTable& table, const Receiver& receiver, Direction to) {
    if (!has_data(table, to.h_deg, to.v_deg))
        return {};
    SampleSums sums;
    if (receiver.size_deg > 0.0)
        sums = over_receiver<SampleSums>(table, receiver, to);
    if (sums.weight <= 0.0)
        sums.add(table, to.h_deg, to.v_deg, 1.0);
    for (SampleWeight& one : sums.samples)
        one.weight /= sums.weight;
    return sums.samples;
}

ReceivedBeam::ReceivedBeam(std::vector<AimedLamp> lamps, Receiver receiver)
    : lamps_(std::move(lamps)), receiver_(receiver), step_deg_(receiver.size_deg / 3.0) {
    if (receiver.size_deg > 0.0)
        return;
    step_deg_ = 1.0;
    for (const AimedLamp& lamp : lamps_)
        step_deg_ = std::min({step_deg_, finest_step(lamp.table->h_deg) / 2.0, finest_step(lamp.table->v_deg) / 2.0});
    step_deg_ = std::max(step_deg_, 0.01); // finer than any goniometer
}

std::optional<double> ReceivedBeam::at(Direction to) const {
    double cd = 0.0;
    for (const auto& [table, turned] : lamps_) {
        const std::optional<double> one = received_cd(*table, receiver_, {to.h_deg - turned.h_deg, to.v_deg - turned.v_deg});
        if (!one)
            return std::nullopt;
        cd += *one;
    }
    return cd / static_cast<double>(lamps_.size());
}

ReceivedBeam::Bounds ReceivedBeam::bounds(Direction from, Direction to) const {
    const double half = receiver_.size_deg / 2.0, share = 1.0 / static_cast<double>(lamps_.size());
    Bounds all;
    for (const auto& [table, turned] : lamps_) {
        const double bottom = std::min(from.v_deg, to.v_deg) - turned.v_deg, top = std::max(from.v_deg, to.v_deg) - turned.v_deg;
        const double half_h = half * std::max(widening(bottom), widening(top));
        const double left = std::min(from.h_deg, to.h_deg) - turned.h_deg - half_h;
        const double right = std::max(from.h_deg, to.h_deg) - turned.h_deg + half_h;
        // Beyond the ends of a table that wraps round, the other end comes in: all of its columns, to be safe.
        const bool across = left < -180.0 || right > 180.0;
        const std::size_t columns = table->h_deg.size();
        const auto [h0, h1] = across ? std::pair{std::size_t{0}, columns - 1} : around(table->h_deg, left, right);
        const auto [v0, v1] = around(table->v_deg, bottom - half, top + half);
        double low = std::numeric_limits<double>::infinity(), high = 0.0;
        for (std::size_t v = v0; v <= v1; ++v) {
            const double* row = table->cd.data() + v * columns;
            const auto [least, most] = std::minmax_element(row + h0, row + h1 + 1);
            low = std::min(low, *least);
            high = std::max(high, *most);
        }
        all.low_cd += low * share;
        all.high_cd += high * share;
    }
    return all;
}

ReceivedBeam::Window ReceivedBeam::window() const {
    Window w{180.0, -180.0, 90.0, -90.0};
    for (const auto& [table, turned] : lamps_) {
        w.left_deg = std::min(w.left_deg, table->h_deg.front() + turned.h_deg);
        w.right_deg = std::max(w.right_deg, table->h_deg.back() + turned.h_deg);
        w.bottom_deg = std::min(w.bottom_deg, table->v_deg.front() + turned.v_deg);
        w.top_deg = std::max(w.top_deg, table->v_deg.back() + turned.v_deg);
    }
    return w;
}

} // namespace fernlicht
