// What a drive asks to see, through the program: lamps of 206.25 cd everywhere within 30 degrees, figures by hand.
#include "metrics/seeing/visibility.h"
#include "tests/runner/program.h"
#include "tests/runner/run_readings.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

std::string drive_with(const std::string& measure) {
    return fmt::format("fernlicht: 1\nname: seen\nroad: {}\nroute: {{s_m: 20}}\nspeed_kmh: 36\nrate_hz: 10\nduration_s: 0.5\n"
                       "lamp_sets:\n  even: {{source: filament, colour: {{linear_srgb: [1, 1, 1], sp_ratio: 1.4}}, file: {}}}\n"
                       "views:\n  driver: {{resolution_px: [32, 24]}}\nmeasure:\n  extent: false\n{}",
                       library_file("roads/straight.xodr"), library_file("lamps/even-0.33lx.csv"), measure);
}

Outcome play(const TemporaryFolder& folder, const std::string& measure) {
    std::ofstream(folder / "drive.yaml") << drive_with(measure);
    return run_program("run " + (folder / "drive.yaml") + " --quiet --no-accuracy --out " + (folder / "out"));
}

// 50 m before the bumper is 50.2 m before the lamps, which stand 0.6 m to either side, 0.65 m up; the driver's eye 1.3 m before the rear
// axle, 0.35 m left, 1.2 m up. The lane is 3.5 m wide and straight.
TEST(SeeingRun, FiguresByHandAtFiftyMetres) {
    const TemporaryFolder folder;
    const Outcome outcome = play(
        folder,
        "  visibility: {targets: {own: {size_m: 0.18, reflectance: 0.5, level: 1}}, distances_m: [50]}\n  homogeneity: {min_lx: 0.001}\n"
        "  places: {what: [kerb, boards, markings], distances_m: [50]}\n");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const auto value = [&](const std::string& name) { return tests::reading_of(folder / "out", name); };
    /// Of both lamps at a point so far beside the lane's centre and so high; on a face towards the lamps' axis where `upright`.
    const auto lit = [](double beside, double up, double normal) {
        double sum = 0.0;
        for (const double lamp : {-0.6, 0.6}) {
            const double square = 50.2 * 50.2 + (beside - lamp) * (beside - lamp) + (up - 0.65) * (up - 0.65);
            sum += 206.25 * normal / std::pow(square, 1.5);
        }
        return sum;
    };
    EXPECT_NEAR(value("kerb_at_50m_lx"), lit(1.75, 0.0, 0.65), 1e-9);
    EXPECT_NEAR(value("board_right_at_50m_lx"), lit(3.75, 2.0, 50.2), 1e-9);
    EXPECT_NEAR(value("board_overhead_at_50m_lx"), lit(0.0, 5.5, 50.2), 1e-9);
    const double background = value("background_luminance_own_at_50m_cdm2"); // behind a place 0.1 m up: the level is told to 1 % by it
    const double sight = std::hypot(52.3, 0.35, 1.11);                       // from the eye to the target's middle
    const double level =
        visibility_level(0.5 * lit(0.0, 0.09, 50.2) / std::acos(-1.0), background, arc_minutes_of(0.18, sight), {25.0, 0.2, 2.6})
            .number()
            .value();
    EXPECT_NEAR(value("visibility_level_own_own_at_50m"), level, 0.01 * level);
    EXPECT_NEAR(value("mesopic_luminance_own_at_50m_cdm2"), mesopic_luminance(background, 1.4).luminance_cdm2, 1e-6 * background);
    EXPECT_GT(value("detection_own_own_m"), 50.0) << "its level there is above 1: " << level;
    EXPECT_EQ(value("patch_dark_own_m"), 0.0) << "even light has no dark patch";
    EXPECT_GT(value("foreground_ratio_own"), 50.0) << "1/d^3 from 10 to 50 m alone is 125";
}

// 0.4 s at 36 km/h are 4 m: 6 m from the route's start the bumper passes, 200 m are far beyond the drive's end.
TEST(SeeingRun, AnApproachCutShortSaysSo) {
    const TemporaryFolder folder;
    const Outcome outcome =
        play(folder, "  sensors:\n    thresholds_lx: [1000]\n    points:\n      far: {at_m: 200, across: right-edge, above_m: 0.25}\n"
                     "      passed: {at_m: 6, across: right-edge, above_m: 0.25}\n"
                     "  glare: {oncoming: {beyond: {at_m: 200, eye_height_m: 1.1}, by: {at_m: 6, eye_height_m: 1.1}}}\n");
    ASSERT_NE(outcome.exit_code, 2) << outcome.output;
    const auto value = [&](const std::string& name) { return tests::reading_of(folder / "out", name); };
    const auto where = [&](const std::string& name) { return tests::field_of(folder / "out", name, "where"); };
    EXPECT_EQ(tests::field_of(folder / "out", "sensor_far_reach_1000lx_m", "bound"), "at_most");
    EXPECT_NEAR(value("sensor_far_reach_1000lx_m"), 190.0, 5.0) << "nearer was not driven";
    EXPECT_THAT(where("sensor_far_max_lx"), HasSubstr("; the drive comes from 1"));
    EXPECT_THAT(where("glare_beyond_facing_max_lx"), HasSubstr("(the drive comes from 1"));
    EXPECT_EQ(value("sensor_passed_reach_1000lx_m"), 0.0);
    EXPECT_THAT(where("sensor_passed_max_lx"), testing::Not(HasSubstr("the drive comes")));
    EXPECT_THAT(where("glare_by_facing_max_lx"), testing::Not(HasSubstr("the drive comes")));
}

TEST(SeeingRun, NobodyAskedNothingStands) {
    const TemporaryFolder folder;
    ASSERT_EQ(play(folder, "  probes: {kerb: {ahead_m: 33.6, left_m: -1.75}}\n").exit_code, 0);
    for (const std::string& name : tests::moments_of(folder / "out/readings.csv", "name"))
        EXPECT_TRUE(name.starts_with("probe_") || name.find("_ms") != std::string::npos || name.find("pictures") != std::string::npos)
            << name;
}

/// Beyond the motorway's crest a wet road bends by more than is modelled: of targets there only the lowest square stands, between whole
/// ones.
TEST(SeeingRun, SquaresThatAWetCrestLeavesOutAreNotFilled) {
    const TemporaryFolder folder;
    std::ofstream(folder / "drive.yaml") << fmt::format(
        "fernlicht: 1\nname: crest\nroad: {}\nroute: {{s_m: 20}}\nspeed_kmh: 120\nrate_hz: 10\nduration_s: 50\nweather: {{wetness: 0.8}}\n"
        "lamp_sets: {{one: {{source: filament, file: {}}}}}\nviews: {{driver: {{resolution_px: [32, 24]}}}}\n"
        "measure: {{visibility: true, extent: false}}\n",
        library_file("roads/motorway.xodr"), library_file("lamps/halogen-low.ies"));
    const Outcome outcome =
        run_program("run " + (folder / "drive.yaml") + " --frames 208:214 --quiet --no-accuracy --out " + (folder / "out"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

TEST(SeeingRun, WrongKeysAreNamed) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& measure) {
        const Outcome outcome = play(folder, measure);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
        return outcome.output;
    };
    EXPECT_THAT(refused("  visibility: {target: [card]}\n"), HasSubstr("targets"));
    EXPECT_THAT(refused("  places: [curb]\n"), HasSubstr("kerb"));
    EXPECT_THAT(refused("  homogeneity: {patch_factor: 1}\n"), HasSubstr("1.01"));
    EXPECT_THAT(refused("  glare: {age_years: 60}\n"), HasSubstr("glare without eyes"));
}

} // namespace
} // namespace fernlicht
