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
using testing::HasSubstr;

/// 19 m/s along the outer lane of a left bend of 230 m.
std::string bend_drive(const TemporaryFolder& folder, const std::string& more) {
    std::ofstream(folder / "bend.yaml") << fmt::format("fernlicht: 1\nname: bend\ntitle: bend\nroad: {}\nroute: {{s_m: 40, lane: -1}}\n"
                                                       "speed_kmh: 68.4\nrate_hz: 10\nduration_s: 9\nvehicle: single-track\n"
                                                       "lamp_sets: {{low: {{file: {}, aim: auto}}}}\n{}",
                                                       library_file("roads/adb-left-230.xodr"), library_file("lamps/halogen-low.ies"),
                                                       more);
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
        EXPECT_EQ(kink.at("right_bends").at("verdict"), "within") << "there is none";
    }
}

TEST(InstallationCommand, ABeamThatTurnsTooFarBreaksTheRule) {
    const TemporaryFolder folder;
    // To the stop at 15 degrees: 120 m and more, where 65 are allowed.
    const json found = found_in(bend_drive(folder, "actuators: {levelling: static, swivel: {preview_s: 9}}\n"), 1);
    EXPECT_EQ(found.at("kink"), "broken");
    const json& kink = found.at("lamps").at(0).at("kink").at("left_bends");
    EXPECT_NEAR(kink.at("median_m").get<double>(), crossing_m(0.262), 0.5);
    EXPECT_GT(kink.at("beyond_s").get<double>(), 7.0);
    EXPECT_THAT(printed("installation " + (folder / "bend.yaml"), 1), HasSubstr("no approval"));
}

TEST(InstallationCommand, LoadsLiftTheCutOffByWhatLevellingDoesNotSee) {
    const TemporaryFolder folder;
    const std::string drive = bend_drive(folder, "actuators: {levelling: static}\n");
    const json found = found_in(drive, 0);
    EXPECT_EQ(found.at("kink"), "not_asked");
    const json& loads = found.at("lamps").at(0).at("inclination");
    ASSERT_EQ(loads.size(), 5u);
    EXPECT_NEAR(loads.at(0).at("percent").get<double>(), -1.0, 1e-6);
    const double tyres_rad = 9.81 * (425.0 + 54.839) / 400'000.0 / 2.7;
    EXPECT_NEAR(loads.at(4).at("percent").get<double>(), 100.0 * std::tan(std::atan(-0.01) + tyres_rad), 1e-4);
    // 100 kg over the rear axle and no levelling: all of it, 0.54 degrees.
    const json given = found_in(bend_drive(folder, "") + " --load 'as aimed=0,0' --load 'behind=0,100'", 1);
    const double all_rad = 981.0 * (1.0 / 43'000.0 + 1.0 / 400'000.0) / 2.7;
    const json& behind = given.at("lamps").at(0).at("inclination").at(1);
    EXPECT_NEAR(behind.at("percent").get<double>(), 100.0 * std::tan(std::atan(-0.01) + all_rad), 1e-4);
    EXPECT_EQ(behind.at("verdict"), "broken");
    EXPECT_EQ(behind.at("load"), "behind");
}

TEST(InstallationCommand, SaysWhatIsAssumedAndRefusesWhatIsNoLoad) {
    const TemporaryFolder folder;
    const std::string said = printed("installation " + library_file("drives/iihs-straight.yaml"), 1);
    EXPECT_THAT(said, HasSubstr("our middle-class car stands in"));
    EXPECT_THAT(said, HasSubstr("assumed: persons of 75 kg"));
    for (const char* load : {"boot", "boot=1", "=1,2", "boot=1,2,3", "boot=1;2", "boot=1,1e9"})
        EXPECT_THAT(run_program("installation " + bend_drive(folder, "") + " --load '" + load + "'").output,
                    HasSubstr("NAME=KG_ON_FRONT_AXLE,KG_ON_REAR_AXLE"))
            << load;
}

} // namespace
} // namespace fernlicht
