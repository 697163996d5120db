// Sensors, oncoming eyes and mirrors over a drive on a straight and level road, where every place is known by hand.
#include "metrics/folds/reading_names.h"
#include "tests/metrics/folds/one_lamp_straight.h"

#include "metrics/glare/glare.h"
#include "runner/findings/summary.h"
#include "runner/judge/limits.h"
#include "scenarios/values/errors.h"
#include "tests/trial.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

TEST(Seeing, NothingIsMeasuredUnlessAsked) {
    const OneLampStraight straight;
    const SeeingFold fold = straight.played();
    EXPECT_TRUE(fold.readings().empty());
    EXPECT_TRUE(fold.series().empty());
}

// A sensor 100 m along, on the right edge (1.75 m from the own lane's centre), 0.25 m up: E = 1000 / (d^2 + 1.75^2 + 0.4^2).
TEST(Seeing, ASensorSeesTheLawOfDistance) {
    OneLampStraight straight;
    straight.drive.seeing.sensors = SensorParameters{{5.0, 0.05, 1e6}, {50.0, 7.77, 500.0}, {{"edge", 100.0, Across::right_edge, 0.25}}};
    const SeeingFold fold = straight.played();
    const Readings readings = fold.readings();
    const double beside = 1.75 * 1.75 + 0.4 * 0.4;
    // Moments come every metre; between them the logarithm runs straight, off by at most (1/8) (d^2 ln E / dx^2) = (1/8) 2/d^2 of a metre's
    // square: 5e-3 at 7.8 m, 1e-4 at 50 m, and in the distance where a limit is met by d/2 of that.
    EXPECT_NEAR(value(readings, "sensor_edge_reach_5lx_m"), std::sqrt(200.0 - beside), 0.01);
    EXPECT_NEAR(value(readings, "sensor_edge_at_50m_lx"), 1000.0 / (2500.0 + beside), 1e-4);
    EXPECT_NEAR(value(readings, "sensor_edge_at_7.77m_lx"), 1000.0 / (7.77 * 7.77 + beside), 0.07);
    EXPECT_EQ(value(readings, "sensor_edge_reach_1000000lx_m"), 0.0);
    EXPECT_EQ(named(readings, "sensor_edge_reach_0.05lx_m").value.kind(), Value::Kind::at_least) << "from the first moment on";
    EXPECT_THAT(named(readings, "sensor_edge_at_500m_lx").value.reason(), HasSubstr("the drive comes from 96.4 m away"));
    const auto series = fold.series();
    ASSERT_EQ(series.size(), 1U);
    EXPECT_NEAR(series[0].columns.at(0).values.at(10).number().value(), 1000.0 / (86.4 * 86.4 + beside), 1e-9); // after 1 s
    EXPECT_LT(series[0].at_m.back(), 1.0) << "what lies behind the bumper does not count";
    EXPECT_EQ(series[0].ticks.size(), series[0].at_m.size());
}

// An eye on the oncoming lane's centre, 3.5 m beside, 1.1 m up. Every figure against the ruler at the moment that decides.
TEST(Seeing, AnOncomingEyeIsDazzledAsTheRulerSays) {
    OneLampStraight straight;
    GlareParameters& glare = straight.drive.seeing.glare.emplace();
    glare.oncoming = {{"eye", 100.0, 1.1}};
    glare.thresholds_lx = {1.0};
    glare.adaptation_cdm2 = 1.0;
    const SeeingFold fold = straight.played();
    const Readings readings = fold.readings();
    const auto series = fold.series();
    ASSERT_EQ(series.size(), 1U);
    const double beside = 3.5 * 3.5 + 0.45 * 0.45;
    double veiling = 0.0, increment = 0.0, de_boer = 99.0;
    for (std::size_t i = 0; i < series[0].at_m.size(); ++i) {
        const double d = series[0].at_m[i], square = d * d + beside;
        const GlareSource source{1000.0 * d / std::pow(square, 1.5), degrees(std::atan(std::sqrt(beside) / d))};
        const double lv = veiling_luminance_cdm2(VeilingEquation::cie_general, {source}, {}).number().value();
        veiling = std::max(veiling, lv);
        increment = std::max(increment, 65.0 * lv);
        de_boer = std::min(de_boer, de_boer_rating({source}, 1.0).number().value());
        EXPECT_NEAR(series[0].columns.at(0).values.at(i).number().value(), 1000.0 / square, 1e-9 * 1000.0 / square);
    }
    EXPECT_NEAR(value(readings, "glare_eye_veiling_max_cdm2"), veiling, 1e-9 * veiling);
    EXPECT_NEAR(value(readings, "glare_eye_threshold_increment_max_percent"), increment, 1e-9 * increment);
    EXPECT_NEAR(value(readings, "glare_eye_de_boer_min"), de_boer, 1e-9);
    // 1 lx facing the lamp: d^2 = 1000 - beside; from there to the last moment before the eye.
    const double from_m = std::sqrt(1000.0 - beside), to_m = series[0].at_m.back();
    EXPECT_NEAR(value(readings, "glare_eye_length_above_1lx_m"), from_m - to_m, 0.01);
    EXPECT_NEAR(value(readings, "glare_eye_time_above_1lx_s"), (from_m - to_m) / 10.0, 0.001);
    EXPECT_NEAR(value(readings, "glare_eye_at_50m_lx"), 1000.0 / (2500.0 + beside), 1e-4);
}

// The same eye: it comes nearer from 96.4 m, so that of the ranges 15 to 30 and 30 to 60 m are passed.
TEST(Seeing, EachRangeHasItsOwnMaxima) {
    OneLampStraight straight;
    GlareParameters& glare = straight.drive.seeing.glare.emplace();
    glare.oncoming = {{"eye", 100.0, 1.1}};
    glare.adaptation_cdm2 = 1.0;
    const Readings readings = straight.played().readings();
    const double beside = 3.5 * 3.5 + 0.45 * 0.45;
    for (const auto& [near_m, far_m] : {std::pair(15.0, 30.0), std::pair(30.0, 60.0)}) {
        // Facing the lamp there is most at the near end, with the logarithm straight between moments a metre apart: off by 1 / (4 d^2).
        const std::string range = fmt::format("from_{}_to_{}m", near_m, far_m);
        const double facing = 1000.0 / (near_m * near_m + beside), across = facing * near_m / std::sqrt(near_m * near_m + beside);
        EXPECT_NEAR(value(readings, "glare_eye_facing_" + range + "_max_lx"), facing, 0.3 / (near_m * near_m) * facing);
        EXPECT_NEAR(value(readings, "glare_eye_eye_" + range + "_max_lx"), across, 0.5 / (near_m * near_m) * across);
        double veil = 0.0, rating = 99.0;
        for (double d = near_m; d <= far_m; d += 0.1) {
            const GlareSource source{1000.0 * d / std::pow(d * d + beside, 1.5), degrees(std::atan(std::sqrt(beside) / d))};
            veil = std::max(veil, veiling_luminance_cdm2(VeilingEquation::cie_general, {source}, {}).number().value());
            rating = std::min(rating, de_boer_rating({source}, 1.0).number().value());
        }
        EXPECT_NEAR(value(readings, "glare_eye_veiling_" + range + "_max_cdm2"), veil, 2e-3 * veil);
        EXPECT_NEAR(value(readings, "glare_eye_threshold_increment_" + range + "_max_percent"), 65.0 * veil, 2e-3 * 65.0 * veil);
        EXPECT_NEAR(value(readings, "glare_eye_de_boer_" + range + "_min"), rating, 2e-3);
        EXPECT_THAT(named(readings, "glare_eye_facing_" + range + "_max_lx").where,
                    HasSubstr(fmt::format("the bumper {} to {} m before it, facing the lamps", near_m, far_m)));
    }
    EXPECT_GT(value(readings, "glare_eye_facing_max_lx"), value(readings, "glare_eye_facing_from_15_to_30m_max_lx"));
    EXPECT_THAT(named(readings, "glare_eye_facing_from_60_to_120m_max_lx").value.reason(),
                HasSubstr("the drive covers only 60.0 to 96.4 m"));
    EXPECT_THAT(named(readings, "glare_eye_facing_from_120_to_220m_max_lx").value.reason(), HasSubstr("the drive comes from 96.4 m away"));
    // A moment that lacks the figure matters to its own range alone: below a degree age-adjusted veils are not defined.
    glare.equation = VeilingEquation::age_adjusted;
    glare.oncoming = {{"eye", 300.0, 1.1}};
    glare.ranges_m = {190.0, 200.0, 250.0};
    const Readings far = straight.played().readings();
    EXPECT_TRUE(named(far, "glare_eye_veiling_from_190_to_200m_max_cdm2").value.measured());
    EXPECT_THAT(named(far, "glare_eye_veiling_from_200_to_250m_max_cdm2").value.reason(), HasSubstr("in some moment: a source 0."));
    glare.ranges_m = {};
    for (const Reading& reading : straight.played().readings())
        EXPECT_FALSE(reading.key.to_m) << reading.name();
}

// Against a moment every 5 cm: what every second moment would move a figure by covers what lies between the moments.
TEST(Seeing, FiguresOfEyesKnowWhatLiesBetweenMoments) {
    const auto played = [](double step_s) {
        OneLampStraight straight;
        straight.drive.step_s = step_s;
        GlareParameters& glare = straight.drive.seeing.glare.emplace();
        glare.oncoming = {{"opposite", 100.0, 1.1}};
        glare.ranges_m = {15.0, 30.0, 60.0};
        glare.mirrors = MirrorParameters{{30.0}, {1.3, 0.35, 1.2}, 0.5, {{"left", {1.9, 0.95, 1.0}}}};
        return straight.played().readings();
    };
    const Readings fine = played(0.005);
    std::size_t told = 0;
    for (const double step_s : {0.1, 0.4, 1.0})
        for (const Reading& reading : played(step_s)) {
            if (!reading.between_moments)
                continue;
            const Reading exact = named(fine, reading.name());
            if (*reading.between_moments > 0.5 * *reading.value.number() && !reading.key.to_m)
                continue; // 1/d^2 up to the lamp: nothing bounds it
            EXPECT_LE(std::abs(*reading.value.number() - *exact.value.number()), *reading.between_moments + 1e-9)
                << reading.name() << " at " << step_s;
            EXPECT_LE(exact.between_moments.value(), 0.02 * std::abs(*exact.value.number())) << reading.name();
            ++told;
        }
    EXPECT_GT(told, 60U);
    EXPECT_GT(named(played(0.4), "glare_opposite_at_50m_lx").between_moments.value(), 0.0) << "it lies between two moments";
}

// The car ahead at 30 m from the bumper: its mirror 1.9 m before its rear axle, 0.95 m to the left, 1 m up.
TEST(Seeing, AMirrorAheadGetsTheSameAllAlong) {
    OneLampStraight straight;
    GlareParameters& glare = straight.drive.seeing.glare.emplace();
    glare.mirrors = MirrorParameters{{30.0}, {1.3, 0.35, 1.2}, 0.5, {{"left", {1.9, 0.95, 1.0}}}};
    const SeeingFold fold = straight.played();
    const Readings readings = fold.readings();
    const double square = 31.9 * 31.9 + 0.95 * 0.95 + 0.35 * 0.35;
    EXPECT_NEAR(value(readings, "mirror_left_at_30m_lx"), 1000.0 / square, 1e-9);
    EXPECT_NEAR(value(readings, "mirror_left_at_30m_max_lx"), 1000.0 / square, 1e-9);
    // In the mirror the lamp is |mirror - eye| = sqrt(0.6^2 + 0.6^2 + 0.2^2) farther away, and 47.6 degrees beside the way ahead.
    const double behind = std::sqrt(0.76), far = std::sqrt(square) + behind;
    EXPECT_NEAR(value(readings, "glare_mirrors_at_30m_eye_max_lx"), 0.5 * 1000.0 / (far * far) * 0.6 / behind, 1e-9);
    EXPECT_TRUE(named(readings, "glare_mirrors_at_30m_veiling_max_cdm2").value.measured());
    EXPECT_EQ(value(readings, "glare_mirrors_at_30m_length_above_0.5lx_m"), fold.series()[0].at_m.back());
}

TEST(Seeing, SaysWhereThereIsNobody) {
    OneLampStraight straight;
    straight.drive.road_file = straight.drive.road_file.parent_path() / "motorway.xodr";
    const RoadNetwork network = read_opendrive(straight.drive.road_file);
    const Route route(network, {});
    GlareParameters& glare = straight.drive.seeing.glare.emplace();
    glare.oncoming = {{"far", 1.0e5, 1.1}};
    try {
        const SeeingFold fold(straight.drive, route);
        FAIL() << "an observer beyond the route";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("measure.glare.oncoming.far.at_m: found 100000 m, expected a place on the route"));
    }
    glare.oncoming = {{"near", 100.0, 1.1}};
    glare.adaptation_cdm2 = 0.01;
    const SeeingFold unplayed(straight.drive, straight.route);
    for (const Reading& reading : unplayed.readings()) {
        EXPECT_FALSE(reading.value.measured()) << reading.name();
        EXPECT_FALSE(reading.value.reason().empty()) << reading.name();
    }
    const Readings played = straight.played().readings();
    EXPECT_TRUE(named(played, "glare_near_veiling_max_cdm2").value.measured());
    EXPECT_THAT(named(played, "glare_near_threshold_increment_max_percent").value.reason(), HasSubstr("above 0.05"));
    glare.equation = VeilingEquation::age_adjusted; // beyond 200 m the eye is less than a degree off the lamps
    EXPECT_THAT(named(straight.played().readings(), "glare_near_veiling_max_cdm2").value.reason(), HasSubstr("in some moment: a source"));
}

TEST(Seeing, LimitsKnowItsReadings) {
    OneLampStraight straight;
    straight.drive.seeing.sensors = SensorParameters{{5.0}, {}, {{"edge", 100.0, Across::right_edge, 0.25}}};
    const Readings readings = SeeingFold(straight.drive, straight.route).readings();
    straight.drive.limits = {{"sensor_edge_reach_5lx_m", 10.0, std::nullopt}};
    EXPECT_NO_THROW(check_names(straight.drive, readings));
    EXPECT_EQ(judge_limits(straight.drive, straight.played().readings()).at(0).kind, VerdictKind::pass);
    straight.drive.limits[0].at_least = 20.0;
    EXPECT_EQ(judge_limits(straight.drive, straight.played().readings()).at(0).kind, VerdictKind::fail);
    straight.drive.limits[0].reading = "sensor_kerb_reach_5lx_m";
    EXPECT_THROW(check_names(straight.drive, readings), InputError);
    straight.drive.limits[0].reading = "foreground_own_lx"; // of a name, but nobody asks for it
    EXPECT_THAT(tests::refusal_of([&] { check_names(straight.drive, readings); }), testing::HasSubstr("`homogeneity` in `measure:`"));
    straight.drive.limits[0].reading = "reach_1lx_road_right_1_m";
    EXPECT_NO_THROW(check_names(straight.drive, readings, &straight.route));
    straight.drive.limits[0].reading = "reach_1lx_road_left_4_m";
    EXPECT_THAT(tests::refusal_of([&] { check_names(straight.drive, readings, &straight.route); }),
                testing::HasSubstr("expected a lane of this route: own, left 1, left 2, right 1, all"));
}

} // namespace
} // namespace fernlicht
