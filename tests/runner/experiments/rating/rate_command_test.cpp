#include "runner/experiments/rating/rating_result.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two lamps that shine evenly, 0.33 lx at 25 m each, side by side 0.65 m above the road; and such a set as "high", if asked.
std::string even_lamps(const TemporaryFolder& folder, bool high = false) {
    const std::string lamps = fmt::format("{{file: {}}}", library_file("lamps/even-0.33lx.csv"));
    std::ofstream(folder / "set.yaml") << "lamp_sets:\n  low: " << lamps << (high ? "\n  high: " + lamps : "") << '\n';
    return folder / "set.yaml";
}

std::string rating_of(const TemporaryFolder& folder, const std::string& limit, const std::string& more = "") {
    std::ofstream(folder / "mine.yaml") << fmt::format("fernlicht_rating: 1\nmodelled_on: TEST 7\nedition: '2'\nsource: us\n"
                                                       "distance: {{from: lamps, to: photometer, is: assumed}}\n"
                                                       "photometers: {{eye: {{on: fixture, position_m: [1.3, 0.35, 0.65], is: assumed}}}}\n"
                                                       "limits: {{l: {{is: stated, ranges: [{{from_m: 30, to_m: 60, at_most_lx: {}}}]}}}}\n"
                                                       "rows:\n  straight: {{drive: {}, photometers: [eye], limits: l, is: stated{}",
                                                       limit, library_file("ratings/adb-track/1.yaml"), more);
    return "rate " + (folder / "mine.yaml") + " --lamps " + even_lamps(folder, true) + " --out " + (folder / "out");
}

TEST(RateCommand, JudgesTheLightOfTwoEvenLampsAsWorkedOutByHand) {
    const TemporaryFolder folder;
    const std::string said = printed(rating_of(folder, "0.4", ", points: 3}\n"), 1);
    EXPECT_THAT(said, HasSubstr("modelled on TEST 7, 2"));
    EXPECT_THAT(said, HasSubstr("assumed"));
    const json found = tests::checked(content_of(folder / "out/rating.json"), rating_members);
    EXPECT_EQ(found.at("verdict"), "exceeded");
    const json& photometer = found.at("rows").at(0).at("photometers").at(0);
    EXPECT_EQ(photometer.at("place_is"), "assumed");
    const json &range = photometer.at("ranges").at(0), &worst = range.at("worst");
    // 2 lamps of 0.33 * 25^2 cd at the nearest moment before 30 m, both within 0.6 m of the middle
    const double d = worst.at("distance_m");
    EXPECT_GE(d, 30.0);
    EXPECT_LT(d, 30.3); // 0.29 m a moment
    EXPECT_NEAR(range.at("lx").get<double>(), 2.0 * 0.33 * 625.0 / (d * d), 0.001);
    EXPECT_NEAR(range.at("margin").get<double>(), (0.4 - range.at("lx").get<double>()) / 0.4, 1e-12);
    EXPECT_EQ(found.at("points"), 0.0);
    // from the car's start 5 m along, lamps at 3.4; the fixture's eye 1.3 m before its axle 330 m along and 3.7 m and its own 0.35 beside
    const double along_m = std::sqrt(d * d - (3.7 - 0.35) * (3.7 - 0.35));
    EXPECT_NEAR(worst.at("time_s").get<double>(), (330.0 - 1.3 - 8.4 - along_m) / (104.6 / 3.6), 0.001);
    for (const char* name : {"report.html", "rating.csv", "light.csv", "light-straight.svg"})
        EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + std::string(name)))) << name;
    EXPECT_THAT(content_of(folder / "out/report.html"), Not(HasSubstr("passes")));
}

TEST(RateCommand, IsGreenWithinItsLimitsAndTellsWhatNoLampSetIsThereFor) {
    const TemporaryFolder folder;
    const std::string rows = fmt::format("}}\n  told: {{drive: {0}, reading: sensor_right-edge_reach_5lx_m, is: stated}}\n"
                                         "  fog: {{drive: {0}, lamp_set: fog, reading: sensor_right-edge_reach_5lx_m, is: stated}}\n"
                                         "  high: {{drive: {0}, lamp_set: high, reading: sensor_right-edge_reach_5lx_m, at_least: 5, is: "
                                         "stated, points_by: [[0, 0], [100, 50]]}}\n",
                                         library_file("drives/iihs-straight.yaml"));
    const std::string said = printed(rating_of(folder, "0.5", rows));
    EXPECT_THAT(said, HasSubstr("set.yaml has no lamp set 'fog'"));
    const json found = tests::checked(content_of(folder / "out/rating.json"), rating_members);
    EXPECT_EQ(found.at("verdict"), "within");
    EXPECT_EQ(found.at("rows").at(1).at("verdict"), "told");
    EXPECT_EQ(found.at("rows").at(2).at("verdict"), "not_measured");
    const double reach_m = found.at("rows").at(3).at("value");
    EXPECT_NEAR(found.at("points").get<double>(), 0.5 * reach_m, 1e-9);
}

TEST(RateCommand, DoesNotMeasureWhereTheDriveIsNotAsAskedOrDoesNotComeThere) {
    const TemporaryFolder folder;
    EXPECT_THAT(printed(rating_of(folder, "0.5", ", speed_kmh: [60, 80]}\n"), 1), HasSubstr("the car drives 104.6 to 104.6 km/h"));
    const TemporaryFolder other;
    EXPECT_THAT(printed(rating_of(other, "0.5", ", radius_m: [85, 115]}\n"), 1), HasSubstr("the path is straight and is "));
}

TEST(RateCommand, RefusesWhatItCannotRate) {
    const TemporaryFolder folder;
    const std::string lamps = " --lamps " + even_lamps(folder);
    EXPECT_THAT(printed("rate adb-trak" + lamps, 2), HasSubstr("nearest: 'adb-track'"));
    EXPECT_THAT(printed("rate adb-track --lamp-set fog" + lamps, 2), HasSubstr("set.yaml: --lamp-set: found 'fog', expected one of low"));
    EXPECT_THAT(
        printed(rating_of(folder, "0.5",
                          "}\n  b: {drive: " + library_file("drives/straight.yaml") + ", photometers: [eye], limits: l, is: stated}\n"),
                2),
        HasSubstr("photometer 'eye' on 'fixture', a road user that drive straight-1 does not have"));
    EXPECT_THAT(printed(rating_of(folder, "0.5",
                                  "}\n  b: {drive: " + library_file("drives/straight.yaml") + ", reading: sensor_x_max_lx, is: stated}\n"),
                        2),
                HasSubstr("rows.b.reading: 'sensor_x_max_lx', which drive straight-1 does not measure"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

} // namespace
} // namespace fernlicht
