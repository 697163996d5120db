// Fog and a wet road over a drive on the straight: what sensors, eyes, mirrors and targets have of it.
#include "tests/metrics/folds/asphalt_by_hand.h"
#include "tests/metrics/folds/one_lamp_straight.h"

#include "metrics/glare/wet_road.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

constexpr double sigma = 0.03;

TEST(WeatherFold, SensorsAndEyesGetWhatTheFogLeaves) {
    OneLampStraight straight;
    straight.drive.weather.extinction_per_m = sigma;
    straight.drive.seeing.sensors = SensorParameters{{5.0}, {50.0}, {{"edge", 100.0, Across::right_edge, 0.25}}};
    GlareParameters& glare = straight.drive.seeing.glare.emplace();
    glare.oncoming = {{"eye", 100.0, 1.1}};
    glare.mirrors = MirrorParameters{{30.0}, {1.3, 0.35, 1.2}, 0.5, {{"left", {1.9, 0.95, 1.0}}}};
    const Readings readings = straight.played().readings();
    const auto left_lx = [](double square) { return 1000.0 / square * std::exp(-sigma * std::sqrt(square)); };
    EXPECT_NEAR(value(readings, "glare_eye_at_50m_lx"), left_lx(2500.0 + 3.5 * 3.5 + 0.45 * 0.45), 1e-4);
    EXPECT_NEAR(value(readings, "sensor_edge_at_50m_lx"), left_lx(2500.0 + 1.75 * 1.75 + 0.4 * 0.4), 1e-4);
    EXPECT_NEAR(value(readings, "mirror_left_at_30m_lx"), left_lx(31.9 * 31.9 + 0.95 * 0.95 + 0.35 * 0.35), 1e-9);
}

TEST(WeatherFold, AWetRoadShinesIntoEyesMirrorsAndSensors) {
    OneLampStraight straight(6000.0, 8.0);
    straight.drive.seeing.sensors = SensorParameters{{5.0}, {50.0}, {{"high", 100.0, Across::oncoming_centre, 1.1}}};
    GlareParameters& glare = straight.drive.seeing.glare.emplace();
    glare.oncoming = {{"eye", 100.0, 1.1}};
    glare.mirrors = MirrorParameters{{30.0}, {1.3, 0.35, 1.2}, 0.5, {{"left", {1.9, 0.95, 1.0}}}};
    const Readings dry = straight.played().readings();
    straight.drive.weather.wetness = 0.5;
    const SeeingFold fold = straight.played();
    const Readings wet = fold.readings();
    const Moment moment = moment_at(start(straight.drive), straight.drive, straight.route, straight.drive.lamp_sets.front());
    const Pose place = place_on_road(straight.route, Across::oncoming_centre, 100.0).value();
    const glm::dvec3 eye = place.position_m + 1.1 * place.up();
    const RoadPlane level{moment.ego.position_m, {0.0, 0.0, 1.0}, 0.0};
    const double film = facing_lx(lamps_in_road(moment.lamps, moment.weather, level, eye)), direct = facing_lx(seen_lamps(moment, eye));
    EXPECT_GT(film, 0.005 * direct);
    for (const SeeingSeries& series : fold.series()) // of the first moment, 96.4 m away: the sensor faces as the eye does
        if (series.subject == "glare_eye" || series.subject == "sensor_high") {
            EXPECT_NEAR(series.columns.at(0).values.front().number().value(), direct + film, 1e-9) << series.subject;
        }
    EXPECT_GT(value(wet, "glare_eye_veiling_from_30_to_60m_max_cdm2"), value(dry, "glare_eye_veiling_from_30_to_60m_max_cdm2"));
    EXPECT_GT(value(wet, "mirror_left_at_30m_lx"), 1.001 * value(dry, "mirror_left_at_30m_lx"));
    EXPECT_LT(value(wet, "glare_eye_adaptation_cdm2"), 0.6 * value(dry, "glare_eye_adaptation_cdm2")) << "half of R_L is gone";
}

TEST(WeatherFold, KerbBoardsAndMarkingsInFogAndRain) {
    OneLampStraight straight(20000.0, 1.0);
    straight.drive.seeing.places = PlaceParameters{true, true, true, {50.0}};
    const Readings dry = straight.played().readings();
    straight.drive.weather.wetness = 1.0;
    const Readings wet = straight.played().readings();
    EXPECT_EQ(value(wet, "kerb_at_50m_lx"), value(dry, "kerb_at_50m_lx"));
    EXPECT_GT(value(wet, "kerb_target_at_50m_lx"), 1.01 * value(dry, "kerb_target_at_50m_lx"));
    EXPECT_GT(value(wet, "board_right_at_50m_lx"), 1.001 * value(dry, "board_right_at_50m_lx"));
    EXPECT_LT(value(wet, "marking_right_at_50m_cdm2"), 0.1 * value(dry, "marking_right_at_50m_cdm2"));
    straight.drive.weather = {.extinction_per_m = sigma, .scattering_albedo = 0.0}; // soot: takes and adds nothing
    const Readings soot = straight.played().readings();
    const auto lost = [&](const char* name) { return value(soot, name) / value(dry, name); };
    EXPECT_NEAR(lost("kerb_target_at_50m_lx"), std::exp(-sigma * std::sqrt(2500.0 + 1.75 * 1.75 + 0.4 * 0.4)), 1e-9);
    const double to_board = std::sqrt(2500.0 + 3.75 * 3.75 + 1.35 * 1.35), eye_back = 50.0 + straight.drive.bumper_m - 1.3;
    EXPECT_NEAR(lost("board_right_at_50m_cdm2"), std::exp(-sigma * (to_board + std::sqrt(eye_back * eye_back + 4.1 * 4.1 + 0.8 * 0.8))),
                1e-9);
    straight.drive.weather.scattering_albedo = 1.0;
    EXPECT_GT(value(straight.played().readings(), "marking_right_at_50m_cdm2"), value(soot, "marking_right_at_50m_cdm2"));
}

// The grey card at 50 m as in clear air (visibility_fold_test.cpp): lamp to card and road, both to the eye, light in the air before them.
TEST(WeatherFold, ATargetsContrastFadesWithTheAir) {
    OneLampStraight straight(20000.0, 1.0);
    VisibilityParameters asked;
    asked.targets = {{"grey", 0.2, 1, 0.9, 0.3}};
    asked.distances_m = {50.0};
    straight.drive.seeing.visibility = asked;
    straight.drive.weather.extinction_per_m = sigma;
    const Readings readings = straight.played().readings();
    const Moment moment = moment_at(start(straight.drive), straight.drive, straight.route, straight.drive.lamp_sets.front());
    const double eye_back = straight.drive.bumper_m - 1.3, times = 1.2 / 1.1, behind = (50.0 + eye_back) * times - eye_back,
                 left = 0.35 * (1.0 - times);
    const glm::dvec3 eye = to_parent(moment.ego, {1.3, 0.35, 1.2}),
                     card = to_parent(moment.ego, {straight.drive.bumper_m + 50.0, 0.0, 0.1}),
                     road = to_parent(moment.ego, {straight.drive.bumper_m + behind, left, 0.0});
    const auto air = [&](const glm::dvec3& to) { return airlight_cdm2(moment.lamps[0], moment.weather, eye, to, 32); };
    const auto leaves = [](double metres) { return std::exp(-sigma * metres); };
    const double from_lamp = std::sqrt(2500.0 + 0.55 * 0.55), to_road = std::sqrt(behind * behind + left * left + 0.65 * 0.65);
    const double target = 0.9 / pi * 20000.0 * 50.0 / std::pow(from_lamp, 3) * leaves(from_lamp + glm::distance(eye, card)) + air(card);
    const double background = asphalt_cdm2(20000.0, behind, left, eye_back) * leaves(to_road + glm::distance(eye, road)) + air(road);
    EXPECT_GT(air(road), 0.3 * background) << "much of what is seen is the air's";
    EXPECT_NEAR(value(readings, "background_luminance_own_at_50m_cdm2"), background, 1e-6 * background);
    const double level =
        visibility_level(target, background, arc_minutes_of(0.2, glm::distance(eye, card)), {25.0, 0.2, 2.6}).number().value();
    EXPECT_NEAR(value(readings, "visibility_level_grey_own_at_50m"), level, 1e-6 * level);
}

// Along the lane the light in the air is integrated at every tenth of the way and interpolated: the detection is where the level, at a
// place of its own exact, has the target's.
TEST(WeatherFold, DetectionInFogIsWhereTheLevelIsReached) {
    OneLampStraight straight(20000.0, 0.15);
    for (const Weather& weather : {Weather{.extinction_per_m = sigma}, Weather{.extinction_per_m = 0.002, .wetness = 1.0}}) {
        VisibilityParameters asked;
        asked.targets = {{"t", 0.2, 1, 0.5, 20.0}, {"person", 0.25, 4, 0.4, 10.0, {Across::right_edge}}};
        asked.distances_m = {};
        straight.drive.weather = {};
        straight.drive.seeing.visibility = asked;
        const double clear_m = value(straight.played().readings(), "detection_t_own_m");
        straight.drive.weather = weather;
        const Readings found = straight.played().readings();
        if (weather.wetness == 0.0) {
            EXPECT_LT(value(found, "detection_t_own_m"), clear_m);
        }
        for (const auto& [name, stand, wanted] : {std::tuple("t", "own", 20.0), std::tuple("person", "right", 10.0)}) {
            const double from_m = value(found, fmt::format("detection_{}_{}_m", name, stand));
            asked.distances_m = {from_m - 0.5, from_m + 0.5};
            straight.drive.seeing.visibility = asked;
            const Readings around = straight.played().readings();
            EXPECT_GT(value(around, fmt::format("visibility_level_{}_{}_at_{}m", name, stand, from_m - 0.5)), wanted);
            EXPECT_LT(value(around, fmt::format("visibility_level_{}_{}_at_{}m", name, stand, from_m + 0.5)), wanted);
        }
    }
}

} // namespace
} // namespace fernlicht
