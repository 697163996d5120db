// Small targets, evenness and light on boards over a drive on the straight, at places worked out by hand.
#include "tests/metrics/folds/asphalt_by_hand.h"
#include "tests/metrics/folds/one_lamp_straight.h"

#include "metrics/seeing/visibility.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

VisibilityParameters looking_for(const VisibilityTarget& target, std::vector<double> distances_m) {
    VisibilityParameters asked;
    asked.targets = {target};
    asked.distances_m = std::move(distances_m);
    return asked;
}

TEST(Seeing, ATargetStandsOutAsAdrianSays) {
    OneLampStraight straight(20000.0, 1.0);
    straight.drive.seeing.visibility = looking_for({"grey", 0.2, 1, 0.04, 2.0}, {50.0});
    const Readings readings = straight.played().readings();
    const double eye_back = straight.drive.bumper_m - 1.3;
    const double on_target = 20000.0 * 50.0 / std::pow(2500.0 + 0.55 * 0.55, 1.5);
    // The line of sight through the target's middle (0.1 m up) meets the road 1.2 / 1.1 times as far from the eye.
    const double times = 1.2 / 1.1, behind = (50.0 + eye_back) * times - eye_back, left = 0.35 * (1.0 - times);
    const double background = asphalt_cdm2(20000.0, behind, left, eye_back);
    EXPECT_NEAR(value(readings, "background_luminance_own_at_50m_cdm2"), background, 1e-6 * background);
    const double sight = std::sqrt((50.0 + eye_back) * (50.0 + eye_back) + 0.35 * 0.35 + 1.1 * 1.1);
    const double level = visibility_level(0.04 / pi * on_target, background, arc_minutes_of(0.2, sight), {25.0, 0.2, 2.6}).number().value();
    EXPECT_NEAR(value(readings, "visibility_level_grey_own_at_50m"), level, 1e-6 * level);
    EXPECT_NEAR(value(readings, "mesopic_luminance_own_at_50m_cdm2"), mesopic_luminance(background, 1.5).luminance_cdm2, 1e-6 * background);
}

TEST(Seeing, DetectionIsTheFarthestPlaceWithTheLevel) {
    OneLampStraight straight(20000.0, 1.0);
    VisibilityTarget target{"t", 0.18, 1, 0.5, 20.0};
    const auto readings = [&](std::vector<double> distances_m) {
        straight.drive.seeing.visibility = looking_for(target, std::move(distances_m));
        return straight.played().readings();
    };
    const double from_m = value(readings({}), "detection_t_own_m");
    std::vector<double> levels;
    for (const Reading& reading : readings({from_m - 0.5, from_m + 0.5}))
        if (reading.key.quantity == Quantity::visibility_level)
            levels.push_back(reading.value.number().value());
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_GT(levels[0], 20.0);
    EXPECT_LT(levels[1], 20.0);
    target.reflectance = 1.0;
    EXPECT_GT(value(readings({}), "detection_t_own_m"), from_m) << "a lighter target from farther away";
    target.level = 1e4;
    EXPECT_EQ(value(readings({}), "detection_t_own_m"), 0.0) << "nowhere";
    target.level = 0.01;
    EXPECT_EQ(named(readings({}), "detection_t_own_m").value, Value::at_least(200.0));
    EXPECT_EQ(straight.played().series().at(0).columns.at(0).values.front(), Value::at_least(200.0));
}

// 50 m ahead at the right edge, 1.75 m beside the lamp: of seven squares of 0.25 m the four below the eye's height, 1.2 m, stand against
// the road, the others against the dark, for an eye adapted to the road behind the feet.
TEST(Seeing, APedestrianIsAsVisibleAsTheClearestSegment) {
    OneLampStraight straight(20000.0, 1.0);
    straight.drive.seeing.visibility = looking_for(default_targets()[2], {50.0});
    const double eye_back = straight.drive.bumper_m - 1.3;
    double clearest = 0.0, adaptation = 0.0;
    for (int i = 0; i < 7; ++i) {
        const double up = 0.125 + 0.25 * i, to_lamp = 50.0 * 50.0 + 1.75 * 1.75 + (0.65 - up) * (0.65 - up);
        const double luminance = 0.4 / pi * 20000.0 * 50.0 / std::pow(to_lamp, 1.5);
        double background = 0.001;
        if (up < 1.2) {
            const double times = 1.2 / (1.2 - up), behind = (50.0 + eye_back) * times - eye_back, left = 0.35 + (-1.75 - 0.35) * times;
            if (behind - 50.0 < 100.0 + 150.0) // so far the lane is known: 200 m looked at and 100 beyond
                background = asphalt_cdm2(20000.0, behind, left, eye_back);
        }
        if (i == 0)
            adaptation = background;
        const double sight = std::sqrt((50.0 + eye_back) * (50.0 + eye_back) + 2.1 * 2.1 + (1.2 - up) * (1.2 - up));
        const double adapted = background > 0.001 ? background : adaptation;
        clearest = std::max(
            clearest, visibility_level(luminance, background, adapted, arc_minutes_of(0.25, sight), {25.0, 0.2, 2.6}).number().value());
    }
    const Readings readings = straight.played().readings();
    EXPECT_NEAR(value(readings, "visibility_level_pedestrian-light_right_at_50m"), clearest, 1e-6 * clearest);
    EXPECT_LT(value(readings, "visibility_level_pedestrian-light_left_at_50m"), clearest) << "farther from the lamp";
}

TEST(Seeing, TheUsualTargetsTellTheirNamesAndPlaces) {
    OneLampStraight straight(20000.0, 1.0);
    straight.drive.seeing.visibility = VisibilityParameters{};
    const Readings readings = straight.played().readings();
    EXPECT_GT(value(readings, "detection_pedestrian-light_right_m"), value(readings, "detection_pedestrian-dark_right_m"));
    EXPECT_THAT(named(readings, "detection_pedestrian-dark_left_m").where,
                HasSubstr("pedestrian-dark, 7 squares of 0.25 m with 5 % reflectance, left edge of the lanes, visibility level 10"));
    EXPECT_THAT(named(readings, "detection_card_own_m").where, HasSubstr("card, a square of 0.2 m with 20 % reflectance"));
}

// On the road E = I h / (x^2 + y^2 + h^2)^1.5 from the lamp: along the middle d lg E / dx = -3 x / (x^2 + h^2) / ln 10.
TEST(Seeing, EvennessOfOneLampAlone) {
    OneLampStraight straight(20000.0, 1.0);
    straight.drive.seeing.homogeneity = HomogeneityParameters{0.01, 80.0, 1.2};
    const Readings readings = straight.played().readings();
    const auto lg = [](double x) { return -1.5 * std::log10(x * x + 0.65 * 0.65); };
    EXPECT_NEAR(value(readings, "gradient_along_own_per_m"), (lg(1.0) - lg(1.5)) / 0.5, 1e-9) << "the first two rows";
    EXPECT_EQ(value(readings, "gradient_along_own_max_per_m"), value(readings, "gradient_along_own_per_m"));
    // Means by trapezia over rows of half a metre, the outermost ones counting half.
    double near_lx = 0.0, far_lx = 0.0;
    for (int k = 10; k <= 120; ++k)
        for (int column = -7; column <= 7; ++column) {
            const double x = 0.5 * k, y = 0.25 * column, e = std::pow(x * x + y * y + 0.65 * 0.65, -1.5);
            if (k <= 30)
                near_lx += e * (k == 10 || k == 30 ? 0.5 : 1.0) / 20.0;
            if (k >= 80)
                far_lx += e * (k == 80 || k == 120 ? 0.5 : 1.0) / 40.0;
        }
    EXPECT_NEAR(value(readings, "foreground_ratio_own"), near_lx / far_lx, 1e-6 * near_lx / far_lx);
    EXPECT_EQ(value(readings, "patch_dark_own_m"), 0.0);
}

// 50 m ahead: the right edge 1.75 m beside the lamp, boards 2 m farther and 2 m up, one 5.5 m over the lane.
TEST(Seeing, KerbAndBoardsByHand) {
    OneLampStraight straight(20000.0, 1.0);
    straight.drive.seeing.places = PlaceParameters{true, true, true, {50.0}};
    const Readings readings = straight.played().readings();
    const auto square = [](double beside, double height) { return 2500.0 + beside * beside + height * height; };
    EXPECT_NEAR(value(readings, "kerb_at_50m_lx"), 20000.0 * 0.65 / std::pow(square(1.75, 0.65), 1.5), 1e-9);
    EXPECT_NEAR(value(readings, "kerb_target_at_50m_lx"), 20000.0 / square(1.75, 0.4), 1e-9);
    EXPECT_NEAR(value(readings, "board_right_at_50m_lx"), 20000.0 * 50.0 / std::pow(square(3.75, 1.35), 1.5), 1e-9);
    EXPECT_NEAR(value(readings, "board_left_at_50m_lx"), 20000.0 * 50.0 / std::pow(square(7.25, 1.35), 1.5), 1e-9);
    EXPECT_NEAR(value(readings, "board_overhead_at_50m_lx"), 20000.0 * 50.0 / std::pow(square(0.0, 4.85), 1.5), 1e-9);
    // Class RA2: at least 180 cd/(m2 lx) at 0.33 degrees; the driver looks from 0.5 to 1 degree here, where sheeting sends back less.
    const double ra = value(readings, "board_right_at_50m_cdm2") / value(readings, "board_right_at_50m_lx");
    EXPECT_GT(ra, 20.0);
    EXPECT_LT(ra, 180.0);
    EXPECT_GT(value(readings, "marking_right_at_50m_cdm2"), 0.0);
}

} // namespace
} // namespace fernlicht
