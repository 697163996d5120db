// Files of version 0.1 and what `fernlicht migrate` makes of them; how readers refuse them.
#include "tests/runner/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Migrate : public testing::Test {
  protected:
    std::string written(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::trunc | std::ios::binary) << text;
        return folder_ / name;
    }
    void expect_becomes(const std::string& name, const std::string& old, const std::string& now) const {
        const std::string file = written(name, old);
        const Outcome printed = run_program("migrate " + file);
        EXPECT_EQ(printed.output, now);
        EXPECT_EQ(printed.exit_code, 0);
        EXPECT_EQ(content_of(file), old) << "printed only";
        for (int time = 1; time <= 2; ++time) {
            const Outcome run = run_program("migrate --in-place " + file);
            EXPECT_EQ(run.exit_code, 0);
            EXPECT_THAT(run.output, HasSubstr(name + (time == 1 && old != now ? ": changed in line " : ": has today's names already\n")));
            EXPECT_EQ(content_of(file), now) << time;
        }
    }
    const TemporaryFolder folder_;
};

TEST_F(Migrate, ADriveKeepsItsCommentsAndLayout) {
    const std::string head = "# variants: none of these\nfernlicht: 1\r\nroad: \"variants.xodr\"\n";
    const std::string limits = "limits:\n  - {reading: reach_5lx_road_own_m, at_least: 1}   # limits_lx\n";
    expect_becomes("drive.yaml", head + R"(variants:   # of lamps
  variants: {file: low.ies, actuators: {levelling: &level {least_deg: -2, greatest_rad: 0.1}, swivel: *level}}
traffic_light: { least_lx: 0.1 }
measure:
  extent:
    "limits_lx": [1, 5] # lux
  glare: {mirrors: true, limits_lx: [1], limits_percent: [10], limits_de_boer: [5]}
  homogeneity: {'least_lx': 1}
control: {bend: {least_deg: -15, greatest_deg: 15}}
)" + limits,
                   head + R"(lamp_sets:   # of lamps
  variants: {file: low.ies, actuators: {levelling: &level {min_deg: -2, max_rad: 0.1}, swivel: *level}}
traffic_light: { min_lx: 0.1 }
measure:
  extent:
    "thresholds_lx": [1, 5] # lux
  glare: {mirrors: true, thresholds_lx: [1], thresholds_percent: [10], thresholds_de_boer: [5]}
  homogeneity: {'min_lx': 1}
control: {bend: {min_deg: -15, max_deg: 15}}
)" + limits);
}

TEST_F(Migrate, StudiesAndKnownFailures) {
    expect_becomes("study.yaml", "fernlicht_study: 1\nmeasure: {sensors: {limits_lx: [5]}}\nreadings: [area_1lx_road_all_m2]\n",
                   "fernlicht_study: 1\nmeasure: {sensors: {thresholds_lx: [5]}}\ndecide: [area_1lx_road_all_m2]\n");
    expect_becomes("known.yaml", R"(known:
  - {id: "a/b/c/reference reading reach_5lx_road_own_m", kind: fails, reason: reference, expires: 2026-12-31}
  - {id: a/*/reference-direct/reference frame 3 driver, kind: fails, reason: r, expires: 2026-12-31}
  - {id: '*/reference', kind: fails, reason: r, expires: 2026-12-31} # any
  - {id: a/b/c/reach_5lx_road_own_m, kind: fails, reason: r, expires: 2026-12-31}
)",
                   R"(known:
  - {id: "a/b/c/baseline reading reach_5lx_road_own_m", kind: fails, reason: reference, expires: 2026-12-31}
  - {id: a/*/reference-direct/baseline frame 3 driver, kind: fails, reason: r, expires: 2026-12-31}
  - {id: '*/baseline', kind: fails, reason: r, expires: 2026-12-31} # any
  - {id: a/b/c/reach_5lx_road_own_m, kind: fails, reason: r, expires: 2026-12-31}
)");
}

TEST_F(Migrate, ListsWhatItCannotMatch) {
    const std::string drive = written("drive.yaml", "fernlicht: 1\nvariants: {a: {}}\nlamp_sets: {b: {}}\nlimits:\n"
                                                    "  - {reading: reach_5lx_road_own_max_m, at_least: 1}\n");
    const std::string known = written("known.yaml", "known:\n  - {id: a/b/c/reach, kind: fails, reason: r, expires: 2026-12-31}\n");
    const Outcome run = run_program("migrate --out " + (folder_ / "out ") + drive + " " + known);
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.output, AllOf(HasSubstr("drive.yaml:2: 'variants' beside 'lamp_sets'"),
                                  HasSubstr("drive.yaml:5: no reading is called 'reach_5lx_road_own_max_m'"),
                                  HasSubstr("known.yaml:2: no verdict is called 'reach'")));
    EXPECT_EQ(content_of(folder_ / "out/drive.yaml"), content_of(drive));
    EXPECT_EQ(run_program("migrate --out " + (folder_ / "out ") + drive).exit_code, 2) << "is there already";
    const std::string escaped = "fernlicht: 1\n\"vari\\x61nts\": {a: {}} # variants: of lamps\n";
    const Outcome beside = run_program("migrate --in-place " + written("escaped.yaml", escaped));
    EXPECT_EQ(beside.exit_code, 1);
    EXPECT_THAT(beside.output, HasSubstr("escaped.yaml:2: 'variants' is not written out here"));
    EXPECT_EQ(content_of(folder_ / "escaped.yaml"), escaped) << "the comment is no key";
}

TEST_F(Migrate, RefusesWhatItCannotRead) {
    for (const std::string& file : {written("broken.yaml", "fernlicht: [1\n"), written("other.yaml", "road: x\n"), folder_ / "none.yaml",
                                    folder_.path().string() + " --in-place"})
        EXPECT_EQ(run_program("migrate " + file).exit_code, 2) << file;
    EXPECT_THAT(run_program("migrate " + folder_.path().string()).output, HasSubstr("is a folder without index.json, expected a file"));
    written("index.json", "{}");
    EXPECT_THAT(run_program("migrate " + folder_.path().string()).output, HasSubstr("--in-place beside it"));
}

TEST_F(Migrate, ReadersNameTodaysWord) {
    const std::string drive = written("old.yaml", "fernlicht: 1\nvariants: {a: {}}\n");
    const Outcome run = run_program("run " + drive);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.output, HasSubstr("old.yaml:2:1: variants: a key of version 0.1, expected 'lamp_sets', its name today; "
                                      "`fernlicht migrate --in-place " +
                                      drive + "` writes the file so"));
    for (const auto& [arguments, now] : {std::pair("bench --variant a", "--lamp-set"), std::pair("accept x --to=y", "--baselines"),
                                         std::pair("shadows --moments 2", "--count"), std::pair("references list", "baselines")}) {
        const Outcome old = run_program(arguments);
        EXPECT_EQ(old.exit_code, 2) << arguments;
        EXPECT_THAT(old.output, AllOf(HasSubstr(std::string("of version 0.1, expected ") + now), HasSubstr("`fernlicht migrate`")));
    }
}

TEST_F(Migrate, BaselinesStandUnderTodaysNamesAndHashes) {
    namespace fs = std::filesystem;
    const fs::path shipped = FERNLICHT_SOURCE_DIR "/baselines", store = folder_.path() / "store";
    fs::copy(shipped, store, fs::copy_options::recursive);
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(store)) {
        if (!entry.is_regular_file())
            continue;
        std::string text = content_of(entry.path());
        for (const auto& [now, old] :
             {std::pair("\"fernlicht baselines\"", "\"fernlicht references\""), std::pair("\"baselines\": [", "\"references\": ["),
              std::pair("\"fernlicht baseline\"", "\"fernlicht accepted results\""), std::pair("\"lamp_set\":", "\"variant\":")})
            for (std::size_t at = text.find(now); at != std::string::npos; at = text.find(now, at + 1))
                text.replace(at, std::string(now).size(), old);
        std::ofstream(entry.path(), std::ios::trunc | std::ios::binary) << text;
    }
    EXPECT_THAT(run_program("baselines list --baselines " + store.string()).output, HasSubstr("is a store of version 0.1"));
    const std::string before = content_of(store / "index.json");
    EXPECT_EQ(run_program("migrate --in-place " + store.string()).exit_code, 1) << "no drive has the inputs";
    EXPECT_EQ(content_of(store / "index.json"), before) << "nothing is converted by halves";
    EXPECT_EQ(run_program("migrate --out " + (folder_ / "alone ") + store.string()).exit_code, 2) << "in place alone";
    for (int time = 1; time <= 2; ++time) {
        const Outcome run = run_program("migrate --in-place " + store.string() + " " + library_file("studies/standard.yaml"));
        EXPECT_EQ(run.exit_code, 0) << run.output;
        EXPECT_EQ(content_of(store / "index.json"), content_of(shipped / "index.json")) << time;
    }
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(shipped))
        EXPECT_TRUE(fs::exists(store / fs::relative(entry.path(), shipped))) << entry.path();
}

} // namespace
} // namespace fernlicht
