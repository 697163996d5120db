#include "scenarios/lamps/candela_table.h"

#include "scenarios/values/pose.h"
#include "tests/lamps.h"
#include "tests/trial.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <random>

namespace fernlicht {
namespace {

using tests::steps, tests::table_of;

CandelaTable random_table(unsigned seed, BetweenSamples rule = BetweenSamples::linear_cd) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> step(0.05, 3.0), cd(0.1, 5000.0);
    const auto uneven = [&](double from, int count) {
        std::vector<double> out{from};
        for (int i = 1; i < count; ++i)
            out.push_back(out.back() + step(random));
        return out;
    };
    std::vector<double> h = uneven(-30.0 - step(random), 9), v = uneven(-8.0 - step(random), 6);
    return table_of(
        h, v, [&](double, double) { return cd(random); }, rule);
}

TEST(CandelaTable, GivesItsOwnSamplesAndRunsLinearlyBetweenThem) {
    for (const auto rule : {BetweenSamples::linear_cd, BetweenSamples::log_cd}) {
        const CandelaTable table = random_table(1, rule);
        for (std::size_t v = 0; v < table.v_deg.size(); ++v)
            for (std::size_t h = 0; h < table.h_deg.size(); ++h)
                EXPECT_NEAR(intensity_cd(table, table.h_deg[h], table.v_deg[v]), table.at(v, h), 1e-14 * 5000.0 * 10.0);
    }
    CandelaTable table{{0.0, 2.0}, {-1.0, 1.0}, {1.0, 100.0, 10.0, 1000.0}, {}, BetweenSamples::linear_cd};
    EXPECT_DOUBLE_EQ(intensity_cd(table, 0.5, -1.0), 25.75);
    EXPECT_DOUBLE_EQ(intensity_cd(table, 1.0, 0.0), 277.75);
    table.rule = BetweenSamples::log_cd;
    EXPECT_NEAR(intensity_cd(table, 0.5, -1.0), std::pow(100.0, 0.25), 1e-12);
    EXPECT_NEAR(intensity_cd(table, 1.0, 0.0), std::pow(1.0 * 100.0 * 10.0 * 1000.0, 0.25), 1e-11);
    table.cd[3] = 0.0;
    EXPECT_DOUBLE_EQ(intensity_cd(table, 1.0, 0.0), 27.75) << "a cell with a zero has no logarithm";
}

TEST(CandelaTable, HasNoLightOutsideItsAxesUnlessTheyWrapRound) {
    const CandelaTable table = table_of({-10.0, 0.0, 10.0}, {-5.0, 0.0, 5.0}, [](double, double) { return 7.0; });
    EXPECT_EQ(intensity_cd(table, 10.0, 5.0), 7.0);
    for (const auto& [h, v] :
         std::vector<std::pair<double, double>>{{10.001, 0.0}, {-10.001, 0.0}, {0.0, 5.001}, {0.0, -90.0}, {180.0, 0.0}})
        EXPECT_EQ(intensity_cd(table, h, v), 0.0) << h << ", " << v;
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(intensity_cd(table, nan, 0.0), 0.0);
    EXPECT_EQ(intensity_cd(table, 0.0, nan), 0.0);
    EXPECT_EQ(intensity_cd(table, inf, 0.0), 0.0);
    const CandelaTable other_table =
        table_of(steps(-180.0, 180.0, 10.0), {-90.0, 90.0}, [](double h, double) { return 2.0 + std::cos(radians(h)); });
    EXPECT_NEAR(intensity_cd(other_table, 185.0, 0.0), intensity_cd(other_table, -175.0, 0.0), 1e-12);
    EXPECT_NEAR(intensity_cd(other_table, -725.0, 0.0), intensity_cd(other_table, -5.0, 0.0), 1e-12);
    EXPECT_NEAR(intensity_cd(other_table, 180.0, 0.0), 1.0, 1e-12);
}

TEST(CandelaTable, HasNoLightInAGapButOnItsBorder) {
    CandelaTable table = table_of({-90.0, -10.0, 0.0, 10.0, 90.0}, {-90.0, -5.0, 0.0, 5.0, 90.0},
                                  [](double h, double v) { return std::abs(h) > 20.0 || std::abs(v) > 20.0 ? 0.0 : 100.0; });
    table.gaps = {1, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 1, 1, 1};
    check_invariants(table);
    EXPECT_EQ(intensity_cd(table, -11.0, 0.0), 0.0);
    EXPECT_EQ(intensity_cd(table, 11.0, 0.0), 0.0);
    EXPECT_EQ(intensity_cd(table, 0.0, 5.5), 0.0);
    for (const double h : {-10.0, 0.0, 10.0})
        for (const double v : {-5.0, 0.0, 5.0})
            EXPECT_EQ(intensity_cd(table, h, v), 100.0) << h << ", " << v;
    const CandelaTable lit = table_of({-10.0, 10.0}, {-5.0, 5.0}, [](double, double) { return 100.0; });
    EXPECT_NEAR(flux_lm(table), flux_lm(lit), 1e-12);
}

TEST(CandelaTable, RowsOfDirectionsAreThoseOfEachDirection) {
    std::vector<CandelaTable> tables{random_table(3), random_table(4), random_table(5)};
    tables[1].rule = BetweenSamples::log_cd;
    tables[2].gaps.assign((tables[2].v_deg.size() - 1) * (tables[2].h_deg.size() - 1), 0);
    for (std::size_t i = 0; i < tables[2].gaps.size(); i += 3)
        tables[2].gaps[i] = 1;
    for (const CandelaTable& table : tables) {
        std::vector<double> h_deg = table.h_deg, v_deg = table.v_deg;
        for (const double beside : {-725.0, -181.0, -3.3, 0.1, 2.7, 181.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
            h_deg.push_back(beside);
            v_deg.push_back(beside);
        }
        IntensityAcross across(table, h_deg);
        for (const double v : v_deg) {
            const std::vector<double>& row = across.at(v);
            for (std::size_t i = 0; i < h_deg.size(); ++i)
                EXPECT_EQ(row[i], intensity_cd(table, h_deg[i], v)) << h_deg[i] << ", " << v;
        }
    }
}

TEST(CandelaTable, FindsItsPeakAndScalesEverySample) {
    const CandelaTable table = table_of(steps(-20.0, 20.0, 0.5), steps(-10.0, 5.0, 0.25), [](double h, double v) {
        return 3e4 * std::exp(-std::pow(h - 1.5, 2) / 50.0 - std::pow(v + 0.75, 2) / 4.0);
    });
    const Peak peak = peak_of(table);
    EXPECT_DOUBLE_EQ(peak.cd, 3e4);
    EXPECT_DOUBLE_EQ(peak.h_deg, 1.5);
    EXPECT_DOUBLE_EQ(peak.v_deg, -0.75);
    const CandelaTable other_table = random_table(2);
    EXPECT_NEAR(flux_lm(scaled(other_table, 2.5)), 2.5 * flux_lm(other_table), 1e-9);
    EXPECT_EQ(peak_of(scaled(other_table, 0.0)).cd, 0.0);
    EXPECT_THROW(scaled(other_table, -1.0), std::invalid_argument);
    EXPECT_THROW(scaled(other_table, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

TEST(CandelaTableFlux, OfAConstantIntensityAndOfACosine) {
    for (const auto rule : {BetweenSamples::linear_cd, BetweenSamples::log_cd})
        for (const double step : {180.0, 90.0, 5.0, 0.5}) {
            const CandelaTable table = table_of(
                steps(-180.0, 180.0, 2.0 * step), steps(-90.0, 90.0, step), [](double, double) { return 12.5; }, rule);
            EXPECT_NEAR(flux_lm(table), 4.0 * pi * 12.5, 1e-11 * 4.0 * pi * 12.5) << step;
        }
    // Lambert: I = I0 cos(angle to the axis) = I0 cos V cos H; linear interpolation over 1 degree loses about step^2/12 in each direction.
    const CandelaTable table = table_of(steps(-90.0, 90.0, 1.0), steps(-90.0, 90.0, 1.0), [](double h, double v) {
        return std::max(0.0, 800.0 * std::cos(radians(v)) * std::cos(radians(h)));
    });
    EXPECT_NEAR(flux_lm(table) / (pi * 800.0), 1.0, 6e-5);
}

/// The rule integrated numerically: midpoint sums over intensity_cd on a fine grid.
double flux_by_midpoints(const CandelaTable& table, int per_cell) {
    double flux = 0.0;
    for (std::size_t v = 0; v + 1 < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h + 1 < table.h_deg.size(); ++h) {
            const double dv = (table.v_deg[v + 1] - table.v_deg[v]) / per_cell, dh = (table.h_deg[h + 1] - table.h_deg[h]) / per_cell;
            for (int y = 0; y < per_cell; ++y)
                for (int x = 0; x < per_cell; ++x) {
                    const double vd = table.v_deg[v] + (y + 0.5) * dv;
                    flux += intensity_cd(table, table.h_deg[h] + (x + 0.5) * dh, vd) * std::cos(radians(vd)) * radians(dv) * radians(dh);
                }
        }
    return flux;
}

TEST(CandelaTableFlux, IsTheIntegralOfTheTablesOwnRule) {
    for (unsigned seed = 0; seed < 5; ++seed)
        for (const auto rule : {BetweenSamples::linear_cd, BetweenSamples::log_cd}) {
            CandelaTable table = random_table(seed, rule);
            table.cd[seed * 3] = 0.0;
            // Midpoint rule on 200 x 200 points a cell: relative error about (log range)^2 / (24 * 200^2) < 1.2e-4 in log cells, less in
            // linear ones.
            EXPECT_NEAR(flux_lm(table) / flux_by_midpoints(table, 200), 1.0, 1.2e-4) << seed;
        }
    // Near V = 0 the cosine is 1: the integral of exp along V is (b - a)/ln(b/a) times the area. The cosine leaves 1e-8 on 0.01 degrees.
    const CandelaTable table{{0.0, 0.01}, {-0.005, 0.005}, {1e-6, 1e-6, 1e9, 1e9}, {}, BetweenSamples::log_cd};
    const double area = radians(0.01) * radians(0.01);
    EXPECT_NEAR(flux_lm(table) / ((1e9 - 1e-6) / std::log(1e15) * area), 1.0, 1e-8);
}

TEST(CandelaTable, NamesTheBrokenInvariant) {
    const auto complaint = [](const CandelaTable& table) {
        return tests::refusal_of<std::invalid_argument>([&] { check_invariants(table); }, "none");
    };
    using testing::HasSubstr;
    const CandelaTable good{{0.0, 1.0}, {0.0, 1.0}, {1.0, 2.0, 3.0, 4.0}, {}, BetweenSamples::linear_cd};
    EXPECT_EQ(complaint(good), "none");
    const auto broken = [&](auto breakage) {
        CandelaTable table = good;
        breakage(table);
        return complaint(table);
    };
    EXPECT_THAT(broken([](auto& t) { t.h_deg = {0.0}; }), HasSubstr("H axis has 1 samples"));
    EXPECT_THAT(broken([](auto& t) { t.v_deg = {1.0, 1.0}; }), HasSubstr("V axis has 1 after 1"));
    EXPECT_THAT(broken([](auto& t) { t.h_deg[1] = 181.0; }), HasSubstr("H axis has 181"));
    EXPECT_THAT(broken([](auto& t) { t.v_deg[1] = std::numeric_limits<double>::quiet_NaN(); }), HasSubstr("V axis has nan"));
    EXPECT_THAT(broken([](auto& t) { t.cd[2] = -1.0; }), HasSubstr("-1 cd at H 0, V 1"));
    EXPECT_THAT(broken([](auto& t) { t.cd[3] = std::numeric_limits<double>::infinity(); }), HasSubstr("inf cd"));
    EXPECT_THAT(broken([](auto& t) { t.cd.pop_back(); }), HasSubstr("3 intensities, expected 4"));
    EXPECT_THAT(broken([](auto& t) { t.gaps = {0, 1}; }), HasSubstr("2 gap marks"));
}

TEST(CandelaTable, MirrorsForLeftHandTraffic) {
    CandelaTable table = random_table(3);
    table.gaps.assign((table.v_deg.size() - 1) * (table.h_deg.size() - 1), 0);
    table.gaps[2] = 1;
    const CandelaTable before = table, mirror = mirrored(table);
    EXPECT_EQ(table, before);
    check_invariants(mirror);
    for (double h = -33.05; h < 5.0; h += 0.61)
        for (double v = -11.0; v < 5.0; v += 0.37)
            EXPECT_NEAR(intensity_cd(mirror, -h, v), intensity_cd(table, h, v), 1e-9);
    EXPECT_EQ(mirrored(mirror), table);
    EXPECT_FALSE(std::signbit(mirrored(table_of({-1.0, 0.0, 1.0}, {0.0, 1.0}, [](double, double) { return 1.0; })).h_deg[1]));
}

TEST(CandelaTableSums, EqualTheSumOfBothEverywhere) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        CandelaTable a = random_table(10 + seed);
        const CandelaTable b = random_table(20 + seed);
        if (seed % 2 == 1) {
            a.gaps.assign((a.v_deg.size() - 1) * (a.h_deg.size() - 1), 0);
            a.gaps[9] = a.gaps[10] = 1;
        }
        const CandelaTable both = sum(a, b);
        check_invariants(both);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> h(-40.0, 10.0), v(-15.0, 15.0);
        for (int i = 0; i < 4000; ++i) {
            const double hd = h(random), vd = v(random);
            // Bilinear patches add exactly; 1e-9 relative is left for the jumps' finite width and rounding.
            EXPECT_NEAR(intensity_cd(both, hd, vd), intensity_cd(a, hd, vd) + intensity_cd(b, hd, vd), 1e-5) << hd << ", " << vd;
        }
        EXPECT_NEAR(flux_lm(both) / (flux_lm(a) + flux_lm(b)), 1.0, 1e-8);
    }
}

TEST(CandelaTableSums, EndWithTheirTablesAndMarkWhereNeitherHasData) {
    const CandelaTable narrow = table_of({-5.0, 0.0, 5.0}, {-5.0, 0.0, 5.0}, [](double, double) { return 1000.0; });
    const CandelaTable wide = table_of({-40.0, 40.0}, {-20.0, 20.0}, [](double, double) { return 1.0; });
    EXPECT_NEAR(intensity_cd(sum(narrow, wide), 5.001, 0.0), 1.0, 1e-9);
    EXPECT_NEAR(intensity_cd(sum(wide, narrow), 4.999, 4.999), 1001.0, 1e-9);
    EXPECT_NEAR(intensity_cd(sum(wide, narrow), 0.0, -5.001), 1.0, 1e-9);
    const CandelaTable left = table_of({-20.0, -10.0}, {0.0, 5.0}, [](double, double) { return 8.0; });
    const CandelaTable right = table_of({10.0, 20.0}, {-5.0, 0.0}, [](double, double) { return 4.0; }), both = sum(left, right);
    EXPECT_EQ(intensity_cd(both, 0.0, 0.0), 0.0);
    EXPECT_EQ(intensity_cd(both, -9.0, 2.0), 0.0);
    EXPECT_NEAR(intensity_cd(both, -15.0, 2.0), 8.0, 1e-12);
    EXPECT_NEAR(flux_lm(both), flux_lm(left) + flux_lm(right), 1e-8);
}

TEST(CandelaTableSums, SubtractAndCountWhatCannotBeTaken) {
    const CandelaTable a = random_table(31), b = random_table(32);
    std::size_t clamped = 99;
    const CandelaTable back = difference(sum(a, b), b, clamped);
    EXPECT_EQ(clamped, 0U);
    EXPECT_NEAR(flux_lm(back) / flux_lm(a), 1.0, 1e-8);
    EXPECT_EQ(flux_lm(difference(a, a, clamped)), 0.0);
    EXPECT_EQ(clamped, 0U);
    const CandelaTable nothing = difference(a, scaled(a, 2.0), clamped);
    EXPECT_EQ(peak_of(nothing).cd, 0.0);
    EXPECT_EQ(clamped, a.cd.size());
}

TEST(CandelaTablePrediction, IsPerfectForABilinearBeam) {
    const CandelaTable table =
        table_of(steps(-10.0, 10.0, 1.0), steps(-5.0, 5.0, 0.5), [](double h, double v) { return 100.0 + h + 2.0 * v + 0.1 * h * v; });
    const InterpolationError error = interpolation_error(table);
    EXPECT_EQ(error.samples, 21U * 21U - 11U * 11U);
    EXPECT_LT(error.worst_relative, 1e-14);
}

TEST(CandelaTablePrediction, FindsTheSpikeItCannotPredict) {
    CandelaTable table = table_of(steps(-10.0, 10.0, 1.0), steps(-5.0, 5.0, 0.5), [](double, double) { return 10.0; });
    table.at(7, 4) = 100.0;
    const InterpolationError error = interpolation_error(table);
    EXPECT_DOUBLE_EQ(error.worst_relative, 0.9);
    EXPECT_DOUBLE_EQ(error.worst_h_deg, -6.0);
    EXPECT_DOUBLE_EQ(error.worst_v_deg, -1.5);
    EXPECT_LT(error.median_relative, 1e-15);
}

TEST(CandelaTablePrediction, FollowsTheCurvatureOfAParabolaAndNothingInATinyOrDarkTable) {
    // y = x^2 on step 1, predicted from step 2: the chord lies 1 above the curve at each middle. Peak 100.
    const CandelaTable table = table_of(steps(-10.0, 10.0, 1.0), {0.0, 1.0}, [](double h, double) { return h * h; });
    const InterpolationError error = interpolation_error(table);
    EXPECT_EQ(error.samples, 20U);
    EXPECT_NEAR(error.median_relative, 0.01, 1e-12);
    EXPECT_NEAR(error.p95_relative, 0.01, 1e-12);
    EXPECT_EQ(interpolation_error(table_of({0.0, 1.0}, {0.0, 1.0}, [](double, double) { return 3.0; })).samples, 0U);
    EXPECT_EQ(interpolation_error(table_of({0.0, 1.0, 2.0}, {0.0, 1.0, 2.0}, [](double, double) { return 0.0; })).samples, 0U);
}

} // namespace
} // namespace fernlicht
