// The rough road against ISO 8608, and its waves against their own differences.
#include "scenarios/vehicle/rough_road.h"

#include <cmath>
#include <complex>
#include <gmock/gmock.h>
#include <numbers>

namespace fernlicht {
namespace {

constexpr double begins_m = 2.7, track_m = 1.5;
constexpr double sample_m = 0.15; ///< two samples in a wave of 3.3 cycles/m
constexpr std::size_t samples_of_road = 16'384;

/// One-sided spectrum at k / length by a Hann window, whose mean square is 3/8.
struct RoadSpectrum {
    std::vector<std::complex<double>> left, right;

    explicit RoadSpectrum(const RoughRoad& road) {
        std::vector<RoughPlace> places(samples_of_road);
        for (std::size_t i = 0; i < samples_of_road; ++i)
            places[i] = road.at(begins_m + roughness_begins_m + sample_m * static_cast<double>(i));
        const double turn = 2.0 * std::numbers::pi / static_cast<double>(samples_of_road);
        std::vector<double> window(samples_of_road);
        for (std::size_t i = 0; i < samples_of_road; ++i)
            window[i] = 0.5 - 0.5 * std::cos(turn * static_cast<double>(i));
        for (std::size_t k = 0; bin_per_m(k) < greatest_roughness_per_m; ++k) {
            std::complex<double> sum_left, sum_right, at = 1.0;
            const std::complex<double> step = std::polar(1.0, -turn * static_cast<double>(k));
            for (std::size_t i = 0; i < samples_of_road; ++i, at *= step) {
                const double half_m = 0.5 * track_m * places[i].tilt_rad;
                sum_left += window[i] * (places[i].height_m + half_m) * at;
                sum_right += window[i] * (places[i].height_m - half_m) * at;
            }
            left.push_back(sum_left);
            right.push_back(sum_right);
        }
    }
    static double bin_per_m(std::size_t k) { return static_cast<double>(k) / (sample_m * static_cast<double>(samples_of_road)); }
    static double power(const std::vector<std::complex<double>>& of, std::size_t k) {
        return 2.0 * std::norm(of[k]) * sample_m / (0.375 * static_cast<double>(samples_of_road));
    }
};

TEST(RoughRoad, EachTrackHasTheSpectrumOfItsClassOctaveByOctave) {
    for (const RoadClass road_class : {RoadClass::A, RoadClass::C, RoadClass::E})
        for (const double track : {0.0, track_m}) {
            const RoadSpectrum found(RoughRoad({road_class, 7}, track, begins_m));
            for (const auto* side : {&found.left, &found.right})
                for (double low = 0.022; low < 2.0; low *= 2.0) { // whole octaves within the standard's range
                    double power_m2 = 0.0, by_class_m2 = 0.0;
                    for (std::size_t k = 1; k < side->size(); ++k) {
                        const double n = RoadSpectrum::bin_per_m(k);
                        if (n < low || n >= 2.0 * low)
                            continue;
                        power_m2 += RoadSpectrum::power(*side, k);
                        by_class_m2 += roughness_m3(road_class) * 0.01 / (n * n);
                    }
                    // The class reaches from 1/2 to 2; the octave has twelve waves, some of which leak over its ends, and tracks that
                    // are added up of two sets of waves beat.
                    EXPECT_GT(power_m2, 0.55 * by_class_m2) << low;
                    EXPECT_LT(power_m2, 1.6 * by_class_m2) << low;
                }
        }
}

TEST(RoughRoad, ItsMeanSquareIsTheSpectrumsIntegral) {
    // To the waves' own amplitudes: exactly. Class C: 256e-6 m3 (0.1 cycles/m)^2 (1/0.011 - 1/2.83) m = (15.2 mm)^2.
    for (const auto& [road_class, expected_m] : {std::pair{RoadClass::A, 0.00381}, {RoadClass::C, 0.01523}, {RoadClass::H, 0.4872}}) {
        double mean_square = 0.0;
        const RoughRoad road({road_class, 3}, 0.0, 0.0);
        for (const RoughRoad::Wave& wave : road.waves())
            mean_square += 0.5 * (wave.height_sine_m * wave.height_sine_m + wave.height_cosine_m * wave.height_cosine_m);
        EXPECT_NEAR(std::sqrt(mean_square) / expected_m, 1.0, 2e-3);
    }
}

TEST(RoughRoad, TracksAreOneInLongWavesAndStrangersInShortOnes) {
    EXPECT_NEAR(track_coherence(1.0 / (2.0 * std::numbers::pi), 1.0), 0.60190723019723, 1e-13) << "K1(1), Abramowitz & Stegun, table 9.8";
    EXPECT_NEAR(track_coherence(2.0 / (2.0 * std::numbers::pi), 1.0), 2.0 * 0.13986588181652, 1e-13) << "2 K1(2)";
    EXPECT_NEAR(track_coherence(0.1 / (2.0 * std::numbers::pi), 1.0), 0.1 * 9.85384478087061, 1e-12) << "K1(0.1) / 10";
    EXPECT_EQ(track_coherence(0.0, 1.5), 1.0);
    // Waves of 90 m: 98 %; of 1 m: 0.03 %.
    EXPECT_NEAR(track_coherence(0.011, track_m), 0.9845, 5e-4);
    EXPECT_LT(track_coherence(1.0, track_m), 1e-3);
}

TEST(RoughRoad, SlopesAreTheHeightsDifferences) {
    const RoughRoad road({RoadClass::D, 11}, track_m, begins_m);
    const double h = 1e-5;
    for (double s = begins_m - 1.0; s < 60.0; s += 0.0937) {
        const RoughPlace before = road.at(s - h), at = road.at(s), behind = road.at(s + h);
        EXPECT_NEAR((behind.height_m - before.height_m) / (2.0 * h), at.slope, 2e-7) << s;
        EXPECT_NEAR((behind.slope - before.slope) / (2.0 * h), at.bend_per_m, 2e-6) << s;
        EXPECT_NEAR((behind.tilt_rad - before.tilt_rad) / (2.0 * h), at.tilt_slope_rad_per_m, 2e-7) << s;
        EXPECT_NEAR((behind.tilt_slope_rad_per_m - before.tilt_slope_rad_per_m) / (2.0 * h), at.tilt_bend_rad_per_m2, 2e-6) << s;
    }
    EXPECT_EQ(road.at(begins_m).height_m, 0.0);
    EXPECT_EQ(road.at(begins_m).bend_per_m, 0.0);
}

TEST(RoughRoad, ASeedIsARoad) {
    const RoughRoad a({RoadClass::C, 5}, track_m, 0.0), again({RoadClass::C, 5}, track_m, 0.0), other({RoadClass::C, 6}, track_m, 0.0);
    for (double s = 0.0; s < 500.0; s += 7.3) {
        EXPECT_EQ(a.at(s).height_m, again.at(s).height_m);
        EXPECT_EQ(a.at(s).tilt_rad, again.at(s).tilt_rad);
    }
    EXPECT_GT(std::abs(a.at(100.0).height_m - other.at(100.0).height_m), 1e-4);
    EXPECT_EQ(RoughRoad({RoadClass::C, 5}, 0.0, 0.0).at(77.0).tilt_rad, 0.0) << "one track for both wheels";
}

} // namespace
} // namespace fernlicht
