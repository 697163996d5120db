// Axes of studies by hand: what points there are, what they do to a drive, what is refused.
#include "scenarios/control/control_parameters.h"
#include "scenarios/studies/axes_on_drive.h"
#include "scenarios/studies/sobol.h"
#include "scenarios/studies/study.h"
#include "scenarios/values/pose.h"
#include "tests/shipped.h"
#include "tests/trial.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <set>

namespace fernlicht {
namespace {

using testing::AllOf, testing::ElementsAre, testing::HasSubstr;

class StudyAxes : public testing::Test {
  protected:
    static std::string with(const std::string& more, const std::string& drive = "straight.yaml") {
        return fmt::format("fernlicht_study: 1\nlamps:\n  a: {{low: {0}/lamps/halogen-low.ies}}\n  b: {{low: {0}/lamps/xenon-low.ies, "
                           "source: arc}}\ndrives: [{0}/drives/{2}]\n{1}",
                           shipped_library.string(), more, drive);
    }
    static Study read(const std::string& more, const std::string& drive = "straight.yaml") {
        return read_study(tests::written("study.yaml", with(more, drive)));
    }
    static std::string refusal(const std::string& more, const std::string& drive = "straight.yaml") {
        return tests::refusal_of([&] {
            const Study study = read(more, drive);
            for (const StudyCell& cell : cells_of(study))
                cell_drive(study, cell);
        });
    }
    /// Of the first lamp at a point.
    static Drive at(const Study& study, std::size_t point) {
        StudyCell cell = cells_of(study).front();
        cell.point = point;
        return cell_drive(study, cell);
    }
};

TEST_F(StudyAxes, EveryCombinationIsPlayedAndLampsLieSideBySide) {
    const Study study = read("axes: {weather.wetness: [0, 1], mount_height_m: {from: 0.5, to: 0.8, count: 3}}\n");
    const std::vector<StudyCell> cells = cells_of(study);
    ASSERT_EQ(cells.size(), 2U * 3U * 2U);
    EXPECT_THAT(study.points, ElementsAre(ElementsAre("0", "0.5"), ElementsAre("0", "0.65"), ElementsAre("0", "0.8"),
                                          ElementsAre("1", "0.5"), ElementsAre("1", "0.65"), ElementsAre("1", "0.8")));
    EXPECT_EQ(cells[0].name, "straight_a_p01");
    EXPECT_EQ(cells[1].name, "straight_b_p01");
    EXPECT_EQ(cells[11].name, "straight_b_p06");
    EXPECT_EQ(cells[11].condition, "night, weather.wetness 1, mount_height_m 0.8");
    EXPECT_THAT(cells[11].axes, ElementsAre(AxisValue{"weather.wetness", "1"}, AxisValue{"mount_height_m", "0.8"}));
    const Drive drive = cell_drive(study, cells[11]);
    EXPECT_EQ(drive.weather.wetness, 1.0);
    EXPECT_EQ(drive.lamp_sets[0].name, "b_p06");
    for (const MountedLamp& lamp : drive.lamp_sets[0].lamps)
        EXPECT_EQ(lamp.position_m.z, 0.8) << lamp.name;
    EXPECT_EQ(cell_drive(study, cells[0]).weather.wetness, 0.0);
}

TEST_F(StudyAxes, AnAxisOfOneValueIsNoPartOfACondition) {
    const Study study = read("axes: {rate_hz: [1], mount_height_m: [0.6, 0.7]}\n");
    EXPECT_EQ(cells_of(study).back().condition, "night, mount_height_m 0.7");
    EXPECT_THAT(cells_of(study).back().axes, ElementsAre(AxisValue{"rate_hz", "1"}, AxisValue{"mount_height_m", "0.7"}))
        << "tables have it";
    EXPECT_EQ(cells_of(read("axes: {rate_hz: [1]}\n")).front().condition, "night");
}

TEST_F(StudyAxes, WithoutAxesNothingIsNamedByPoints) {
    const Study study = read("");
    EXPECT_EQ(cells_of(study).front().name, "straight_a");
    EXPECT_EQ(cells_of(study).front().condition, "night");
    EXPECT_TRUE(cells_of(study).front().axes.empty());
}

TEST_F(StudyAxes, EachAloneLeavesTheOthersAsTheDriveHasThem) {
    const Study study =
        read("axes: {weather.fog.visibility_m: [200, 400], speed_kmh: {from: 50, to: 110, step: 30}}\nsample: one_at_a_time\n");
    EXPECT_THAT(study.points, ElementsAre(ElementsAre("", ""), ElementsAre("200", ""), ElementsAre("400", ""), ElementsAre("", "50"),
                                          ElementsAre("", "80"), ElementsAre("", "110")));
    EXPECT_EQ(cells_of(study)[0].condition, "night, base");
    const Drive own = cell_drive(read(""), cells_of(read("")).front());
    EXPECT_EQ(at(study, 0).weather, own.weather);
    EXPECT_EQ(at(study, 0).speed, own.speed);
    EXPECT_NEAR(at(study, 1).weather.extinction_per_m, std::log(1.0 / 0.05) / 200.0, 1e-12); // Koschmieder
    EXPECT_EQ(at(study, 1).speed, own.speed);
    ASSERT_EQ(at(study, 5).speed.size(), 1U);
    EXPECT_DOUBLE_EQ(at(study, 5).speed[0].speed_mps, 110.0 / 3.6) << "in place of the drive's own speed";
    EXPECT_EQ(at(study, 5).weather, own.weather);
}

/// The first ten points in three dimensions as Joe and Kuo's program prints them from new-joe-kuo-6.
TEST_F(StudyAxes, SobolsPointsAreThePublishedOnes) {
    EXPECT_THAT(sobol_points(10, 3),
                ElementsAre(ElementsAre(0, 0, 0), ElementsAre(0.5, 0.5, 0.5), ElementsAre(0.75, 0.25, 0.25), ElementsAre(0.25, 0.75, 0.75),
                            ElementsAre(0.375, 0.375, 0.625), ElementsAre(0.875, 0.875, 0.125), ElementsAre(0.625, 0.125, 0.875),
                            ElementsAre(0.125, 0.625, 0.375), ElementsAre(0.1875, 0.3125, 0.9375), ElementsAre(0.6875, 0.8125, 0.4375)));
    // Point 63 of SciPy's qmc.Sobol(16, scramble=False).
    EXPECT_THAT(sobol_points(64, max_sobol_dimensions).back(),
                ElementsAre(0.015625, 0.796875, 0.359375, 0.453125, 0.859375, 0.140625, 0.578125, 0.140625, 0.828125, 0.578125, 0.421875,
                            0.671875, 0.546875, 0.765625, 0.328125, 0.765625));
    EXPECT_THROW(sobol_points(1, 0), std::invalid_argument);
    EXPECT_THROW(sobol_points(1, max_sobol_dimensions + 1), std::invalid_argument);
}

/// Of 256 points one lies in each 256th of every axis, whatever the seed: a digital net.
TEST_F(StudyAxes, AllDimensionsAreFilledEvenlyUnderAnySeed) {
    for (const std::uint64_t seed : {0U, 1U, 77U}) {
        const auto points = sobol_points(256, max_sobol_dimensions, seed);
        for (std::size_t d = 0; d < max_sobol_dimensions; ++d) {
            std::set<int> bins;
            for (const std::vector<double>& point : points)
                bins.insert(static_cast<int>(256.0 * point[d]));
            EXPECT_EQ(bins.size(), 256U) << "dimension " << d << ", seed " << seed;
        }
    }
    EXPECT_NE(sobol_points(4, 2, 1), sobol_points(4, 2, 0));
    EXPECT_EQ(sobol_points(4, 2, 1), sobol_points(4, 2, 1));
}

TEST_F(StudyAxes, ASampleIsScaledToRangesAndTakesListsByIndex) {
    const Study study = read("axes: {mount_height_m: {from: 0.5, to: 0.9}, weather.wetness: [0, 0.5, 1]}\nsample: {low_discrepancy: 4}\n");
    EXPECT_THAT(study.points,
                ElementsAre(ElementsAre("0.5", "0"), ElementsAre("0.7", "0.5"), ElementsAre("0.8", "0"), ElementsAre("0.6", "1")));
}

TEST_F(StudyAxes, AimSpacingLoadAndSpeedChangeTheCar) {
    const Study study = read("axes: {yaw_deg: [0, 0.5], pitch_deg: [-0.2], roll_deg: [1], mount_spacing_m: [1.4], load_kg: [75], "
                             "speed_factor: [0.5]}\n");
    const Drive own = cell_drive(read(""), cells_of(read("")).front()), drive = at(study, 1);
    ASSERT_EQ(drive.lamp_sets[0].lamps.size(), own.lamp_sets[0].lamps.size());
    for (std::size_t i = 0; i < drive.lamp_sets[0].lamps.size(); ++i) {
        const MountedLamp &lamp = drive.lamp_sets[0].lamps[i], &before = own.lamp_sets[0].lamps[i];
        EXPECT_DOUBLE_EQ(lamp.yaw_rad, before.yaw_rad + radians(0.5));
        EXPECT_DOUBLE_EQ(lamp.pitch_rad, before.pitch_rad - radians(0.2));
        EXPECT_DOUBLE_EQ(lamp.roll_rad, before.roll_rad + radians(1.0));
        EXPECT_DOUBLE_EQ(std::abs(lamp.position_m.y), 0.7);
        EXPECT_GT(lamp.position_m.y * before.position_m.y, 0.0);
        EXPECT_EQ(lamp.position_m.z, before.position_m.z);
    }
    ASSERT_TRUE(drive.lamp_sets[0].control);
    EXPECT_DOUBLE_EQ(drive.lamp_sets[0].control->load.rear_n, 75.0 * 9.81);
    for (std::size_t i = 0; i < drive.speed.size(); ++i)
        EXPECT_DOUBLE_EQ(drive.speed[i].speed_mps, 0.5 * own.speed[i].speed_mps);
}

TEST_F(StudyAxes, PathsReachNamesListsAndShortForms) {
    // Overtaking has cars ahead and coming the other way: a gap is set where there is one.
    const auto folder = tests::new_folder();
    const std::string drive =
        fmt::format("fernlicht: 1\nroad: {0}/roads/straight.xodr\nduration_s: 1\nspeed_kmh: 50\n"
                    "car: {{mounts: {{left: [3.4, 0.6, 0.65], right: [3.4, -0.6, 0.65]}}}}\n"
                    "lamp_sets: {{one: {{lamps: {{left: {0}/lamps/halogen-low.ies, right: {0}/lamps/halogen-low.ies}}}}}}\n"
                    "traffic: {{near: {{oncoming: {{gap_m: 100}}, speed_kmh: 50}}, before: {{ahead: {{gap_m: 40}}, speed_kmh: 50}}}}\n",
                    shipped_library.string());
    const auto file = tests::written("gaps.yaml", drive, folder);
    const std::string beginning = fmt::format("fernlicht_study: 1\nlamps: {{a: {{low: {}/lamps/halogen-low.ies}}}}\ndrives: [{}]\n",
                                              shipped_library.string(), file.string());
    const Study study = read_study(
        tests::written("study.yaml", beginning + "axes: {'traffic.*.oncoming.gap_m': [150], car.mounts.left.position_m.2: [0.9], "
                                                 "'lamp_sets.*.lamps.*.aim.yaw_deg': [0.3], measure.visibility.age_years: [70], gap: {key: "
                                                 "traffic.before.ahead.gap_m, values: [20]}}\n"));
    const Drive played = cell_drive(study, cells_of(study).front());
    EXPECT_EQ(played.traffic_rows[0].gap_m, 150.0);
    EXPECT_EQ(played.traffic_rows[1].gap_m, 20.0) << "of a row by its name; no oncoming one was made of it";
    EXPECT_EQ(played.traffic_rows[1].place, TrafficPlace::ahead);
    EXPECT_EQ(played.lamp_sets[0].lamps[0].position_m.z, 0.9);
    EXPECT_EQ(played.lamp_sets[0].lamps[1].position_m.z, 0.65);
    EXPECT_DOUBLE_EQ(played.lamp_sets[0].lamps[1].yaw_rad, radians(0.3));
    EXPECT_EQ(played.seeing.visibility.value().age_years, 70.0);
    EXPECT_EQ(cells_of(study).front().axes.back(), (AxisValue{"gap", "20"}));
}

TEST_F(StudyAxes, RefusesInOneSentenceWithItsAxis) {
    EXPECT_THAT(refusal("axes: {weather.wetness: {from: 0, to: 1, step: 0.3}}\n"),
                HasSubstr("step: 0.3, which leads past 1 from 0, expected a step that ends there, such as 0.25"));
    EXPECT_THAT(refusal("axes: {weather.wettness: [0, 1]}\n"),
                AllOf(HasSubstr("study.yaml:6:"), HasSubstr("'weather.wettness', which no drive has"),
                      HasSubstr("'wetness', the nearest known key of weather")));
    EXPECT_THAT(refusal("axes: {mount_hight_m: [0.6]}\n"), HasSubstr("'mount_height_m', or a key of a drive"));
    EXPECT_THAT(refusal("axes: {weather.wetness: [0, 1.5]}\n"),
                AllOf(HasSubstr("study.yaml:6:"), HasSubstr("axes.weather.wetness: found 1.5, which this drive refuses:"),
                      HasSubstr("straight.yaml: weather.wetness: found '1.5', expected a number from 0 to 1")));
    EXPECT_THAT(refusal("axes: {mount_height_m: [20]}\n"),
                HasSubstr("axes.mount_height_m[0]: found '20', expected a number from 0.05 to 10"));
    EXPECT_THAT(refusal("axes: {weather.wetness: [0, 0]}\n"), HasSubstr("the value 0 given twice"));
    EXPECT_THAT(refusal("axes: {weather.wetness: [0], wet: {key: weather.wetness, values: [1]}}\n"),
                HasSubstr("axes.wet: 'weather.wetness' beside the axis 'weather.wetness': both set the same"));
    EXPECT_THAT(refusal("axes: {speed_kmh: [50], speed_mps: [20]}\n"), HasSubstr("both set the same"));
    EXPECT_THAT(refusal("axes: {weather.wetness: {from: 0, to: 1}}\n"), HasSubstr("a range without count or step"));
    EXPECT_THAT(refusal("axes: {weather.wetness: {from: 1, to: 0, count: 2}}\n"), HasSubstr("a range that goes up"));
    EXPECT_THAT(refusal("axes: {pitch_deg: [0, 0.1]}\nconditions: {aim_percent: [-1, -1.5]}\n"),
                HasSubstr("axes.pitch_deg: a pitch of the lamps beside several conditions.aim_percent"));
    EXPECT_THAT(refusal("axes: {daylight.horizontal_illuminance_lx: [0.1]}\nconditions: {time_of_day: day}\n"),
                HasSubstr("daylight beside conditions.time_of_day"));
    EXPECT_THAT(refusal("axes: {technique: [photometric]}\n"), HasSubstr("expected techniques"));
    EXPECT_THAT(refusal("axes: {'lamp_sets.*.voltage_v': [12]}\n"), HasSubstr("conditions.voltage_v"));
    EXPECT_THAT(refusal("axes: {'traffic.*.oncoming.gap_m': [50]}\n"), HasSubstr("found nothing there"));
    EXPECT_THAT(refusal("axes: {mount_height_m: [0.6], car.mounts: [{left: [3, 0.6, 0.6]}]}\n"), HasSubstr("both move the lamps"));
    EXPECT_THAT(refusal("sample: one_at_a_time\n"), HasSubstr("a sample without axes"));
    EXPECT_THAT(refusal("axes: {weather.wetness: [0]}\nsample: {low_discrepancy: 100001}\n"), HasSubstr("1 to 100000"));
    EXPECT_THAT(refusal("axes: {weather.wetness: {from: 0, to: 1, count: 100}, mount_height_m: {from: 0.5, to: 1, count: 501}}\n"),
                HasSubstr("100200 cells (drives x lamps x techniques x conditions x points of axes), expected at most 100000"));
}

TEST_F(StudyAxes, ThousandsOfCellsHaveNamesOfTheirOwn) {
    const Study study = read("axes: {weather.wetness: {from: 0, to: 1, count: 25}, mount_height_m: {from: 0.5, to: 1, step: 0.01}, "
                             "yaw_deg: [-0.1, 0, 0.1]}\n");
    const std::vector<StudyCell> cells = cells_of(study);
    ASSERT_EQ(cells.size(), 25U * 51U * 3U * 2U);
    std::set<std::string> names;
    for (const StudyCell& cell : cells)
        names.insert(cell.name);
    EXPECT_EQ(names.size(), cells.size());
    EXPECT_EQ(cells.back().name, "straight_b_p3825");
}

} // namespace
} // namespace fernlicht
