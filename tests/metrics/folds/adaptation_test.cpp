// What a dazzled driver's eye is adapted to, on a straight and level road with one even lamp, by hand.
#include "metrics/folds/adaptation.h"

#include "metrics/glare/glare.h"
#include "tests/metrics/folds/asphalt_by_hand.h"
#include "tests/metrics/folds/one_lamp_straight.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

/// The mean over the ten places, 15 to 60 m before the lamp, which is on the bumper; the eye 1.3 m before the rear axle.
double mean_by_hand(double cd, const Drive& drive, double eye_left, double eye_up) {
    double sum = 0.0;
    for (int k = 0; k < 10; ++k)
        sum += asphalt_cdm2(cd, 15.0 + 5.0 * k, 0.0, drive.bumper_m - 1.3, eye_left, eye_up);
    return sum / 10.0;
}

struct Dazzled : OneLampStraight {
    GlareParameters& glare = drive.seeing.glare.emplace();
    explicit Dazzled(double cd = 6000.0) : OneLampStraight(cd, 4.0) { glare.oncoming = {{"eye", 100.0, 1.1}}; }
};

// The oncoming eye stands on its lane's centre, as the lamp of its car does.
TEST(Adaptation, IsTheOncomingDriversOwnLaneInHisOwnBeam) {
    Dazzled straight;
    const SeeingFold fold = straight.played();
    const Readings readings = fold.readings();
    const double by_hand = mean_by_hand(6000.0, straight.drive, 0.0, 1.1);
    EXPECT_GT(by_hand, 0.05);
    EXPECT_NEAR(value(readings, "glare_eye_adaptation_cdm2"), by_hand, 1e-8);
    const SeeingSeries series = fold.series().at(0);
    double most = 0.0, least = 99.0;
    for (std::size_t i = 0; i < series.ticks.size(); ++i) {
        most = std::max(most, 65.0 * series.columns.at(2).values.at(i).number().value() / std::pow(by_hand, 0.8));
        const double d = series.at_m[i], beside = 3.5 * 3.5 + 0.45 * 0.45, square = d * d + beside;
        const GlareSource source{6000.0 * d / std::pow(square, 1.5), degrees(std::atan(std::sqrt(beside) / d))};
        least = std::min(least, de_boer_rating({source}, by_hand).number().value());
        EXPECT_NEAR(series.columns.at(5).values.at(i).number().value(), by_hand, 1e-8);
    }
    EXPECT_EQ(series.columns.at(5).name, "adaptation_cdm2");
    EXPECT_NEAR(value(readings, "glare_eye_threshold_increment_max_percent"), most, 1e-6 * most);
    EXPECT_NEAR(value(readings, "glare_eye_de_boer_min"), least, 1e-8);
    EXPECT_THAT(named(readings, "glare_eye_threshold_increment_max_percent").where,
                HasSubstr(fmt::format("adapted to {:.3g} cd/m2", by_hand)));
    straight.glare.adaptation_cdm2 = 1.0;
    const Readings fixed = straight.played().readings();
    EXPECT_NEAR(value(fixed, "glare_eye_threshold_increment_max_percent"), most * std::pow(by_hand, 0.8), 1e-6 * most);
    EXPECT_EQ(value(fixed, "glare_eye_adaptation_cdm2"), 1.0);
    EXPECT_THAT(named(fixed, "glare_eye_adaptation_cdm2").where, HasSubstr("as the drive says"));
}

TEST(Adaptation, HighBeamsStayOffAndAnotherLampTakesTheLowBeamsPlace) {
    Dazzled straight;
    const double low = value(straight.played().readings(), "glare_eye_adaptation_cdm2");
    LampSet& lamp_set = straight.drive.lamp_sets.front();
    lamp_set.lamps.push_back(lamp_set.lamps.front());
    lamp_set.lamps.back().name = "high-left";
    EXPECT_EQ(value(straight.played().readings(), "glare_eye_adaptation_cdm2"), low);
    lamp_set.changes = {{1.0, "only", 0.0}}; // the own car's goes out, not the dazzled driver's
    EXPECT_EQ(value(straight.played().readings(), "glare_eye_adaptation_cdm2"), low);
    straight.drive.adaptation_lamp = tests::file_of(tests::even_table(12000.0));
    EXPECT_NEAR(value(straight.played().readings(), "glare_eye_adaptation_cdm2"), 2.0 * low, 1e-8);
    straight.drive.adaptation_lamp = tests::file_of(tests::even_table(12000.0, 180.0, 30.0));
    for (MountedLamp& lamp : lamp_set.lamps) { // up and away from the road: as an aim may turn the lamp set's lamps
        lamp.pitch_rad = 1.0;
        lamp.aligned.pitch_rad = 0.5;
        lamp.file = tests::file_of(tests::even_table(6000.0, 180.0, 30.0));
    }
    EXPECT_NEAR(value(straight.played().readings(), "glare_eye_adaptation_cdm2"), 2.0 * low, 1e-8) << "that lamp keeps its own aim";
    straight.drive.adaptation_lamp.reset();
    EXPECT_LT(value(straight.played().readings(), "glare_eye_adaptation_cdm2"), 0.5 * low) << "which would tell";
}

TEST(Adaptation, SkyAndStreetLampsCount) {
    Dazzled straight;
    straight.drive.daylight.horizontal_illuminance_lx = 3.4;
    const double by_hand = mean_by_hand(6000.0, straight.drive, 0.0, 1.1), sky = 0.08 / pi * 3.4;
    EXPECT_NEAR(value(straight.played().readings(), "glare_eye_adaptation_cdm2"), by_hand + sky, 1e-8);
    // One lamp of 500 cd in every direction that it knows, before the observer, who is 600 m away: no lamp of the first moment.
    straight.glare.oncoming = {{"eye", 600.0, 1.1}};
    StreetLampRow& row = straight.drive.street_lamps.emplace_back();
    row.file = tests::file_of(tests::even_table(500.0, 180.0, 90.0));
    row.first_m = row.last_m = 560.0;
    const Moment there = moment_at({0, 0.0, 560.0, 0.0}, straight.drive, straight.route, straight.drive.lamp_sets.front());
    ASSERT_EQ(there.other_lamps.size(), 1U);
    const glm::dvec3 lamp = there.other_lamps[0].pose.position_m;
    const Material road = material_named("asphalt");
    double street = 0.0;
    for (int k = 0; k < 10; ++k) {
        const double along = 600.0 - (straight.drive.bumper_m - 1.3) - 15.0 - 5.0 * k;
        const Pose place = place_on_road(straight.route, Across::oncoming_centre, along).value();
        const Pose eye = place_on_road(straight.route, Across::oncoming_centre, 600.0).value();
        const glm::dvec3 to_lamp = lamp - place.position_m, to_eye = eye.position_m + 1.1 * eye.up() - place.position_m;
        const double square = glm::dot(to_lamp, to_lamp), angle = radians(angle_between_deg(to_lamp, to_eye));
        street += 500.0 / square *
                  (0.08 / pi * to_lamp.z / std::sqrt(square) +
                   static_cast<double>(road.retro_rl) *
                       std::exp((static_cast<double>(road.retro_reference_rad) - angle) / static_cast<double>(road.retro_falloff_rad)));
    }
    EXPECT_GT(street, 0.001);
    EXPECT_NEAR(value(straight.played().readings(), "glare_eye_adaptation_cdm2"), by_hand + sky + street / 10.0, 1e-6);
}

// The driver of the car ahead sits 0.35 m left, 1.2 m up.
TEST(Adaptation, TheDriverAheadHasTheSameCar) {
    Dazzled straight;
    straight.glare.oncoming.clear();
    straight.glare.mirrors = MirrorParameters{};
    straight.glare.mirrors->gaps_m = {15.0};
    const Readings readings = straight.played().readings();
    EXPECT_NEAR(value(readings, "glare_mirrors_at_15m_adaptation_cdm2"), mean_by_hand(6000.0, straight.drive, 0.35, 1.2), 1e-8);
    // Where the route ends less than 60 m before him, moments are left out; where it always does, nothing is measured.
    const double gap = straight.route.length_m() - straight.drive.bumper_m * 2.0 - 60.0 - 20.0;
    straight.glare.mirrors->gaps_m = {gap, gap + 30.0};
    const Readings ends = straight.played().readings();
    const auto of = [&](double at, const char* figure) {
        return named(ends, eye_name({.quantity = Quantity::glare_facing, .place = ReadingPlace::mirrors, .distance_m = at}) + figure);
    };
    EXPECT_THAT(of(gap, "_de_boer_min").where, HasSubstr("left out: the driver's own lane does not go on for 60 m before him)"));
    EXPECT_TRUE(of(gap, "_de_boer_min").value.measured());
    EXPECT_TRUE(of(gap + 30.0, "_veiling_max_cdm2").value.measured());
    for (const char* figure : {"_de_boer_min", "_threshold_increment_max_percent", "_adaptation_cdm2", "_time_above_10percent_s"})
        EXPECT_THAT(of(gap + 30.0, figure).value.reason(), HasSubstr("does not go on for 60 m")) << figure;
}

TEST(Adaptation, IsNotMeasuredOnAShortLaneNorItsIncrementInTheDark) {
    Dazzled straight;
    straight.glare.oncoming = {{"near", 60.0, 1.1}, {"far", 100.0, 1.1}};
    const Readings readings = straight.played().readings();
    EXPECT_TRUE(named(readings, "glare_near_veiling_max_cdm2").value.measured());
    for (const char* figure : {"threshold_increment_max_percent", "de_boer_min", "adaptation_cdm2", "length_below_5_de_boer_m"})
        EXPECT_THAT(named(readings, fmt::format("glare_near_{}", figure)).value.reason(), HasSubstr("does not go on for 60 m")) << figure;
    Dazzled dim(2000.0); // 0.04 cd/m2
    const Readings dark = dim.played().readings();
    EXPECT_LT(value(dark, "glare_eye_adaptation_cdm2"), 0.05);
    EXPECT_TRUE(named(dark, "glare_eye_de_boer_min").value.measured());
    EXPECT_THAT(named(dark, "glare_eye_threshold_increment_max_percent").value.reason(), HasSubstr("is defined above 0.05"));
}

} // namespace
} // namespace fernlicht
