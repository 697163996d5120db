#include "scenarios/lamps/spots/spot_fit.h"

#include "scenarios/lamps/lamp_model.h"
#include "scenarios/values/pose.h"
#include "tests/lamps.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <tuple>

namespace fernlicht {
namespace {

/// The spots' own light over the front half, every 3 degrees.
CandelaTable table_of(const std::vector<Spot>& spots, double step_deg = 3.0) {
    return tests::table_of(tests::steps(-90.0, 90.0, step_deg), tests::steps(-90.0, 90.0, step_deg), [&](double h, double v) {
        double cd = 0.0;
        for (const Spot& spot : spots)
            cd += intensity_cd(spot, h, v);
        return cd;
    });
}

/// A low beam in small: 45 x 29 samples with a cut-off.
CandelaTable small_beam() {
    return tests::table_of(tests::steps(-44.0, 44.0, 2.0), tests::steps(-10.0, 4.0, 0.5), [](double h, double v) {
        return 100.0 + 20000.0 * std::exp(-h * h / 200.0 + std::min(v, 0.0) / 3.0) / (1.0 + std::exp((v + 0.6) / 0.3));
    });
}

void expect_legal(const SpotFit& fit) {
    for (const Spot& spot : fit.spots) {
        EXPECT_TRUE(std::isfinite(spot.cd) && spot.cd > 0.0) << spot.cd;
        EXPECT_TRUE(std::abs(spot.h_deg) <= 90.0 && std::abs(spot.v_deg) <= 90.0) << spot.h_deg << ' ' << spot.v_deg;
        EXPECT_TRUE(spot.exponent >= 0.0 && spot.exponent <= 128.0) << spot.exponent;
        EXPECT_TRUE(spot.cutoff_deg >= 0.0 && spot.cutoff_deg <= 90.0) << spot.cutoff_deg;
    }
    for (const double residual : {fit.relative_l2, fit.rms_of_peak, fit.worst_of_peak})
        EXPECT_TRUE(std::isfinite(residual) && residual >= 0.0) << residual;
    EXPECT_LE(fit.relative_l2, 1.0);
}

void expect_near(const Spot& found, const Spot& given) {
    EXPECT_NEAR(found.h_deg, given.h_deg, 0.01);
    EXPECT_NEAR(found.v_deg, given.v_deg, 0.01);
    EXPECT_NEAR(found.cd, given.cd, 1e-3 * given.cd);
    EXPECT_NEAR(found.exponent, given.exponent, 0.01);
}

TEST(Spot, IsACosineToAPowerWithTheFluxOfKnownSources) {
    const Spot spot{10.0, 0.0, 1000.0, 2.0, 60.0};
    EXPECT_DOUBLE_EQ(intensity_cd(spot, 10.0, 0.0), 1000.0);
    EXPECT_NEAR(intensity_cd(spot, 55.0, 0.0), 500.0, 1e-9); // cos(45)^2
    EXPECT_NEAR(intensity_cd(spot, 10.0, -59.9), 1000.0 * std::pow(std::cos(radians(59.9)), 2), 1e-9);
    EXPECT_EQ(intensity_cd(spot, 10.0, -60.1), 0.0);
    EXPECT_EQ(intensity_cd({0, 0, 1000.0, 0.0, 90.0}, 180.0, 0.0), 0.0);
    EXPECT_NEAR(flux_lm(Spot{0, 0, 10.0, 0.0, 90.0}), 20.0 * pi, 1e-12); // half a sphere
    EXPECT_NEAR(flux_lm(Spot{0, 0, 10.0, 1.0, 90.0}), 10.0 * pi, 1e-12); // Lambert
    EXPECT_NEAR(flux_lm(Spot{0, 0, 10.0, 0.0, 60.0}), 10.0 * pi, 1e-12); // a cone of pi sr
}

TEST(SpotDirections, CoverTheFrontHalf) {
    for (const CandelaTable& table : {small_beam(), table_of({{0, 0, 1, 1, 90}}, 1.0), lamp_of_model(lamp_models()[0]).table}) {
        const SpotDirections d = spot_directions(table, 3000);
        EXPECT_LE(d.size(), 3000u);
        EXPECT_GT(d.size(), 700u);
        EXPECT_NEAR(std::accumulate(d.weight_sr.begin(), d.weight_sr.end(), 0.0), 2.0 * pi, 1e-9);
        double flux = 0.0;
        for (std::size_t i = 0; i < d.size(); ++i) {
            ASSERT_NEAR(d.x[i] * d.x[i] + d.y[i] * d.y[i] + d.z[i] * d.z[i], 1.0, 1e-12);
            flux += d.cd[i] * d.weight_sr[i];
        }
        EXPECT_NEAR(flux, flux_lm(table), 0.01 * flux_lm(table)); // trapezoids against the table's own integral
    }
}

TEST(SpotFit, FindsSpotsAgain) {
    for (const Spot& given :
         {Spot{5.0, -3.0, 12000.0, 20.0, 90.0}, Spot{-31.0, 14.5, 300.0, 1.5, 90.0}, Spot{0.0, 0.0, 5000.0, 110.0, 90.0}}) {
        const SpotFit fit = fit_spots(table_of({given}), 1);
        ASSERT_EQ(fit.spots.size(), 1u);
        expect_near(fit.spots[0], given);
        EXPECT_LT(fit.relative_l2, 1e-4);
        EXPECT_LT(fit.worst_of_peak, 1e-4);
        EXPECT_NEAR(fit.flux_lm, flux_lm(given), 1e-3 * fit.flux_lm);
        expect_legal(fit);
    }
    const Spot given{10.0, -5.0, 4000.0, 6.0, 22.0};
    const SpotFit fit = fit_spots(table_of({given}), 1);
    ASSERT_EQ(fit.spots.size(), 1u);
    EXPECT_LT(fit.relative_l2, 1e-3);
    EXPECT_NEAR(fit.spots[0].cutoff_deg, 22.0, 1.5); // samples are 3 degrees apart
    EXPECT_NEAR(fit.spots[0].exponent, 6.0, 0.1);
    const Spot wide{-20.0, -5.0, 1000.0, 4.0, 90.0}, narrow{25.0, 8.0, 5000.0, 90.0, 90.0};
    const SpotFit other_fit = fit_spots(table_of({wide, narrow}), 2);
    ASSERT_EQ(other_fit.spots.size(), 2u);
    EXPECT_LT(other_fit.relative_l2, 1e-3);
    const bool swapped = other_fit.spots[0].exponent > other_fit.spots[1].exponent;
    EXPECT_NEAR(other_fit.spots[swapped].h_deg, wide.h_deg, 0.2);
    EXPECT_NEAR(other_fit.spots[!swapped].h_deg, narrow.h_deg, 0.2);
    EXPECT_NEAR(other_fit.spots[!swapped].exponent, narrow.exponent, 1.0);
}

TEST(SpotFit, MoreSpotsNeverFitWorse) {
    double before = 1.0;
    for (const int count : {1, 2, 3, 5, 8}) {
        const SpotFit fit = fit_spots(small_beam(), count);
        EXPECT_LE(fit.relative_l2, before) << count;
        EXPECT_LE(fit.spots.size(), static_cast<std::size_t>(count));
        expect_legal(fit);
        before = fit.relative_l2;
    }
    EXPECT_LT(before, 0.4);
    EXPECT_THROW(fit_spots(small_beam(), 0), std::invalid_argument);
    EXPECT_THROW(fit_spots(small_beam(), 9), std::invalid_argument);
}

TEST(SpotFit, ResidualsAreWhatIsLeftOverOnTheTable) {
    const CandelaTable table = table_of({{-20.0, -5.0, 1000.0, 4.0, 90.0}, {25.0, 8.0, 5000.0, 90.0, 90.0}});
    const SpotFit fit = fit_spots(table, 1);
    ASSERT_EQ(fit.spots.size(), 1u);
    double squares = 0.0, left_over = 0.0, lit_sr = 0.0, worst = 0.0;
    const auto edge = [](double angle) { return radians(std::clamp(angle, -90.0, 90.0)); };
    for (const double v : table.v_deg)
        for (const double h : table.h_deg) {
            const double sr = (edge(h + 1.5) - edge(h - 1.5)) * (std::sin(edge(v + 1.5)) - std::sin(edge(v - 1.5)));
            const double cd = intensity_cd(table, h, v), difference = cd - intensity_cd(fit.spots[0], h, v);
            squares += sr * cd * cd;
            left_over += sr * difference * difference;
            lit_sr += cd > 0.0 ? sr : 0.0;
            worst = std::max(worst, std::abs(difference));
        }
    const double peak = peak_of(table).cd;
    EXPECT_GT(fit.relative_l2, 0.1);
    EXPECT_NEAR(fit.relative_l2, std::sqrt(left_over / squares), 1e-9);
    EXPECT_NEAR(fit.rms_of_peak, std::sqrt(left_over / lit_sr) / peak, 1e-9);
    EXPECT_NEAR(fit.worst_of_peak, worst / peak, 1e-9);
}

TEST(SpotFit, ALoneSampleIsANarrowCone) {
    const std::vector<double> angles = tests::steps(-90.0, 90.0, 5.0);
    CandelaTable table = tests::table_of(angles, angles, [](double, double) { return 0.0; });
    table.at(18, 18) = 500.0;
    const SpotFit fit = fit_spots(table, 1);
    ASSERT_EQ(fit.spots.size(), 1u);
    EXPECT_NEAR(intensity_cd(fit.spots[0], 0.0, 0.0), 500.0, 1e-6);
    EXPECT_LT(fit.relative_l2, 1e-9); // nothing is left over on the samples
    EXPECT_LT(fit.spots[0].cutoff_deg, 5.0);
}

TEST(SpotFit, ShippedLowBeamsWithEightSpots) {
    for (const std::size_t model : {0u, 2u}) { // halogen and xenon
        const CandelaTable table = lamp_of_model(lamp_models()[model]).table;
        const SpotFit fit = fit_spots(table, max_spots);
        EXPECT_EQ(fit.spots.size(), 8u);
        expect_legal(fit);
        EXPECT_LT(fit.relative_l2, 0.5); // the bells of OpenGL are wider than the hot spot, and no cut-off is straight
        EXPECT_GT(fit.relative_l2, 0.3);
        EXPECT_LT(fit.rms_of_peak, 0.035);
        EXPECT_NEAR(fit.flux_lm, fit.table_flux_lm, 0.2 * fit.table_flux_lm);
        EXPECT_DOUBLE_EQ(fit.table_flux_lm, flux_lm(table));
        // The worst place is a sample of the table, and nowhere is it worse.
        double at_worst = intensity_cd(table, fit.worst_h_deg, fit.worst_v_deg);
        for (const Spot& spot : fit.spots)
            at_worst -= intensity_cd(spot, fit.worst_h_deg, fit.worst_v_deg);
        EXPECT_NEAR(std::abs(at_worst) / peak_of(table).cd, fit.worst_of_peak, 1e-9);
    }
}

TEST(SpotFit, SameTableSameSpotsWhichScaleWithIt) {
    const SpotFit a = fit_spots(small_beam(), 4), b = fit_spots(small_beam(), 4);
    ASSERT_EQ(a.spots.size(), b.spots.size());
    for (std::size_t i = 0; i < a.spots.size(); ++i)
        EXPECT_TRUE(a.spots[i].h_deg == b.spots[i].h_deg && a.spots[i].cd == b.spots[i].cd &&
                    a.spots[i].cutoff_deg == b.spots[i].cutoff_deg);
    const SpotFit plain = fit_spots(small_beam(), 3);
    for (const double factor : {1e-200, 0.5, 1e200}) { // squares of the extremes would not be numbers
        const SpotFit fit = fit_spots(scaled(small_beam(), factor), 3);
        ASSERT_EQ(fit.spots.size(), plain.spots.size());
        EXPECT_NEAR(fit.relative_l2, plain.relative_l2, 1e-9);
        EXPECT_NEAR(fit.spots[0].cd / factor, plain.spots[0].cd, 1e-6 * plain.spots[0].cd);
    }
}

TEST(SpotFit, DarkAndBackwardTablesHaveNoSpots) {
    CandelaTable dark = small_beam();
    dark.cd.assign(dark.cd.size(), 0.0);
    const CandelaTable backward{{120, 150}, {-5, 5}, {100, 100, 100, 100}, {}, BetweenSamples::linear_cd};
    for (const CandelaTable& table : {dark, backward}) {
        const SpotFit fit = fit_spots(table, 8);
        EXPECT_TRUE(fit.spots.empty());
        EXPECT_EQ(std::tuple(fit.flux_lm, fit.relative_l2), std::tuple(0.0, 0.0));
    }
}

TEST(SpotFit, HostileTablesGiveLegalSpots) {
    std::vector<CandelaTable> tables;
    CandelaTable lone = small_beam();
    lone.cd.assign(lone.cd.size(), 0.0);
    lone.at(3, 40) = 5.0;
    tables.push_back(lone);
    CandelaTable many = tests::table_of(tests::steps(-40.0, 40.0, 0.4), tests::steps(-20.0, 20.0, 0.2), [](double, double) { return 0.0; });
    many.at(77, 123) = 1e5;
    tables.push_back(many);
    tables.push_back(tests::even_table(1.0));
    tables.push_back({{-1e-9, 1e-9}, {-1e-9, 1e-9}, {1, 2, 3, 4}, {}, BetweenSamples::log_cd});
    tables.push_back({{89, 90}, {89, 90}, {1, 1, 1, 1}, {}, BetweenSamples::linear_cd});
    tables.push_back({{-10, 0, 10}, {-10, 0, 10}, std::vector<double>(9, 7.0), {1, 1, 1, 1}, BetweenSamples::linear_cd}); // gaps only
    CandelaTable chequered = small_beam();
    for (std::size_t i = 0; i < chequered.cd.size(); ++i)
        chequered.cd[i] = i % 2 == 0 ? 1000.0 : 0.0;
    tables.push_back(chequered);
    for (std::size_t i = 0; i < tables.size(); ++i) {
        SCOPED_TRACE(i);
        const SpotFit fit = fit_spots(tables[i], 3);
        expect_legal(fit);
        EXPECT_EQ(fit.spots.empty(), i == 5);
    }
}

} // namespace
} // namespace fernlicht
