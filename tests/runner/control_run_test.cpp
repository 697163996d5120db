// Lamp control through the program: what the report says of it, the table of signals, a plug-in among the inputs, a swivel that sticks.
#include "runner/findings/pixel_levels.h"
#include "tests/fmu_archive.h"
#include "tests/runner/program.h"
#include "tests/runner/run_readings.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

constexpr const char* small_frames = " --quiet --no-accuracy --resolution 96x72 ";

/// The shipped S-bends at 72 km/h for four seconds. From 150 m a left bend begins, from 250 to 370 m it has a radius of 150 m.
std::string drive_text(double from_m, const std::string& control) {
    return fmt::format(R"(fernlicht: 1
name: bends
road: "{0}"
route: {{s_m: {3}}}
speed_kmh: 72
rate_hz: 10
duration_s: 4
lamp_sets:
  still: {{source: arc, file: "{1}"}}
  moving: {{source: arc, file: "{1}", control: {2}}}
measure: {{extent: false}}
)",
                       library_file("roads/s-bend.xodr"), library_file("lamps/xenon-low.ies"), control, from_m);
}

using Table = std::vector<std::map<std::string, std::string>>;

Table table_of(const std::filesystem::path& file) {
    const CsvFile csv = read_csv(file);
    Table table;
    for (const std::vector<std::string>& row : csv.rows)
        for (std::size_t i = 0; i < row.size(); ++i)
            (i == 0 ? table.emplace_back() : table.back())[csv.heads[i]] = row[i];
    return table;
}

struct Ran {
    std::string out;
    Json report;
    Table signals;
    std::string page;
};

class ControlRunTest : public testing::Test {
  protected:
    Ran run(double from_m, const std::string& control) {
        std::ofstream(folder_ / "bends.yaml") << drive_text(from_m, control);
        const std::string out = folder_ / fmt::format("out{}", ++runs_);
        printed("run " + (folder_ / "bends.yaml") + small_frames + "--out " + out);
        return {out, Json::parse(content_of(out + "/report.json")), table_of(out + "/signals-bends-moving.csv"),
                content_of(out + "/report.html")};
    }
    TemporaryFolder folder_;

  private:
    int runs_ = 0;
};

TEST_F(ControlRunTest, ReportsSwivelAndWhatItIsWorth) {
    const Ran ran = run(260.0, "{bend: {law: yaw-rate, preview_s: 1.5}}");
    ASSERT_EQ(ran.signals.size(), 40U) << "one row a moment";
    double max_rad = 0.0;
    for (const auto& row : ran.signals)
        max_rad = std::max(max_rad, std::abs(std::stod(row.at("lamp.left.swivel_rad"))));
    // 20 m/s over 150 m for 1.5 s: 20 * 1.5 / 300 rad = 5.7 degrees.
    EXPECT_NEAR(max_rad * 180.0 / 3.14159265, 5.7, 0.3);
    EXPECT_NEAR(tests::reading_of(ran.out, "control_swivel_max_deg", "moving"), max_rad * 180.0 / 3.14159265, 0.2);
    EXPECT_EQ(ran.signals.front().at("ego.speed_mps"), "20");
    EXPECT_GT(tests::reading_of(ran.out, "control_left_bends_inside_at_50m_lx", "moving"), 0.0);
    EXPECT_EQ(tests::reading_of(ran.out, "control_swivel_max_deg", "still"), 0.0);
    EXPECT_THAT(ran.page, HasSubstr("Lamps that move"));
    EXPECT_THAT(ran.page, testing::Not(HasSubstr("Pixels over the drive"))) << "there is no pixel lamp";
    EXPECT_FALSE(std::filesystem::exists(ran.out + "/levels-bends-moving.csv"));
}

/// Half of the lamp goes dark after 0.2 s, which the slew takes another 0.1 s for; as a whole it is dimmed to 0.8.
TEST_F(ControlRunTest, PixelsOverTheDriveAreToldAndDrawn) {
    std::ofstream(folder_ / "pixels.yaml") << "fernlicht_pixel_lamp: 1\nslew_per_s: 10\nraster: {pixels: [4, 1], h_deg: [-8, 8], v_deg: "
                                              "[-3, 3], spread_deg: [0.5, 0.25], cd: 1000}\n";
    std::ofstream(folder_ / "levels.csv") << "0, 1, 1, 1, 1\n0.2, 0, 0, 1, 1\n";
    std::ofstream(folder_ / "pixels-drive.yaml")
        << fmt::format("fernlicht: 1\nname: pixels\nroad: \"{}\"\nspeed_kmh: 72\nrate_hz: 20\nduration_s: 0.4\nmeasure: {{extent: false}}\n"
                       "traffic: {{other: {{oncoming: {{gap_m: 100}}, speed_kmh: 72, file: \"{}\"}}}}\n"
                       "lamp_sets: {{cut: {{lamps: {{left: {{file: pixels.yaml, levels: levels.csv, level: 0.8}}}}}}}}\n",
                       library_file("roads/straight.xodr"), library_file("lamps/halogen-low.ies"));
    const std::string out = folder_ / "pixels";
    printed("run " + (folder_ / "pixels-drive.yaml") + small_frames + "--out " + out);
    const Table levels = table_of(out + "/levels-pixels-cut.csv");
    ASSERT_EQ(levels.size(), 8U) << "one row a moment";
    EXPECT_EQ(levels[0].at("lit"), "4");
    EXPECT_EQ(levels[0].at("level"), "0.8");
    EXPECT_EQ(levels[0].at("dark"), "");
    EXPECT_NEAR(std::stod(levels[5].at("level_1")), 0.5, 1e-4) << "on its way";
    EXPECT_NEAR(std::stod(levels[5].at("flux")), 0.75, 1e-4);
    EXPECT_EQ(levels[7].at("lit"), "2");
    EXPECT_EQ(levels[7].at("dark"), "-8:0/-3:3");
    EXPECT_EQ(levels[7].at("level_4"), "1");
    EXPECT_THAT(printed("lamp " + (folder_ / "pixels.yaml") + " --levels " + out + "/levels-pixels-cut.csv --at 0.36"),
                HasSubstr("2 of 4 parts shine, 50 % of the flux, the lamp as a whole at 80 %; dark at H -8 to 0"));
    for (const char* name : {"/levels-pixels-cut-left.svg", "/levels-pixels-cut-left.png"})
        EXPECT_TRUE(std::filesystem::exists(out + name)) << name;
    const std::string page = content_of(out + "/report.html");
    EXPECT_THAT(page, HasSubstr("Pixels over the drive"));
    EXPECT_THAT(page, HasSubstr("edges of oncoming road users"));
}

TEST(PixelLevels, TheCsvSaysHowManyBoxesItLeavesOut) {
    PixelLevels lamp{"left", 400, {{-1.0, 1.0}}, {{}}};
    lamp.rows[0].pixels.dark = {{-1.0, 0.0, -2.0, 2.0}};
    lamp.rows[0].pixels.more_dark = 100;
    EXPECT_THAT(levels_csv({lamp}), HasSubstr(",-1:0/-2:2 and 100 more\r\n"));
}

TEST_F(ControlRunTest, AStuckSwivelIsFoundAndAPluginIsAnInput) {
    const Ran ran =
        run(180.0, fmt::format("{{bend: {{law: yaw-rate, preview_s: 1.5}}, levelling: dynamic, failures: [{{at_s: 0.05, stuck_swivel: "
                               "left}}], plugins: [{{library: \"{}\", lamps: [right]}}]}}",
                               std::filesystem::path(FERNLICHT_BINARY).parent_path().string() + "/example_bend_light.so"));
    EXPECT_EQ(ran.signals.front().at("lamp.left.swivel_stuck"), "0");
    EXPECT_EQ(ran.signals.back().at("lamp.left.swivel_stuck"), "1");
    EXPECT_EQ(ran.signals.back().at("lamp.right.swivel_stuck"), "0");
    EXPECT_NEAR(std::stod(ran.signals.back().at("lamp.right.swivel_rad")), 0.0, 2e-3) << "in a bend, straight ahead";
    bool library = false;
    for (const Json& input : ran.report["context"]["inputs"])
        library = library || input["path"].get<std::string>().find("example_bend_light.so") != std::string::npos;
    EXPECT_TRUE(library);
}

/// One source, bend_light.c, as a plug-in and as FMUs of both standards: the same table of signals, and each file among the inputs.
TEST_F(ControlRunTest, OneLawAsPluginAndAsFmuGivesEqualSignals) {
    const std::string last = "lamps: [left], parameters: ";
    const auto signals = [&](const std::string& plugin, const std::string& file) {
        const Ran ran = run(180.0, "{plugins: [{" + plugin + "}]}");
        EXPECT_THAT(ran.report["context"]["inputs"].dump(), HasSubstr(file));
        return content_of(ran.out + "/signals-bends-moving.csv");
    };
    const std::string plugin = (std::filesystem::path(FERNLICHT_BINARY).parent_path() / "example_bend_light.so").string();
    const std::string expected = signals(fmt::format("library: \"{}\", {}\"1.2\"", plugin, last), plugin);
    EXPECT_GT(std::stod(table_of(tests::written("signals.csv", expected)).back().at("lamp.left.swivel_rad")), 0.01);
    for (const int version : {2, 3}) {
        const std::string fmu = tests::fmu_archive({version}).string();
        EXPECT_EQ(signals(fmt::format("fmu: \"{}\", {}{{preview_s: 1.2}}", fmu, last), fmu), expected) << "FMI " << version;
    }
}

} // namespace
} // namespace fernlicht
