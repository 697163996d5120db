#include "runner/experiments/masks/masks_result.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string drive_file(const std::string& name) { return library_file("drives/" + name + ".yaml"); }

TEST(MasksCommand, SetsLightLostAgainstLightOfOthersByMargin) {
    const TemporaryFolder folder;
    const std::string said = printed("masks " + drive_file("adaptive-crest") + " --margins 0,2 --out " + (folder / "out"));
    EXPECT_THAT(said, HasSubstr("of high’s light on own lane and verge is lost"));
    EXPECT_THAT(said,
                ::testing::ContainsRegex("None of the margins tried keeps all light below limits: low by itself gives [0-9.]+ lx s above "
                                         "them, up to [0-9]+ % of a limit, which no mask takes away"));
    const json found = tests::checked(content_of(folder / "out/masks.json"), masks_members);
    std::map<std::string, json> drives;
    for (const json& one : found.at("drives"))
        drives[one.at("lamp_set").get<std::string>() + (one.at("margin_deg").is_null() ? "" : " " + one.at("margin_deg").dump()) +
               (one.at("as_it_is") ? "" : " tried")] = one;
    ASSERT_EQ(drives.size(), 8U);
    const auto figure = [&](const std::string& name, const char* key) { return drives.at(name).at(key).get<double>(); };
    EXPECT_EQ(figure("high", "lost_lxs"), 0.0);
    const std::string none = "pixels 0.0 tried", own = "pixels 0.7", wide = "pixels 2.0 tried";
    for (const auto& [narrower, wider] : {std::pair(none, own), {own, wide}, {wide, std::string("low")}}) {
        EXPECT_LT(figure(narrower, "lost_lxs"), figure(wider, "lost_lxs")) << narrower;
        EXPECT_GE(figure(narrower, "others_lxs"), figure(wider, "others_lxs") - 1e-6) << narrower;
    }
    EXPECT_LT(figure(none, "others_lxs"), 0.1 * figure("high", "others_lxs"));
    EXPECT_LE(figure("high", "above_lxs"), figure("high", "others_lxs"));
    // What the moments' file says adds up to it.
    double sum = 0.0;
    for (const std::vector<std::string>& row : csv_rows(content_of(folder / "out/moments.csv")))
        if (row[0] == "high")
            sum += std::stod(row[5]);
    EXPECT_NEAR(sum * found.at("step_s").get<double>(), figure("high", "both_lxs"), 1e-6 * sum);
    for (const char* name : {"report.html", "masks.csv", "cost.svg", "cost-masks.png", "on-foot.svg", "others-over-time.svg"})
        EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + std::string(name)))) << name;
}

/// Without other road users, against a lamp set that gives no light, and with lamps elsewhere on the car.
TEST(MasksCommand, SaysWhatItDidNotMeasure) {
    const TemporaryFolder folder;
    const std::string low = library_file("lamps/led-low.ies");
    std::ofstream(folder / "alone.yaml") << fmt::format(
        "fernlicht: 1\nname: alone\nroad: \"{}\"\nspeed_kmh: 72\nrate_hz: 5\nduration_s: 1\nlamp_sets:\n"
        "  dark: {{lamps: {{left: {{file: \"{}\", level: 0, position_m: [3.4, 0.6, 0.65]}}}}}}\n"
        "  low: {{lamps: {{left: {{file: \"{}\", position_m: [3.4, 0.6, 1.0]}}}}}}\n"
        "  cut: {{lamps: {{high-left: {{file: \"{}\", position_m: [3.4, 0.6, 0.65]}}}}, "
        "control: {{high_beam: automatic, glare_free: {{windows_deg: {{high-left: pixels}}}}}}}}\n",
        library_file("roads/straight.xodr"), low, low, library_file("lamps/matrix-84.yaml"));
    const std::string said = printed("masks " + (folder / "alone.yaml") + " --full-light dark --margins 1 --out " + (folder / "out"));
    EXPECT_THAT(said, HasSubstr("low: dark gives no light on own lane and verge. Others get 0 lx s"));
    EXPECT_THAT(said, HasSubstr("there is nobody to spare"));
    const json found = tests::checked(content_of(folder / "out/masks.json"), masks_members);
    for (const json& one : found.at("drives")) {
        EXPECT_TRUE(one.at("lost_percent").is_null());
        EXPECT_TRUE(one.at("most_of_limit").is_null());
        EXPECT_TRUE(one.at("on_foot_right_m").is_null());
        EXPECT_EQ(one.at("others_lxs"), 0.0);
    }
    EXPECT_GT(found.at("drives").at(1).at("both_lxs"), 0.0);
    ASSERT_EQ(found.at("notes").size(), 1U) << found.at("notes");
    EXPECT_THAT(found.at("notes").at(0).get<std::string>(),
                HasSubstr("lamp set low: the middle of its lamps lies up to 0.35 m from that of dark"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/on-foot.svg"));
}

TEST(MasksCommand, RefusesWhatItCannotTell) {
    EXPECT_THAT(printed("masks " + drive_file("straight"), 2), HasSubstr("lamp_sets: found none that masks others"));
    EXPECT_THAT(printed("masks " + drive_file("adaptive-crest") + " --full-light full", 2),
                HasSubstr("--full-light: found 'full', expected one of low, high, matrix, pixels"));
    EXPECT_THAT(printed("masks " + drive_file("adaptive-crest") + " --rating iihs", 2),
                HasSubstr("rating 'iihs' has no photometer on road users that faces forward or backward"));
    for (const char* margins : {"-1", "x", "0,11", "0,,1"})
        EXPECT_THAT(printed("masks " + drive_file("adaptive-crest") + " --margins=" + margins, 2), HasSubstr("--margins"));
}

/// Margins that lie on one another share a label; none is left without, and radians do not show.
TEST(MasksCommand, LabelsOfMarginsDoNotCollide) {
    MasksFound found;
    found.against = "high";
    found.drives.push_back({.lamp_set = "high", .lost_lxs = 0.0, .others_lxs = 500.0});
    for (const auto& [margin_deg, own] : {std::pair(0.25, false), {0.498473, true}, {0.5, false}, {1.0, false}, {1.01, false}})
        found.drives.push_back({.lamp_set = "matrix",
                                .margin_deg = margin_deg,
                                .as_it_is = own,
                                .lost_lxs = 40.0 * margin_deg,
                                .others_lxs = 30.0 / margin_deg});
    const Document told = document(found);
    const auto& close = std::get<plots::Figure>(std::get<Plot>(told.sections[0].blocks.at(2)).figure);
    std::string labels;
    for (const plots::Note& note : close.notes)
        labels += note.text + "|";
    EXPECT_EQ(labels, "matrix 0.498, 0.5|0.25|1, 1.01|");
}

} // namespace
} // namespace fernlicht
