#include "runner/experiments/importance/importance_result.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string importance_of_straight = "importance " + library_file("drives/straight.yaml") + " --lamp-set xenon --reading ";

TEST(ImportanceCommand, SaysWhereAReachIsDecidedAndThatTheGradientHolds) {
    const TemporaryFolder folder;
    const std::string said =
        printed(importance_of_straight + "reach_5lx_target_own_m --frames 10:10 --trials 10 --out " + (folder / "out"));
    EXPECT_THAT(said, HasSubstr("reach_5lx_target_own_m"));
    const json found = tests::checked(content_of(folder / "out/importance.json"), importance_members);
    EXPECT_NEAR(found.at("value"), 45.4, 0.2); // of the README
    EXPECT_TRUE(found.at("agrees"));
    EXPECT_GE(found.at("linear_to"), 0.01);
    ASSERT_EQ(found.at("spots").size(), 2U); // each lamp meets the target from its own side, and both have one file
    EXPECT_LT(found.at("spots")[0].at("h_deg").get<double>() * found.at("spots")[1].at("h_deg").get<double>(), 0.0);
    const json& spot = found.at("spots")[0];
    EXPECT_EQ(spot.at("lamps").size(), 2U);
    EXPECT_GT(spot.at("foretold"), 0.0);
    EXPECT_GT(spot.at("found"), 0.0);
    EXPECT_LT(spot.at("v_deg"), 0.0);
    double by_percent = 0.0, by_samples = 0.0;
    for (const json& lamp : found.at("lamps"))
        by_percent += lamp.at("per_percent").get<double>();
    EXPECT_GT(by_percent, 0.0);
    const auto rows = csv_rows(content_of(folder / "out/importance.csv"));
    ASSERT_GT(rows.size(), 8U);
    for (std::size_t i = 1; i < rows.size(); ++i)
        by_samples += std::stod(rows[i].at(4));
    EXPECT_GT(by_samples, 0.0);
    for (const char* name : {"report.html", "importance.svg", "importance.png", "importance.exr"})
        EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + std::string(name)))) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "out/INCOMPLETE"));
}

TEST(ImportanceCommand, RefusesOtherReadingsAndFailsWhereThereIsNoNumber) {
    const TemporaryFolder folder;
    EXPECT_THAT(printed(importance_of_straight + "patch_dark_own_m --out " + (folder / "a"), 2), HasSubstr("reach_*_m, width_*_m"));
    EXPECT_THAT(printed(importance_of_straight + "brightness --out " + (folder / "b"), 2), HasSubstr("fernlicht readings"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    EXPECT_THAT(printed(importance_of_straight + "width_0.01lx_target_all_at_20m_m --frames 0:0 --out " + (folder / "c"), 1),
                HasSubstr("has no gradient"));
}

TEST(ImportanceCommand, TellsTheMarginOfARatingsRow) {
    const TemporaryFolder folder;
    const std::string margin = "importance " + library_file("lamp_sets/halogen.yaml") + " --rating adb-track --row ";
    printed(margin + "7 --photometer mirror-right --trials 5 --out " + (folder / "out"));
    const json found = tests::checked(content_of(folder / "out/importance.json"), importance_members);
    EXPECT_EQ(found.at("unit"), "%");
    EXPECT_NEAR(found.at("value"), 100.0 * (1.0 - 3.2 / 4.0), 100.0 * 0.05 / 4.0 + 1e-9); // docs/ratings.md, where light is rounded to 0.1
    ASSERT_EQ(found.at("deciders").size(), 1U);
    EXPECT_EQ(found.at("deciders")[0].at("figure"), found.at("value"));
    double all = 0.0;
    for (const json& lamp : found.at("lamps"))
        all += 100.0 * lamp.at("per_percent").get<double>();
    EXPECT_NEAR(all, found.at("value").get<double>() - 100.0, 1e-9); // light itself
    EXPECT_TRUE(found.at("agrees"));
    EXPECT_THAT(printed(margin + "9 --out " + (folder / "a"), 2), HasSubstr("a row of the rating: 1, 2"));
    EXPECT_THAT(printed(margin + "1 --photometer mirror-left --out " + (folder / "b"), 2), HasSubstr("one of the row's: driver"));
    EXPECT_THAT(printed("importance " + library_file("drives/straight.yaml") + " --out " + (folder / "c"), 2),
                HasSubstr("--reading: is missing, expected a reading, or a row of a rating"));
}

} // namespace
} // namespace fernlicht
