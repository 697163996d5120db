// The ruler for glare: values worked out by hand from the equations, each beside its working.
#include "metrics/glare/glare.h"
#include "tests/lamps.h"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

double veil(VeilingEquation equation, double theta_deg, GlareEye eye = {}) {
    return veiling_luminance_cdm2(equation, {{1.0, theta_deg}}, eye).number().value();
}

TEST(VeilingLuminance, EquationsByHand) {
    EXPECT_DOUBLE_EQ(veil(VeilingEquation::stiles_holladay, 2.0), 2.5); // 10 / 2^2
    EXPECT_DOUBLE_EQ(veil(VeilingEquation::stiles_holladay, 10.0), 0.1);
    // 1 + (25/70)^4 = 1.016269
    EXPECT_NEAR(veil(VeilingEquation::age_adjusted, 1.0), 10.1627, 5e-5);
    EXPECT_NEAR(veil(VeilingEquation::age_adjusted, 3.0), 1.12919, 5e-6);
    EXPECT_NEAR(veil(VeilingEquation::age_adjusted, 10.0), 0.101627, 5e-7);
    EXPECT_DOUBLE_EQ(veil(VeilingEquation::age_adjusted, 10.0, {70.0, 0.5}), 0.2); // at 70 twice the classic value
    // age 25, p = 0.5: 10/t^3 + (5/t^2 + 0.05/t) 1.0256 + 0.00125
    EXPECT_NEAR(veil(VeilingEquation::cie_general, 1.0), 15.1805, 5e-5);
    EXPECT_NEAR(veil(VeilingEquation::cie_general, 3.0), 0.958491, 5e-7); // 0.370370 + 0.572222 * 1.0256 + 0.00125
    EXPECT_NEAR(veil(VeilingEquation::cie_general, 10.0), 0.067658, 5e-7);
    // At 62.5 the age's factor is 2: 0.01 + 0.1 + 2 * 0.1 p / 10 + 0.0025 p.
    EXPECT_NEAR(veil(VeilingEquation::cie_general, 10.0, {62.5, 1.2}), 0.01 + 0.1 + 0.024 + 0.003, 1e-12);
}

TEST(VeilingLuminance, SourcesAddAndDarkOnesDoNotCount) {
    const GlareEye eye;
    const auto lv = [&](const std::vector<GlareSource>& sources) {
        return veiling_luminance_cdm2(VeilingEquation::age_adjusted, sources, eye).number().value();
    };
    EXPECT_DOUBLE_EQ(lv({{0.3, 2.0}, {0.7, 5.0}}), lv({{0.3, 2.0}}) + lv({{0.7, 5.0}}));
    EXPECT_DOUBLE_EQ(lv({{0.6, 2.0}}), 2.0 * lv({{0.3, 2.0}}));
    EXPECT_DOUBLE_EQ(lv({{0.3, 2.0}, {0.0, 0.0}}), lv({{0.3, 2.0}})) << "dark at an angle beyond the domain";
    EXPECT_EQ(lv({}), 0.0);
}

TEST(VeilingLuminance, EndsWithItsDomainAndRefusesWhatIsNoLight) {
    struct Case {
        VeilingEquation equation;
        double inside, below, above;
    };
    for (const auto& [equation, inside, below, above] :
         {Case{VeilingEquation::stiles_holladay, 1.0, 0.99, 30.01}, Case{VeilingEquation::age_adjusted, 30.0, 0.99, 30.01},
          Case{VeilingEquation::cie_general, 0.1, 0.099, 100.01}, Case{VeilingEquation::cie_general, 100.0, 0.0, 180.0}}) {
        EXPECT_TRUE(veiling_luminance_cdm2(equation, {{1.0, inside}}, {}).measured());
        for (const double outside : {below, above}) {
            const Value lv = veiling_luminance_cdm2(equation, {{1.0, 5.0}, {1.0, outside}}, {});
            EXPECT_FALSE(lv.measured()) << name(equation) << ' ' << outside;
            EXPECT_THAT(lv.reason(), HasSubstr(std::string(name(equation)) + " holds from"));
        }
    }
    for (const GlareSource source : {GlareSource{-1.0, 5.0}, GlareSource{std::nan(""), 5.0}, GlareSource{1.0, std::nan("")}})
        EXPECT_THROW(veiling_luminance_cdm2(VeilingEquation::cie_general, {source}, {}), std::invalid_argument);
}

TEST(ThresholdIncrement, BothBranchesByHandAndNothingInTheDark) {
    EXPECT_DOUBLE_EQ(threshold_increment_percent(0.2, 1.0).number().value(), 13.0);
    EXPECT_NEAR(threshold_increment_percent(0.1, 0.1).number().value(), 6.5 * std::pow(10.0, 0.8), 1e-9); // 0.1^-0.8 = 6.3096
    EXPECT_NEAR(threshold_increment_percent(1.0, 10.0).number().value(), 8.46688, 1e-5);                  // 95 / 10^1.05 = 95 / 11.22018
    EXPECT_NEAR(threshold_increment_percent(1.0, 5.0).number().value(), 17.93649, 1e-5);                  // 65 / 5^0.8 = 65 / 3.623898
    const double above = threshold_increment_percent(1.0, std::nextafter(5.0, 6.0)).number().value();
    EXPECT_NEAR(above, 17.53098, 1e-4) << "95 / 5^1.05 = 95 / 5.418975: the branches differ by 2.3 %";
    EXPECT_TRUE(threshold_increment_percent(0.2, 0.051).measured());
    for (const double lav : {0.05, 0.0}) {
        const Value ti = threshold_increment_percent(0.2, lav);
        EXPECT_FALSE(ti.measured());
        EXPECT_THAT(ti.reason(), HasSubstr("above 0.05"));
    }
}

// Lu = 1: 1 + sqrt(25) = 6. theta = 3.43 degrees = 205.8 arc minutes, ^0.46 = 11.593; 0.003 * 6 * 11.593 = 0.20867.
TEST(DeBoer, ByHandAndOnlyWithLightOffTheLineOfSight) {
    EXPECT_NEAR(de_boer_rating({{0.1, 3.43}}, 1.0).number().value(), 5.64, 0.005); // 5 - 2 lg 0.4792
    EXPECT_NEAR(de_boer_rating({{1.0, 3.43}}, 1.0).number().value(), 3.64, 0.005); // 5 - 2 lg 4.792
    EXPECT_GT(de_boer_rating({{1.0, 3.43}}, 1.0).number().value(), 3.0) << "2.00 is what 0.003 lx gives with theta in degrees";
    const double w = de_boer_rating({{0.05, 2.0}, {0.02, 3.0}}, 0.5).number().value();
    EXPECT_NEAR(de_boer_rating({{0.5, 2.0}, {0.2, 3.0}}, 0.5).number().value(), w - 2.0, 1e-12);
    EXPECT_NEAR(de_boer_rating({{0.1, 3.43}, {0.1, 3.43}}, 1.0).number().value(), 5.0 - 2.0 * std::log10(2.0 * 0.47923), 1e-4);
    EXPECT_THAT(de_boer_rating({}, 1.0).reason(), HasSubstr("no light"));
    EXPECT_THAT(de_boer_rating({{0.0, 0.0}}, 1.0).reason(), HasSubstr("no light"));
    EXPECT_THAT(de_boer_rating({{1.0, 0.0}}, 1.0).reason(), HasSubstr("line of sight"));
}

// Lamps as eyes meet them, against hand-worked places on a level road, and what a crest hides.

LitLamp lamp_at(const glm::dvec3& position_m, double cd) {
    LitLamp lamp{.name = "left", .file = tests::file_of(tests::even_table(cd))};
    lamp.pose.position_m = position_m;
    return lamp;
}

Moment moment_with(std::vector<LitLamp> lamps) { return {.lamps = std::move(lamps)}; }

// 1000 cd at 0.65 m, an eye 50 m ahead, 3.5 m to the left, 1.1 m up: d^2 = 2500 + 12.25 + 0.2025 = 2512.4525; theta = atan(sqrt(12.4525) /
// 50) = 4.0370 degrees.
TEST(EyeLight, AnOncomingEyeOnALevelRoad) {
    const glm::dvec3 eye{50.0, 3.5, 1.1}, gaze{-1.0, 0.0, 0.0};
    const auto lamps = seen_lamps(moment_with({lamp_at({0.0, 0.0, 0.65}, 1000.0)}), eye);
    ASSERT_EQ(lamps.size(), 1U);
    EXPECT_NEAR(lamps[0].facing_lx, 1000.0 / 2512.4525, 1e-12);
    const GlareSource source = glare_source(lamps[0], eye, gaze);
    EXPECT_NEAR(source.theta_deg, 4.0370, 5e-5);
    EXPECT_NEAR(source.eye_lx, 1000.0 * 50.0 / std::pow(2512.4525, 1.5), 1e-12); // cos(theta) = 50 / d
    EXPECT_EQ(glare_source(lamps[0], eye, -gaze).eye_lx, 0.0) << "from behind the eye";
}

// The lamp 10 m behind a mirror, the eye 0.5 m before the mirror: as from an image 10.5 m away, of which 0.8 is left.
TEST(EyeLight, AMirrorShowsTheLampBehindItselfAndAnglesAreExact) {
    const glm::dvec3 mirror{0.3, 0.4, 1.0}, eye{0.0, 0.0, 1.0};
    const auto lamps = seen_lamps(moment_with({lamp_at({-9.7, 0.4, 1.0}, 500.0)}), mirror);
    const GlareSource source = mirrored_source(lamps[0], mirror, 0.8, eye, {1.0, 0.0, 0.0});
    EXPECT_NEAR(source.theta_deg, degrees(std::atan2(0.4, 0.3)), 1e-12);
    EXPECT_NEAR(source.eye_lx, 0.8 * 500.0 / (10.5 * 10.5) * 0.6, 1e-12); // cos = 0.3 / 0.5
    EXPECT_NEAR(angle_between_deg({1.0, 0.0, 0.0}, {1.0, 1e-9, 0.0}), degrees(1e-9), 1e-20);
    EXPECT_DOUBLE_EQ(angle_between_deg({1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}), 180.0);
}

/// Our country road rises to a crest of 2500 m radius with its top about 500 m along.
TEST(EyeLight, ACrestHidesLampsAndALevelRoadDoesNot) {
    const std::filesystem::path roads = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/roads";
    const RoadNetwork level = read_opendrive(roads / "straight.xodr"), hilly = read_opendrive(roads / "country.xodr");
    const Route straight(level, {}), country(hilly, {});
    const auto hidden = [](const Route& route, double from_m, double to_m, double lamp_m, double eye_m) {
        const auto above = [&](double at_m, double height_m) {
            const Pose surface = route.pose(at_m);
            return surface.position_m + height_m * surface.up();
        };
        return RoadBetween(route, from_m, to_m).hides(above(from_m, lamp_m), above(to_m, eye_m));
    };
    for (const double to_m : {10.0, 100.0, 900.0})
        EXPECT_FALSE(hidden(straight, 0.0, to_m, 0.65, 1.1)) << to_m;
    EXPECT_TRUE(hidden(straight, 0.0, 100.0, 0.65, -0.5)) << "an eye in the ground";
    // Over a crest of radius r two points of heights a and b see each other within sqrt(2 r a) + sqrt(2 r b) = 57.0 + 74.2 m.
    EXPECT_FALSE(hidden(country, 440.0, 560.0, 0.65, 1.1));
    EXPECT_TRUE(hidden(country, 425.0, 575.0, 0.65, 1.1));
    EXPECT_FALSE(hidden(country, 425.0, 575.0, 2.0, 1.1)) << "a lamp of 2 m sees over it: 100 + 74.2 m";
}

// Lamps of others in the own driver's eyes, by hand.

/// 5000 cd in all directions ahead, 50 m before the eye and 3.5 m to the left, on body 0.
Moment oncoming() {
    const auto file = tests::file_of(tests::even_table(5000.0, 80.0, 80.0));
    return Moment{.other_lamps = {{"other left", file, {{50.0, 3.5, 1.2}, axes_from_angles(pi, 0.0, 0.0)}, 1.0, {}, 0.0, 0, {0.16, 0.12}}},
                  .bodies = {{"other", {{53.0, 3.5, 0.0}, axes_from_angles(pi, 0.0, 0.0)}, true, 0.0}}};
}

const std::vector<BodyBox> cars(2, BodyBox{{4.5, 1.8, 1.45}, -0.9});

TEST(TrafficGlare, IsIntensityOverDistanceSquaredAcrossTheGaze) {
    const std::vector<GlareSource> seen = traffic_glare(oncoming(), {0.0, 0.0, 1.2}, {1.0, 0.0, 0.0}, cars);
    ASSERT_EQ(seen.size(), 1U);
    const double d2 = 50.0 * 50.0 + 3.5 * 3.5;
    EXPECT_NEAR(seen[0].eye_lx, 5000.0 / d2 * 50.0 / std::sqrt(d2), 1e-9);
    EXPECT_NEAR(seen[0].theta_deg, degrees(std::atan(3.5 / 50.0)), 1e-9);
}

TEST(TrafficGlare, IsHiddenByAnotherCarAndNotByItsOwn) {
    Moment moment = oncoming();
    const auto count = [&] { return traffic_glare(moment, {0.0, 0.0, 1.2}, {1.0, 0.0, 0.0}, cars).size(); };
    moment.bodies.push_back({"between", {{30.0, 2.1, 0.0}, glm::dmat3(1.0)}, true, 0.0});
    EXPECT_EQ(count(), 0U);
    moment.bodies[1].visible = false;
    EXPECT_EQ(count(), 1U);
    moment.bodies[1] = {"beside", {{30.0, 5.0, 0.0}, glm::dmat3(1.0)}, true, 0.0};
    EXPECT_EQ(count(), 1U);
    const BodyBox box{{4.0, 2.0, 1.5}, -1.0}; // x -1..3, y -1..1, z 0..1.5
    EXPECT_TRUE(box_hides(box, {}, {-5.0, 0.0, 1.0}, {5.0, 0.0, 1.0}));
    EXPECT_FALSE(box_hides(box, {}, {-5.0, 0.0, 1.6}, {5.0, 0.0, 1.6}));
    EXPECT_FALSE(box_hides(box, {}, {-5.0, 0.0, 1.0}, {-1.1, 0.0, 1.0})) << "ends before it";
    EXPECT_FALSE(box_hides(box, {}, {3.1, 0.0, 1.0}, {9.0, 0.0, 1.0})) << "begins behind it";
}

} // namespace
} // namespace fernlicht
