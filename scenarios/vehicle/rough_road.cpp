#include "scenarios/vehicle/rough_road.h"

#include "scenarios/values/mixed_bits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace fernlicht {
namespace {

constexpr std::size_t wave_count = 96; ///< twelve an octave

/// In [0, 1).
struct WaveChance {
    std::uint64_t state;

    double next() { return static_cast<double>(next_mixed(state) >> 11) * 0x1.0p-53; }
};

/// From 0 to 1 over u in [0, 1] with two continuous derivatives, which are given too.
struct Growth {
    double part = 1.0, rate = 0.0, bend = 0.0;

    explicit Growth(double u) {
        if (u >= 1.0)
            return;
        part = u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
        rate = 30.0 * u * u * (1.0 - u) * (1.0 - u);
        bend = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u);
    }
};

} // namespace

double roughness_m3(RoadClass road_class) { return 16.0e-6 * std::pow(4.0, static_cast<int>(road_class)); }

double track_coherence(double per_m, double track_m) {
    const double k = 2.0 * std::numbers::pi * per_m * track_m;
    if (k < 1.0e-6)
        return 1.0;
    // K1(k) = integral of exp(-k cosh t) cosh t over t > 0; the trapezoidal rule meets it to roundings.
    constexpr double step = 0.05;
    double sum = 0.5 * std::exp(-k), term = sum;
    for (int i = 1; term > 1.0e-18 * sum || i < 10; ++i) {
        const double c = std::cosh(i * step);
        sum += term = std::exp(-k * c) * c;
    }
    return k * step * sum;
}

RoughRoad::RoughRoad(const Roughness& roughness, double track_m, double from_m) : from_m_(from_m) {
    WaveChance chance{static_cast<std::uint64_t>(roughness.seed)};
    const double ratio = greatest_roughness_per_m / least_roughness_per_m;
    const auto edge_per_m = [&](std::size_t i) {
        return least_roughness_per_m * std::pow(ratio, static_cast<double>(i) / static_cast<double>(wave_count));
    };
    for (std::size_t i = 0; i < wave_count; ++i) {
        const double low = edge_per_m(i), high = edge_per_m(i + 1);
        const double per_m = low * std::pow(high / low, chance.next());
        const double phase_rad = 2.0 * std::numbers::pi * chance.next(), tilt_phase_rad = 2.0 * std::numbers::pi * chance.next();
        // Half the square of the amplitude is the spectrum's integral over the part.
        const double square_m2 =
            2.0 * roughness_m3(roughness.road_class) * roughness_reference_per_m * roughness_reference_per_m * (1.0 / low - 1.0 / high);
        // Of the mean of two tracks with coherence g: G (1 + g) / 2; of their difference: 2 G (1 - g). Each alone has G.
        const double coherence = track_m > 0.0 ? track_coherence(per_m, track_m) : 1.0;
        const double height_m = std::sqrt(square_m2 * 0.5 * (1.0 + coherence));
        const double tilt_rad = track_m > 0.0 ? std::sqrt(square_m2 * 2.0 * std::max(1.0 - coherence, 0.0)) / track_m : 0.0;
        waves_.push_back({2.0 * std::numbers::pi * per_m, height_m * std::cos(phase_rad), height_m * std::sin(phase_rad),
                          tilt_rad * std::cos(tilt_phase_rad), tilt_rad * std::sin(tilt_phase_rad)});
    }
}

RoughPlace RoughRoad::at(double distance_m) const {
    RoughPlace place;
    if (!(distance_m > from_m_))
        return place;
    for (const Wave& wave : waves_) {
        const double w = wave.rad_per_m, s = std::sin(w * distance_m), c = std::cos(w * distance_m);
        const double height = wave.height_sine_m * s + wave.height_cosine_m * c, tilt = wave.tilt_sine_rad * s + wave.tilt_cosine_rad * c;
        place.height_m += height;
        place.slope += w * (wave.height_sine_m * c - wave.height_cosine_m * s);
        place.bend_per_m -= w * w * height;
        place.tilt_rad += tilt;
        place.tilt_slope_rad_per_m += w * (wave.tilt_sine_rad * c - wave.tilt_cosine_rad * s);
        place.tilt_bend_rad_per_m2 -= w * w * tilt;
    }
    const Growth grown((distance_m - from_m_) / roughness_begins_m);
    const double rate = grown.rate / roughness_begins_m, bend = grown.bend / (roughness_begins_m * roughness_begins_m);
    place.bend_per_m = bend * place.height_m + 2.0 * rate * place.slope + grown.part * place.bend_per_m;
    place.slope = rate * place.height_m + grown.part * place.slope;
    place.height_m *= grown.part;
    place.tilt_bend_rad_per_m2 = bend * place.tilt_rad + 2.0 * rate * place.tilt_slope_rad_per_m + grown.part * place.tilt_bend_rad_per_m2;
    place.tilt_slope_rad_per_m = rate * place.tilt_rad + grown.part * place.tilt_slope_rad_per_m;
    place.tilt_rad *= grown.part;
    return place;
}

} // namespace fernlicht
