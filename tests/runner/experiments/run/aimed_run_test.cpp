// Runs and studies through the program whose lamps are aimed by their cut-offs: a file with its cut-off elsewhere reads like the original.
#include "runner/experiments/study/study_document.h"
#include "scenarios/lamps/lamp_file.h"
#include "tests/metrics/changed_lamps.h"
#include "tests/runner/program.h"
#include "tests/runner/run_readings.h"
#include "tests/runner/schema_check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr, testing::Not;

class AimedRun : public testing::Test {
  protected:
    TemporaryFolder folder_;

    /// Our halogen low beam with all its angles shifted.
    std::string shifted(const std::string& name, double right_deg, double up_deg) const {
        LampFile lamp = read_lamp(library_file("lamps/halogen-low.ies"));
        lamp.table = aimed(lamp.table, right_deg, up_deg);
        write_lamp(lamp, folder_ / name);
        return folder_ / name;
    }
    std::string drive_with(const std::string& lamp_sets) const {
        std::string file = folder_ / "aimed.yaml";
        std::ofstream(file) << "fernlicht: 1\nroad: " << library_file("roads/straight.xodr")
                            << "\nroute: {s_m: 20}\nspeed_kmh: 64.4\nrate_hz: 10\nduration_s: 10\nlamp_sets:\n"
                            << lamp_sets
                            << "views: {driver: {pitch_deg: -1, resolution_px: [96, 72]}}\nmeasure:\n  extent: {thresholds_lx: [1, 5]}\n";
        return file;
    }
    static constexpr const char* flags = " --quiet --frames 0:1 --no-accuracy --out ";
};

TEST_F(AimedRun, AFileWithItsCutOffElsewhereReadsLikeTheOriginal) {
    const std::string drive =
        drive_with(fmt::format("  original: {{file: {}, aim: auto}}\n  filed: {{file: {}}}\n  on-hh: {{file: {}, aim: auto}}\n"
                               "  raised-left: {{file: {}, aim: auto}}\n  low: {{file: {}, aim: {{rule: auto, cut_off_percent: -2}}}}\n",
                               library_file("lamps/halogen-low.ies"), library_file("lamps/halogen-low.ies"), shifted("hh.ies", 0.0, 0.57),
                               shifted("raised-left.ies", -0.5, 0.3), library_file("lamps/halogen-low.ies")));
    const Outcome run = run_program("run " + drive + flags + (folder_ / "out"));
    ASSERT_EQ(run.exit_code, 0) << run.output;
    const auto reading = [&](const char* name, const char* lamp_set) { return tests::reading_of(folder_ / "out", name, lamp_set); };
    for (const char* name : {"reach_1lx_target_own_m", "reach_5lx_target_own_m", "reach_5lx_target_own_right_edge_m",
                             "reach_1lx_road_own_m", "width_1lx_road_all_at_20m_m"})
        for (const char* lamp_set : {"on-hh", "raised-left"}) {
            // A table's shifted angles are no rotation: within 5 degrees of straight ahead they are 0.002 degrees beside it, and files have
            // angles to 0.001 degrees, where 0.1 degrees are worth up to 7 m of reach.
            EXPECT_NEAR(reading(name, lamp_set), reading(name, "original"), 0.2) << name << ", " << lamp_set;
        }
    // The shipped file is known to hold 1 % within 0.02 degrees.
    EXPECT_NEAR(reading("reach_1lx_target_own_m", "original"), reading("reach_1lx_target_own_m", "filed"), 0.2 * 6.7);
    EXPECT_LT(reading("reach_1lx_target_own_m", "low"), reading("reach_1lx_target_own_m", "original") - 10.0);

    const std::string page = content_of(folder_ / "out/report.html");
    EXPECT_THAT(page, HasSubstr("Aim of the lamps"));
    EXPECT_THAT(page, HasSubstr("auto to -1 %"));
    EXPECT_THAT(run.output, HasSubstr("fernlicht: aimed: low, left and right: the cut-off lies at -2.00 %"));
    EXPECT_THAT(run.output, Not(HasSubstr("original, left")));
    const json report = json::parse(content_of(folder_ / "out/report.json"));
    EXPECT_THAT(tests::complaints(report, "run/report"), testing::IsEmpty());
    const json& aim = report.at("drives").at(2).at("aims").at(0);
    EXPECT_EQ(aim.at("rule"), "auto");
    EXPECT_NEAR(aim.at("file_up_deg"), -0.013, 0.005); // the shipped file has it at 0.583 D
    EXPECT_NEAR(aim.at("turned_up_deg"), -0.57, 0.01);
    EXPECT_NEAR(aim.at("percent"), -1.0, 1e-9);
    EXPECT_EQ(report.at("drives").at(1).at("aims").at(0).at("rule"), "as-is");
    EXPECT_NEAR(report.at("drives").at(1).at("aims").at(0).at("percent"), -1.0, 0.03) << "as filed, and measured all the same";

    const Outcome again = run_program("run " + (folder_ / "out/aimed.yaml") + flags + (folder_ / "again"));
    ASSERT_EQ(again.exit_code, 0) << again.output;
    for (const char* file : {"readings.csv", "aimed.yaml"})
        EXPECT_EQ(content_of(folder_ / (std::string("again/") + file)), content_of(folder_ / (std::string("out/") + file))) << file;
}

TEST_F(AimedRun, AStudySaysHowItAimedAndFindsNoDifference) {
    const std::string file = folder_ / "aims.yaml";
    std::ofstream(file) << "fernlicht_study: 1\nlamps:\n  production: {low: " << library_file("lamps/halogen-low.ies")
                        << ", aim: auto}\n  new: {low: " << shifted("hh.ies", 0.0, 0.57)
                        << ", aim: auto}\n  wrong: {low: " << shifted("hh.ies", 0.0, 0.57) << "}\ndrives: ["
                        << library_file("drives/straight.yaml")
                        << "]\nconditions: {aim_percent: [-1, -0.4]}\npictured_moments: 1\nresolution_px: [96, 72]\n"
                           "compare: [{new: new, against: production}]\n";
    const Outcome run = run_program("study " + file + flags + (folder_ / "out"));
    ASSERT_EQ(run.exit_code, 0) << run.output;
    EXPECT_THAT(run.output, HasSubstr("new against production: the whole beam is aimed 0.57 degrees higher"));
    EXPECT_THAT(run.output, HasSubstr("turned by `aim: auto`"));
    EXPECT_THAT(run.output, HasSubstr("fernlicht: new, left and right: the cut-off lies at -0.40 %"));
    EXPECT_THAT(run.output, HasSubstr("fernlicht: wrong, left and right: the cut-off lies at -0.0")) << "its dip was taken for granted";
    const json study = tests::checked(content_of(folder_ / "out/study.json"), study_members);
    std::size_t compared = 0;
    for (const json& change : study.at("changes"))
        if (change.at("decides") == true) {
            ++compared;
            EXPECT_NE(change.at("kind"), "real") << change.dump();
        }
    EXPECT_GE(compared, 10U);
    for (const json& cell : study.at("cells"))
        if (cell.at("lamp") != "wrong") {
            EXPECT_NEAR(cell.at("aims").at(0).at("percent"), cell.at("aim_percent"), 1e-9);
        }
    const std::string page = content_of(folder_ / "out/report.html");
    EXPECT_THAT(page, HasSubstr("Aim of the lamps"));
    EXPECT_THAT(page, HasSubstr("auto to -0.4 %"));

    std::ofstream(file, std::ios::app) << "# the same, and a lamp without a cut-off\n";
    std::string text = content_of(file);
    text.replace(text.find("  wrong"), 7, "  even: {low: " + library_file("lamps/even-0.33lx.csv") + ", aim: auto}\n  wrong");
    std::ofstream(file) << text;
    const Outcome refused = run_program("study " + file + flags + (folder_ / "refused"));
    EXPECT_EQ(refused.exit_code, 2);
    const std::string why = ": lamps.even.aim: found auto, and nothing to aim by in " + library_file("lamps/even-0.33lx.csv");
    EXPECT_THAT(refused.output, AllOf(HasSubstr("aims.yaml:5:"), HasSubstr(why)));
    EXPECT_THAT(printed("study " + file + " --list", 2), AllOf(HasSubstr("aims.yaml:5:"), HasSubstr(why)));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "refused")) << "before the first frame";
}

} // namespace
} // namespace fernlicht
