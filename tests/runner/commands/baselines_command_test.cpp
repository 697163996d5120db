// `fernlicht baselines` and `accept` through the program, on small runs that were never drawn.
#include "runner/commands/accept_command.h"
#include "tests/runner/program.h"
#include "tests/runner/stored_run.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using tests::StoredRun;

class BaselinesCommand : public ::testing::Test {
  protected:
    Outcome baselines(const std::string& arguments) const { return run_program("baselines " + arguments + " --baselines '" + store + "'"); }
    Outcome accept(const StoredRun& what, const std::string& arguments = "") const {
        return run_program("accept '" + what.folder.string() + "' --baselines '" + store + "' " + arguments);
    }
    json listed() const { return json::parse(baselines("list --json").output); }
    std::string id_of(const std::string& lamp_set) const {
        for (const json& entry : listed())
            if (entry.at("key").at("lamp_set") == lamp_set)
                return entry.at("id").get<std::string>();
        return "none";
    }
    std::size_t files() const {
        std::size_t count = 0;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(store))
            count += entry.is_regular_file() ? 1U : 0U;
        return count;
    }

    TemporaryFolder temporary;
    const std::string store = temporary / "store";
    const StoredRun run{temporary.path() / "run"};
    const StoredRun brighter{temporary.path() / "brighter", 1.02};
};

TEST_F(BaselinesCommand, ListsWhatIsAccepted) {
    EXPECT_EQ(baselines("list").exit_code, 2);
    EXPECT_THAT(baselines("list").output, HasSubstr("is no folder, expected one that `fernlicht accept` made"));
    fs::create_directories(store);
    EXPECT_EQ(baselines("list").output, "nothing is accepted in " + store + "\n");
    EXPECT_EQ(baselines("list").exit_code, 0);
    ASSERT_EQ(accept(run, "--note 'the first ones'").exit_code, 0);
    const Outcome list = baselines("list");
    EXPECT_EQ(list.exit_code, 0);
    EXPECT_THAT(list.output, ContainsRegex("id +drive/lamp set/technique +device +played +note"));
    EXPECT_THAT(list.output, HasSubstr(id_of("halogen").substr(0, 12) + "  straight/halogen/photometric"));
    EXPECT_THAT(list.output, HasSubstr("software, llvmpipe (LLVM 15.0.6, 256 bits), avx2  2026-01-31T22:15:00Z  the first ones"));
    EXPECT_EQ(std::ranges::count(list.output, '\n'), 3);
    EXPECT_EQ(listed().size(), 2U);
}

TEST_F(BaselinesCommand, ShowsWhoMadeAResultAndWhatItHolds) {
    ASSERT_EQ(accept(run).exit_code, 0);
    const std::string halogen = id_of("halogen");
    for (const std::string& word : {halogen.substr(0, 6), std::string("straight/halogen")}) {
        const Outcome show = baselines("show " + word);
        EXPECT_EQ(show.exit_code, 0) << word;
        EXPECT_THAT(show.output, ContainsRegex("id +" + halogen));
        EXPECT_THAT(show.output, ContainsRegex("reach_5lx_road_own_m +60 +m +1"));
        EXPECT_THAT(show.output, ContainsRegex("reach_1lx_road_own_m +not measured"));
        EXPECT_THAT(show.output, ContainsRegex("input road +hash of the road"));
        EXPECT_THAT(show.output, Not(HasSubstr("frame_time")));
    }
    const json shown = json::parse(baselines("show straight/xenon --json").output);
    EXPECT_EQ(shown.at("producer").at("cpu"), "Some CPU @ 2 GHz (avx2)");
    EXPECT_EQ(shown.at("frames").size(), 2U);
    EXPECT_TRUE(fs::exists(shown.at("frames")[0].at("file").get<std::string>()));
}

TEST_F(BaselinesCommand, AWordThatMeansSeveralOrNothingIsRefused) {
    ASSERT_EQ(accept(run).exit_code, 0);
    const Outcome several = baselines("show straight");
    EXPECT_EQ(several.exit_code, 2);
    EXPECT_THAT(several.output, HasSubstr("'straight' means 2: "));
    EXPECT_THAT(several.output, HasSubstr(id_of("xenon").substr(0, 12)));
    const Outcome none = baselines("show straight/xenno/photometric");
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.output, HasSubstr("the nearest is straight/xenon/photometric"));
    EXPECT_EQ(baselines("show " + id_of("xenon").substr(0, 3)).exit_code, 2) << "three digits are no id";
    EXPECT_EQ(baselines("show stra").exit_code, 2) << "a part of a name is none";
    EXPECT_EQ(run_program("baselines show straight --baselines " + (temporary / "nowhere")).exit_code, 2);
}

TEST_F(BaselinesCommand, ComparesWithARunAndWithAnotherResult) {
    ASSERT_EQ(accept(run).exit_code, 0);
    const Outcome same = baselines("diff straight/halogen '" + run.folder.string() + "'");
    EXPECT_EQ(same.exit_code, 0) << same.output;
    EXPECT_EQ(same.output, "2 of 2 readings agree\n4 of 4 channels of pictures agree\n");
    EXPECT_THAT(baselines("diff straight/halogen --all '" + run.folder.string() + "'").output, HasSubstr("illuminance.lx identical"));
    const Outcome other = baselines("diff straight/halogen '" + brighter.folder.string() + "'");
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_THAT(other.output,
                HasSubstr("DIFFERS    reach_5lx_road_own_m: 61.2 m, accepted 60 m, off by 1.2 m (2 %), allowed for rounding: 0.0601 m\n"));
    EXPECT_THAT(other.output, HasSubstr("DIFFERS    10 driver: illuminance.lx: maximum 1.48 at pixel 63, 0"));
    EXPECT_THAT(other.output, HasSubstr("1 of 2 readings agree\n"));
    EXPECT_THAT(other.output, HasSubstr("0 of 4 channels of pictures agree\n"));
    ASSERT_EQ(accept(brighter, "--also --note 'another driver'").exit_code, 0);
    const std::string first = id_of("halogen");
    std::string second;
    for (const json& entry : listed())
        if (entry.at("key").at("lamp_set") == "halogen" && entry.at("id") != first)
            second = entry.at("id").get<std::string>();
    EXPECT_EQ(baselines("diff " + first + " " + second).exit_code, 1);
    EXPECT_EQ(baselines("diff " + first + " " + first).exit_code, 0);
    EXPECT_THAT(baselines("diff " + first + " " + id_of("xenon")).output,
                HasSubstr("straight/halogen/photometric against straight/xenon/photometric\n"));
}

TEST_F(BaselinesCommand, ReadingsAloneAreAThousandthOfTheSize) {
    const Outcome accepted = accept(run, "--readings-only");
    EXPECT_EQ(accepted.exit_code, 0);
    EXPECT_THAT(accepted.output, HasSubstr("2 lamp sets with 0 frames and 4 readings; frames were left out\n"));
    EXPECT_EQ(files(), 3U);
    EXPECT_THAT(baselines("show straight/halogen").output, HasSubstr("accepted without pictures\n"));
    EXPECT_TRUE(json::parse(baselines("show straight/halogen --json").output).at("frames").is_null());
    const Outcome same = baselines("diff straight/halogen '" + run.folder.string() + "'");
    EXPECT_EQ(same.exit_code, 0);
    EXPECT_EQ(same.output,
              "2 of 2 readings agree\npictures are not compared: " + id_of("halogen").substr(0, 12) + " was accepted without\n");
    EXPECT_EQ(baselines("diff straight/halogen '" + brighter.folder.string() + "'").exit_code, 1);
}

TEST_F(BaselinesCommand, RemovesAResultAndTheFilesThatNothingElseNeeds) {
    ASSERT_EQ(accept(run).exit_code, 0);
    const std::size_t before = files();
    const std::string halogen = id_of("halogen");
    const Outcome dry = baselines("remove --dry-run " + halogen.substr(0, 8));
    EXPECT_EQ(dry.exit_code, 0);
    EXPECT_THAT(dry.output, HasSubstr("would remove 1 baseline and 1 file of "));
    EXPECT_EQ(files(), before);
    EXPECT_EQ(listed().size(), 2U);
    EXPECT_EQ(baselines("remove " + halogen.substr(0, 8)).exit_code, 0);
    EXPECT_EQ(listed().size(), 1U);
    EXPECT_EQ(files(), before - 1) << "the frames are the xenon's, too: equal bytes are stored once";
    EXPECT_EQ(baselines("diff straight/xenon '" + run.folder.string() + "'").exit_code, 0) << "what stays is whole";
    EXPECT_EQ(baselines("remove straight/xenon").exit_code, 0);
    EXPECT_EQ(files(), 1U) << "the index alone";
    EXPECT_EQ(baselines("remove straight/xenon").exit_code, 2);
    EXPECT_EQ(baselines("remove").exit_code, 2);
}

TEST_F(BaselinesCommand, WhatAKilledAcceptanceLeftGoesToo) {
    ASSERT_EQ(accept(run).exit_code, 0);
    const std::size_t before = files();
    fs::create_directories(store + "/objects/ab");
    std::ofstream(store + "/objects/ab/cdef.part-1") << "half a frame";
    EXPECT_EQ(baselines("remove --unreferenced").exit_code, 0);
    EXPECT_EQ(files(), before);
    EXPECT_EQ(listed().size(), 2U);
}

TEST_F(BaselinesCommand, OtherResultsNeedADecisionAndSeveralNeedAReason) {
    ASSERT_EQ(accept(run).exit_code, 0);
    const Outcome undecided = accept(brighter);
    EXPECT_EQ(undecided.exit_code, 2);
    EXPECT_THAT(undecided.output, HasSubstr("--replace, if these are right in their place, or --also, if either is right"));
    EXPECT_THAT(accept(brighter, "--also").output, HasSubstr("found no --note"));
    EXPECT_EQ(accept(brighter, "--also --replace --note both").exit_code, 2);
    EXPECT_EQ(listed().size(), 2U);
    EXPECT_THAT(accept(run).output, HasSubstr("straight/halogen/photometric: accepted before"));
    const Outcome replaced = accept(brighter, "--replace --note 'brighter lamps'");
    EXPECT_EQ(replaced.exit_code, 0);
    EXPECT_THAT(replaced.output, HasSubstr("straight/halogen/photometric: new, in place of 1"));
    EXPECT_EQ(listed().size(), 2U);
    EXPECT_EQ(listed()[0].at("note"), "brighter lamps");
}

TEST_F(BaselinesCommand, AtOnceIsOneAfterTheOther) {
    std::string line;
    for (const StoredRun* one : {&run, &brighter, &run, &brighter})
        line += "'" FERNLICHT_BINARY "' accept '" + one->folder.string() + "' --baselines '" + store + "' --also --note race & ";
    EXPECT_EQ(run_shell("(" + line + " wait)").exit_code, 0);
    EXPECT_EQ(listed().size(), 4U) << "two lamp sets, two results each";
    for (const json& entry : listed())
        EXPECT_NO_THROW(load_baseline(store, choose_baseline(store, entry.at("id"))));
}

/// The worked example's lamp, 206.25 cd everywhere within 30 degrees, with 5 % less between 5 and 15 degrees to the right, 3 to 15 down.
std::string dimmer_zone() {
    std::string text = "# unit: lx\n# distance_m: 25\n# angles: goniometer\n# screen: spherical\n";
    for (int h = -30; h <= 30; h += 1)
        text += "," + std::to_string(h);
    for (int v = 30; v >= -30; v -= 1) {
        text += "\n" + std::to_string(v);
        for (int h = -30; h <= 30; h += 1)
            text += h >= 5 && h <= 15 && v <= -3 && v >= -15 ? ",0.3135" : ",0.33";
    }
    return text + "\n";
}

// Seven pictures of the same light by other seeds are pictures of the same, in all 21 pairs; 5 % less light in one zone is not.
TEST_F(BaselinesCommand, PicturesByRaysAreComparedByTheirOwnNoise) {
    const auto draw = [&](const std::string& name, const std::string& arguments) {
        const Outcome drawn =
            run_program("reference " + library_file("drives/worked-example.yaml") +
                        " --moment 0.1 --resolution 48x36 --target-error 2% --quiet --out " + (temporary / name) + arguments);
        EXPECT_EQ(drawn.exit_code, 0) << drawn.output;
    };
    constexpr int seeds = 7;
    const auto picture = [&](int seed) { return temporary / ("seed-" + std::to_string(seed)); };
    for (int seed = 1; seed <= seeds; ++seed)
        draw("seed-" + std::to_string(seed), " --seed " + std::to_string(seed));
    for (int seed = 1; seed <= seeds; ++seed)
        for (int other = seed + 1; other <= seeds; ++other)
            for (const ResultDifference& difference : compare_frames({{1, "driver", fs::path(picture(other)) / "reference.exr", ""}},
                                                                     {{1, "driver", fs::path(picture(seed)) / "reference.exr", ""}}, {}))
                EXPECT_EQ(difference.agreement, Agreement::agrees) << seed << ", " << other << ": " << difference.text;
    const Outcome accepted = run_program("accept '" + picture(1) + "' --baselines " + store);
    ASSERT_EQ(accepted.exit_code, 0) << accepted.output;
    EXPECT_THAT(accepted.output, HasSubstr("worked-example-1/lamps/reference-direct: new"));
    EXPECT_EQ(baselines("diff worked-example-1 '" + picture(1) + "'").exit_code, 0);
    const Outcome same = baselines("diff worked-example-1 --all '" + picture(2) + "'");
    EXPECT_EQ(same.exit_code, 0) << same.output;
    EXPECT_THAT(same.output, ContainsRegex("illuminance.lx: z of the worst of [0-9]+ squares of 4 pixels .* left out [1-9][0-9]* of"));
    EXPECT_THAT(same.output, Not(HasSubstr("identical")));
    std::ofstream(temporary / "zone.csv") << dimmer_zone();
    draw("zone", " --seed 2 --lamp " + (temporary / "zone.csv"));
    const Outcome other = baselines("diff worked-example-1 '" + (temporary / "zone") + "'");
    EXPECT_EQ(other.exit_code, 1) << other.output;
    EXPECT_THAT(other.output, HasSubstr("worked-example-1/lamps/reference-direct against worked-example-1/zone/reference-direct"));
    EXPECT_THAT(other.output, ContainsRegex("DIFFERS .*illuminance.lx: z of the worst of .* [1-9][0-9]* beyond;"));
    EXPECT_THAT(other.output, HasSubstr("another "));
}

TEST_F(BaselinesCommand, BaselineAndBaselinesLeadToEachOther) {
    const Outcome drawn = run_program("reference list");
    EXPECT_EQ(drawn.exit_code, 2);
    EXPECT_THAT(drawn.output, HasSubstr("`fernlicht baselines list`"));
    for (const std::string arguments : {"baselines", "baselines straight.yaml"}) {
        const Outcome asked = run_program(arguments);
        EXPECT_EQ(asked.exit_code, 2);
        EXPECT_THAT(asked.output, HasSubstr("list, show, diff or remove; `fernlicht reference DRIVE` ray-traces a moment"));
    }
}

} // namespace
} // namespace fernlicht
