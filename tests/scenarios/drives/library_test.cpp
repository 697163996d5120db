// The example and the shipped drives: each can be read, has its road, and keeps enough of it ahead for what it measures.
#include "scenarios/drives/play/advance.h"
#include "tests/shipped.h"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <set>
#include <tuple>

namespace fernlicht {
namespace {

class Shipped : public testing::TestWithParam<std::string> {};

TEST_P(Shipped, ReadsAndFitsItsRoad) {
    Drive drive = read_drive(shipped_drives / (GetParam() + ".yaml"));
    EXPECT_EQ(drive.name, GetParam() + "-1");
    ASSERT_EQ(drive.lamp_sets.size(), 2U);
    EXPECT_EQ(drive.lamp_sets[0].name, "halogen");
    EXPECT_EQ(drive.lamp_sets[1].name, "xenon");
    EXPECT_EQ(drive.lamp_sets[1].lamps[0].source, SourceKind::arc);
    EXPECT_EQ(std::tuple(drive.views[0].width_px, drive.views[0].height_px), std::tuple(1024, 768));
    ASSERT_TRUE(drive.extent);
    EXPECT_THAT(drive.extent->thresholds_lx, testing::ElementsAre(1.0, 3.0, 5.0, 10.0));

    const RoadNetwork network = read_opendrive(drive.road_file);
    const Route route(network, drive.start, drive.via);
    const double end_m = distance_m(drive.speed, (tick_count(drive) - 1) * drive.step_s);
    EXPECT_LE(end_m + drive.bumper_m + drive.extent->ahead_m, route.length_m()) << "the last moment must see as far as the first";
    fit_to_route(drive, route);
    EXPECT_TRUE(drive.notes.empty());
    const Moment moment = moment_at(start(drive), drive, route, drive.lamp_sets[0]);
    EXPECT_GT(moment.lamps[0].intensity_factor, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Drives, Shipped,
                         testing::Values("bench", "straight", "s-bend", "country", "motorway", "village", "first-light", "iihs-straight",
                                         "iihs-left-150", "iihs-right-150", "iihs-left-250", "iihs-right-250"),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::erase(name, '-');
                             return name;
                         });

TEST(ShippedDrives, AreAllTested) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(shipped_drives))
        names.insert(entry.path().stem().string());
    // The worked example is not a route: the runner's tests play it and hold it to its own limits. Braking, bend light, glare-free and
    // adaptive beams are tested with their motion, the storyboard where the runner's tests play it.
    EXPECT_THAT(names,
                testing::ElementsAre("adaptive-crest", "adaptive-motorway", "adaptive-village", "bench", "braking", "country", "dusk",
                                     "first-light", "fog", "glare-free", "iihs-left-150", "iihs-left-250", "iihs-right-150",
                                     "iihs-right-250", "iihs-straight", "motorway", "oncoming", "rough-road", "s-bend", "s-bend-alc",
                                     "s-bend-can", "s-bend-story", "shelter", "straight", "village", "village-lit", "worked-example"));
}

TEST(ShippedDrives, TheIihsSensorsStandInTheBend) {
    for (const auto& [name, radius_m] :
         {std::pair("iihs-straight", 0.0), std::pair("iihs-left-150", 150.0), std::pair("iihs-right-150", -150.0),
          std::pair("iihs-left-250", 250.0), std::pair("iihs-right-250", -250.0)}) {
        const Drive drive = read_drive(shipped_drives / (std::string(name) + ".yaml"));
        const RoadNetwork network = read_opendrive(drive.road_file);
        const Route route(network, drive.start, drive.via);
        ASSERT_TRUE(drive.seeing.sensors && drive.seeing.glare);
        ASSERT_EQ(drive.seeing.sensors->points.size(), 2U);
        EXPECT_EQ(drive.seeing.sensors->thresholds_lx, std::vector<double>{5.0});
        const double at_m = drive.seeing.glare->oncoming.at(0).at_m;
        EXPECT_EQ(drive.seeing.glare->oncoming[0].eye_height_m, 1.1);
        for (const Sensor& sensor : drive.seeing.sensors->points) {
            EXPECT_EQ(std::tuple(sensor.at_m, sensor.above_m), std::tuple(at_m, 0.25));
        }
        const glm::dvec3 before = route.pose(at_m - 30.0).forward(), after = route.pose(at_m + 10.0).forward();
        const double turn_rad = std::asin(before.x * after.y - before.y * after.x);
        // The own lane's centre runs 1.75 m to the right of the reference line.
        EXPECT_NEAR(turn_rad, radius_m == 0.0 ? 0.0 : 40.0 / (radius_m + 1.75), 1e-4) << name;
        const double last_m = distance_m(drive.speed, (tick_count(drive) - 1) * drive.step_s) + drive.bumper_m;
        EXPECT_LT(last_m, at_m) << "ends before the sensors";
        EXPECT_GT(last_m, at_m - 10.0);
    }
}

TEST(ShippedDrives, FirstLightDipsAfterThreeSecondsOfHighBeam) {
    const Drive drive = read_drive(shipped_drives / "first-light.yaml");
    EXPECT_EQ(tick_count(drive), 360);
    const RoadNetwork network = read_opendrive(drive.road_file);
    const Route route(network, drive.start, drive.via);
    State state = start(drive);
    for (int tick = 0; tick < 360; ++tick, state = advance(state, drive))
        for (const LampSet& lamp_set : drive.lamp_sets)
            for (const LitLamp& lamp : moment_at(state, drive, route, lamp_set).lamps) {
                const bool high = lamp.name.starts_with("high");
                EXPECT_EQ(lamp.intensity_factor, high && (tick < 150 || tick >= 240) ? 0.0 : 1.0)
                    << lamp_set.name << ' ' << lamp.name << ' ' << tick;
            }
}

TEST(DriveExample, EveryKeyIsRead) {
    const std::filesystem::path file = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/drive.example.yaml";
    const Drive drive = read_drive(file);
    EXPECT_EQ(drive.name, "example-1");
    ASSERT_EQ(drive.lamp_sets.size(), 2U);
    EXPECT_EQ(drive.lamp_sets[0].lamps.size(), 4U);
    EXPECT_EQ(drive.lamp_sets[0].changes.size(), 4U);
    EXPECT_EQ(drive.lamp_sets[1].changes.size(), 5U);
    EXPECT_EQ(drive.views.size(), 3U);
    EXPECT_EQ(drive.speed.size(), 3U);
    EXPECT_EQ(drive.probes.size(), 1U);
    EXPECT_EQ(drive.limits.size(), 1U);
}

} // namespace
} // namespace fernlicht
