// What a study says of lamps whose difference is known, through the program: named, measured, and nothing else claimed.
#include "runner/experiments/study/study_document.h"
#include "tests/metrics/changed_lamps.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::MatchesRegex;

const Zone zone{-8.0, -3.0, -4.0, -1.5};

/// The lamps of studies/known-differences.yaml, made from the library's halogen low beam.
LampFile known_lamp(const std::string& name) {
    LampFile lamp = read_lamp(library_file("lamps/halogen-low.ies"));
    const CandelaTable table = lamp.table;
    lamp.table = name == "same"     ? with_noise(table, 0.01, 11)
                 : name == "dimmer" ? with_noise(dimmed(table, zone, 0.95), 0.01, 12)
                 : name == "raised" ? with_noise(raised_cut_off(table, 0.2), 0.01, 13)
                                    : with_noise(aimed(table, 0.0, 0.3), 0.01, 14);
    for (double& cd : lamp.table.cd)
        cd = std::round(10.0 * cd) / 10.0; // as the library's lamps
    for (std::vector<double>* axis : {&lamp.table.h_deg, &lamp.table.v_deg})
        for (double& deg : *axis)
            deg = std::round(1000.0 * deg) / 1000.0;
    for (auto& [key, text] : lamp.labels) {
        if (key == "LUMCAT")
            text += ", " + name;
        if (key == "OTHER" && text.starts_with("UN R112"))
            text = "made from the library's lamp with a known difference and noise of +-1 %; meets no table";
    }
    return lamp;
}

TEST(KnownDifferences, ShippedLampsAreWhatTheyAreSaidToBeByteForByte) {
    for (const char* name : {"same", "dimmer", "raised", "high"}) {
        const auto path = std::filesystem::path(testing::TempDir()) / (std::string("known-") + name + ".ies");
        write_lamp(known_lamp(name), path);
        EXPECT_TRUE(content_of(path) == content_of(library_file(std::string("studies/known-differences/") + name + ".ies")))
            << path << " was written";
    }
}

/// 0.08 degrees of aim are within what a mounting leaves open, in every reading; 0.3 degrees are not, where it counts.
TEST(PlantedAim, IsAimInEveryReadingAndRealBeyondIt) {
    const TemporaryFolder folder;
    for (const auto& [name, up_deg] : {std::pair("little", 0.08), std::pair("much", 0.3)}) {
        LampFile lamp = read_lamp(library_file("lamps/halogen-low.ies"));
        lamp.table = aimed(lamp.table, 0.0, up_deg);
        write_lamp(lamp, folder / (std::string(name) + ".ies"));
    }
    std::ofstream(folder / "aim.yaml") << "fernlicht_study: 1\nlamps:\n  halogen: {low: " << library_file("lamps/halogen-low.ies")
                                       << "}\n  little: {low: little.ies}\n  much: {low: much.ies}\ndrives: ["
                                       << library_file("drives/straight.yaml")
                                       << "]\nmeasure: {glare: {oncoming: {a: {at_m: 60}}, mirrors: {gaps_m: [15, 50]}}, visibility: true, "
                                          "homogeneity: true, places: [kerb, boards, markings]}\nresolution_px: [64, 48]\n";
    const Outcome run = run_program("study " + (folder / "aim.yaml") + " --frames 0:1 --quiet --no-accuracy --out " + (folder / "out"));
    ASSERT_EQ(run.exit_code, 0) << run.output;
    const json study = json::parse(content_of(folder / "out/study.json"));
    std::map<std::string, std::size_t> real;
    std::set<std::string> beyond;
    for (const json& change : study.at("changes")) {
        const std::string cell = change.at("new_cell"), reading = change.at("reading");
        if (change.at("kind") != "real")
            continue;
        ++real[cell];
        EXPECT_NE(cell, "straight_little") << change;
        beyond.insert(reading);
    }
    EXPECT_GT(real["straight_much"], 300U);
    for (const char* const reading : {"reach_5lx_target_own_m", "reach_5lx_target_own_right_edge_m", "mirror_inside_at_15m_lx"})
        EXPECT_TRUE(beyond.contains(reading)) << reading;
    EXPECT_THAT(study.at("sentence").get<std::string>(), HasSubstr("it is the aim, not the lamp"));
}

class StudyOfLamps : public testing::Test {
  protected:
    TemporaryFolder folder_;
    json study_;
    std::string page_, output_;

    void SetUp() override {
        const Outcome run = run_program("study " + library_file("studies/known-differences.yaml") +
                                        " --frames 0:1 --quiet --no-accuracy --out " + (folder_ / "out"));
        ASSERT_EQ(run.exit_code, 0) << run.output;
        output_ = run.output;
        study_ = tests::checked(content_of(folder_ / "out/study.json"), study_members);
        page_ = content_of(folder_ / "out/report.html");
    }
    /// What the study says of a lamp, which stands in report and terminal too.
    const json& lamp(const std::string& name) const {
        for (const json& lamps : study_.at("lamps"))
            if (lamps.at("new") == name) {
                EXPECT_THAT(page_, HasSubstr("<li>" + lamps.at("says").get<std::string>() + "</li>"));
                EXPECT_THAT(output_, HasSubstr(lamps.at("says").get<std::string>() + "\n"));
                return lamps;
            }
        throw std::runtime_error("no lamp " + name);
    }
    std::size_t real_changes(const std::string& name) const {
        std::size_t count = 0;
        for (const json& change : study_.at("changes"))
            count += change.at("new_cell") == "straight_" + name && change.at("kind") == "real" ? 1U : 0U;
        return count;
    }
    static void expect_nothing_but(const json& difference, const std::string& claimed) {
        for (const char* name : {"aim_up_deg", "cut_off_up_deg", "level_share"})
            EXPECT_EQ(difference.at(name).is_null(), claimed != name) << difference.at("says");
        EXPECT_EQ(difference.at("zones").empty(), claimed != "zones") << difference.at("says");
    }
};

TEST_F(StudyOfLamps, NamesEachDifferenceAndNothingElse) {
    const json dimmer = lamp("dimmer").at("difference");
    expect_nothing_but(dimmer, "zones");
    ASSERT_EQ(dimmer.at("zones").size(), 1U);
    const json& found = dimmer.at("zones").at(0);
    EXPECT_NEAR(found.at("share"), -0.05, 0.005);
    EXPECT_NEAR(found.at("h_from_deg"), zone.left, 1.0); // asked for: 1 degree
    EXPECT_NEAR(found.at("h_to_deg"), zone.right, 1.0);
    EXPECT_NEAR(found.at("v_from_deg"), zone.bottom, 1.0);
    EXPECT_NEAR(found.at("v_to_deg"), zone.top, 1.0);
    EXPECT_THAT(lamp("dimmer").at("says"),
                MatchesRegex("dimmer against production: part of zone I [45].[0-9] % dimmer [(].* degrees left, .* "
                             "degrees down[)]. Nothing else differs beyond the noise of the tables, .* %."));
    EXPECT_EQ(tests::entry(dimmer.at("places"), "name", "zone I").at("beyond_noise"), true);
    EXPECT_EQ(tests::entry(dimmer.at("places"), "name", "75R").at("beyond_noise"), false);
    EXPECT_THAT(page_, HasSubstr("kerb shoulder"));
    const json raised = lamp("raised").at("difference");
    expect_nothing_but(raised, "cut_off_up_deg");
    EXPECT_NEAR(raised.at("cut_off_up_deg").at("value"), 0.2, 0.05);
    EXPECT_THAT(lamp("raised").at("says"),
                MatchesRegex(".*the cut-off is 0.2.* not moved [(]in all: 75R [+].* %, .*; glare: .*zone III [+].* %[)]. Nothing else .*"));
    const json high = lamp("high").at("difference");
    expect_nothing_but(high, "aim_up_deg");
    EXPECT_NEAR(high.at("aim_up_deg").at("value"), 0.3, 0.05); // asked for: 0.05
    EXPECT_THAT(
        lamp("high").at("says"),
        MatchesRegex(
            ".*the whole beam is aimed 0.30 degrees higher [(]in all: HV [+].* %, .*; glare: .*zone III [+].* %[)]. Nothing else .*"));
    EXPECT_GT(real_changes("high"), 10U) << "and its readings say so";
    const json same = lamp("same").at("difference");
    EXPECT_EQ(same.at("differs"), false);
    EXPECT_THAT(lamp("same").at("says"), HasSubstr("the same light; no difference beyond the noise of the tables, 0.8"));
    EXPECT_EQ(real_changes("same"), 0U) << "noise moves areas by more than calculation leaves open, and is no difference of readings";
}

} // namespace
} // namespace fernlicht
