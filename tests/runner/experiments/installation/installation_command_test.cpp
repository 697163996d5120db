// A car on a circle whose lamps turn by a known angle, and loads on known springs.
#include "runner/experiments/installation/installation_run.h"

#include "tests/runner/program.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// 19 m/s along the outer lane of a left bend of 230 m.
std::string bend_drive(const TemporaryFolder& folder, const std::string& more, const std::string& lamp = "aim: auto",
                       const std::string& road = library_file("roads/adb-left-230.xodr"), int lane = -1) {
    std::ofstream(folder / "bend.yaml") << fmt::format("fernlicht: 1\nname: bend\ntitle: bend\nroad: {}\nroute: {{s_m: 40, lane: {}}}\n"
                                                       "speed_kmh: 68.4\nrate_hz: 10\nduration_s: 9\nvehicle: single-track\n"
                                                       "lamp_sets: {{low: {{file: {}, {}}}}}\n{}",
                                                       road, lane, library_file("lamps/halogen-low.ies"), lamp, more);
    return folder / "bend.yaml";
}

/// Where a ray from a lamp 3.4 m before the rear axle, turned inwards, leaves the circle of the centre of gravity, from the bumper. The
/// rear axle runs along the lane's centre; its tyres slip outwards, so that the car's axis looks into the bend by as much.
double crossing_m(double turned_rad) {
    const double radius_m = 231.85, gravity_m = 2.7 * 0.55, lamp_m = 3.4, bumper_m = 3.6;
    const double slip_rad = 1500.0 * 0.45 * 19.0 * 19.0 / radius_m / 110'000.0;
    const double b = radius_m * std::sin(turned_rad + slip_rad) - lamp_m * std::cos(turned_rad);
    const double c = lamp_m * lamp_m - gravity_m * gravity_m - 2.0 * (lamp_m - gravity_m) * radius_m * std::sin(slip_rad);
    const double way_m = b + std::sqrt(b * b - c);
    return std::hypot(lamp_m + way_m * std::cos(turned_rad) - bumper_m, way_m * std::sin(turned_rad));
}

json found_in(const std::string& arguments, int exit_code) {
    return json::parse(printed("installation " + arguments + " --json", exit_code));
}

TEST(InstallationCommand, TheKinkOfASteadyBendCrossesWhereGeometryPutsIt) {
    const TemporaryFolder folder;
    // Curvature times the way of 1.5 s, halved: 3.52 degrees.
    const json found = found_in(bend_drive(folder, "actuators: {levelling: static, swivel: {preview_s: 1.5}}\n"), 0);
    const double turned_rad = 0.5 * 19.0 * 1.5 / 231.85;
    EXPECT_EQ(found.at("kink"), "within");
    EXPECT_EQ(found.at("inclination"), "within");
    for (const json& lamp : found.at("lamps")) {
        const json& kink = lamp.at("kink");
        EXPECT_EQ(kink.at("at_most_m"), 65.0);
        EXPECT_NEAR(kink.at("left_bends").at("median_m").get<double>(), crossing_m(turned_rad), 0.9)
            << "27 m, where a tenth of a degree is 0.8 m";
        EXPECT_EQ(kink.at("left_bends").at("beyond_s"), 0.0);
        EXPECT_EQ(kink.at("right_bends").at("verdict"), "not_applicable");
        EXPECT_EQ(kink.at("right_bends").at("why_not"), "no such bend while the lamp is lit");
    }
}

TEST(InstallationCommand, ABeamThatTurnsTooFarBreaksTheRule) {
    const TemporaryFolder folder;
    // To the stop at 15 degrees: 120 m and more, where 65 are allowed.
    const json found = found_in(bend_drive(folder, "actuators: {levelling: static, swivel: {preview_s: 9}}\n"), 1);
    EXPECT_EQ(found.at("kink"), "not_met");
    const json& kink = found.at("lamps").at(0).at("kink").at("left_bends");
    EXPECT_NEAR(kink.at("median_m").get<double>(), crossing_m(0.262), 0.5);
    EXPECT_GT(kink.at("beyond_s").get<double>(), 7.0);
    EXPECT_THAT(printed("installation " + (folder / "bend.yaml"), 1),
                AllOf(HasSubstr("no approval"), ContainsRegex("\nkink +not met\n"), HasSubstr("not applicable: no such bend")));
}

TEST(InstallationCommand, LoadsLiftTheCutOffByWhatLevellingDoesNotSee) {
    const TemporaryFolder folder;
    const std::string drive = bend_drive(folder, "actuators: {levelling: static}\n");
    const json found = found_in(drive, 0);
    EXPECT_EQ(found.at("kink"), "not_applicable");
    const json& loads = found.at("lamps").at(0).at("inclination");
    ASSERT_EQ(loads.size(), 5u);
    EXPECT_NEAR(loads.at(0).at("percent").get<double>(), -1.0, 1e-6);
    const double tyres_rad = 9.81 * (425.0 + 54.839) / 400'000.0 / 2.7;
    EXPECT_NEAR(loads.at(4).at("percent").get<double>(), 100.0 * std::tan(std::atan(-0.01) + tyres_rad), 1e-4);
    // 100 kg over the rear axle and no levelling: all of it, 0.54 degrees.
    // The lamps are aimed without any load, the first one given included.
    const json given = found_in(bend_drive(folder, "") + " --load 'behind=0,100'", 1);
    const double all_rad = 981.0 * (1.0 / 43'000.0 + 1.0 / 400'000.0) / 2.7;
    const json& behind = given.at("lamps").at(0).at("inclination").at(0);
    EXPECT_NEAR(behind.at("percent").get<double>(), 100.0 * std::tan(std::atan(-0.01) + all_rad), 1e-4);
    EXPECT_EQ(behind.at("verdict"), "not_met");
    EXPECT_EQ(behind.at("load"), "behind");
    EXPECT_THAT(printed("installation --help"), Not(HasSubstr("initial aim")));
}

/// Road, lane and lamps mirrored.
TEST(InstallationCommand, LeftHandTrafficIsTheMirrorImage) {
    const TemporaryFolder folder;
    const std::string turning = "actuators: {levelling: static, swivel: {preview_s: 1.5}}\n";
    std::string road = content_of(library_file("roads/adb-left-230.xodr"));
    for (const auto& [there, here] : {std::pair<std::string, std::string>{"RHT", "LHT"},
                                      {"curvature=\"0.004", "curvature=\"-0.004"},
                                      {"y=\"114", "y=\"-114"},
                                      {"hdg=\"1.04", "hdg=\"-1.04"}})
        road.replace(road.find(there), there.size(), here);
    std::ofstream(folder / "mirrored.xodr") << road;
    const json right_hand = found_in(bend_drive(folder, turning), 0);
    const json left_hand = found_in(bend_drive(folder, turning, "aim: auto, mirrored: true", folder / "mirrored.xodr", 1), 0);
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        const json &lamp = right_hand.at("lamps").at(i), &mirror = left_hand.at("lamps").at(1 - i);
        const json &kink = lamp.at("kink").at("left_bends"), &other = mirror.at("kink").at("right_bends");
        EXPECT_EQ(mirror.at("by"), "kink");
        EXPECT_NEAR(mirror.at("inclination").at(4).at("percent").get<double>(), lamp.at("inclination").at(4).at("percent").get<double>(),
                    1e-3);
        EXPECT_NEAR(other.at("median_m").get<double>(), kink.at("median_m").get<double>(), 0.01);
        EXPECT_EQ(other.contains("from_lamp_m"), kink.contains("from_lamp_m"));
        EXPECT_EQ(mirror.at("kink").at("left_bends").at("verdict"), "not_applicable");
    }
}

/// The left lamp's mount is rolled by 5 degrees, its left side up: a kink to its right sinks.
TEST(InstallationCommand, ARolledMountTurnsTheKinkAboutTheLampsAxis) {
    const TemporaryFolder folder;
    const std::string more = "car: {mounts: {left: {position_m: [3.4, 0.6, 0.65], roll_deg: 5}, right: [3.4, -0.6, 0.65]}}\n"
                             "actuators: {levelling: static}\n";
    const auto percent = [](const json& found, std::size_t lamp) {
        return found.at("lamps").at(lamp).at("inclination").at(0).at("percent").get<double>();
    };
    const json turned = found_in(bend_drive(folder, more, "aim: {yaw_deg: -3}"), 0);
    const double up = std::atan(percent(turned, 1) / 100.0), right = 3.0 * 0.0174532925, roll = 5.0 * 0.0174532925;
    const double x = std::cos(up) * std::cos(right), y = -std::cos(up) * std::sin(right), z = std::sin(up);
    const double level = y * std::cos(roll) - z * std::sin(roll), height = y * std::sin(roll) + z * std::cos(roll);
    EXPECT_NEAR(percent(turned, 0), 100.0 * height / std::hypot(x, level), 0.01);
    EXPECT_LT(percent(turned, 0), percent(turned, 1) - 0.4);
    const json aimed = found_in(bend_drive(folder, more), 0);
    EXPECT_NEAR(percent(aimed, 0), -1.0, 1e-6) << "`aim: auto` takes the roll into account";
}

TEST(InstallationCommand, SaysWhatIsAssumedAndRefusesWhatIsNoLoad) {
    const TemporaryFolder folder;
    const std::string said = printed("installation " + library_file("drives/iihs-straight.yaml"), 1);
    EXPECT_THAT(said, HasSubstr("our middle-class car stands in"));
    EXPECT_THAT(said, HasSubstr("assumed: persons of 75 kg"));
    EXPECT_THAT(printed("installation " + bend_drive(folder, "car: {mounts: {left: [3.4, 0.6, 1.3], right: [3.4, -0.6, 0.65]}}\n"
                                                             "actuators: {levelling: static}\n"),
                        1),
                ContainsRegex("\ninclination +not measured: left: it is mounted 1.30 m over the road, and R48 allows"));
    for (const char* load : {"boot", "boot=1", "=1,2", "boot=1,2,3", "boot=1;2", "boot=1,1e9", "boot=-9000,0", "boot=nan,0", "boot=0,inf"})
        EXPECT_THAT(run_program("installation " + bend_drive(folder, "") + " --load '" + load + "'").output,
                    HasSubstr("NAME=KG_ON_FRONT_AXLE,KG_ON_REAR_AXLE"))
            << load;
    EXPECT_THAT(printed("installation " + bend_drive(folder, "") + " --load boot=-900,0", 2),
                HasSubstr("--load: found -900 kg on the front axle ('boot'), expected more than -825 kg, which the car has there"));
}

TEST(InstallationCommand, TheDrivesOwnLoadAndLampsForTheOtherSideAreTold) {
    const TemporaryFolder folder;
    const json found = found_in(bend_drive(folder, "control: {load: {rear_kg: 100}}\n"), 1);
    EXPECT_TRUE(found.at("warnings").empty());
    ASSERT_EQ(found.at("loads").size(), 6U);
    EXPECT_EQ(found.at("loads").at(5).at("name"), "the drive's own load");
    EXPECT_NEAR(found.at("loads").at(5).at("rear_kg").get<double>(), 100.0, 1e-9);
    const json given = found_in((folder / "bend.yaml") + " --load behind=0,100", 1);
    ASSERT_EQ(given.at("loads").size(), 1U);
    const auto percent = [](const json& of, std::size_t load) {
        return of.at("lamps").at(0).at("inclination").at(load).at("percent").get<double>();
    };
    EXPECT_NEAR(percent(given, 0), percent(found, 5), 1e-9);
    const json other_side = found_in(bend_drive(folder, "", "mirrored: true"), 1);
    ASSERT_EQ(other_side.at("warnings").size(), 1U);
    EXPECT_THAT(other_side.at("warnings").at(0).get<std::string>(), HasSubstr("readings with it are meaningless"));
    EXPECT_THAT(printed("installation " + (folder / "bend.yaml"), 1), ContainsRegex("\nwarning +lamp file halogen-low.ies"));
}

} // namespace
} // namespace fernlicht
