#include "runner/judge/input_hashes.h"

#include "scenarios/drives/play/advance.h"
#include "scenarios/studies/study.h"
#include "tests/runner/program.h"
#include "tests/trial.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>

namespace fernlicht {
namespace {

using Inputs = std::vector<std::pair<std::string, std::string>>;

const FilesRead road{{"road.xodr", 3, "a hash"}};

Inputs inputs_of(const Drive& drive, std::size_t lamp_set = 0, int last_tick = 9) {
    return input_hashes(drive, drive.lamp_sets.at(lamp_set), road, 0, last_tick);
}

TEST(CellInputs, WhatChangesResultsCountsAndNothingElse) {
    const Drive drive = read_drive(library_file("drives/straight.yaml"), {});
    ASSERT_GE(drive.lamp_sets.size(), 2U);
    const Inputs before = inputs_of(drive);
    ASSERT_GE(before.size(), 3U);
    EXPECT_EQ(before[0].first, "drive");
    EXPECT_EQ(before[1].first, "road");
    EXPECT_EQ(before[2].first, "lamp file 1");
    Drive other = drive;
    other.title = "another title";
    other.limits.clear();
    other.road_file = "/elsewhere/road.xodr";
    other.lamp_sets.pop_back();
    for (LampSource& source : other.lamp_sources)
        source.path = "/elsewhere" / source.path.filename();
    EXPECT_EQ(inputs_of(other), before);
    EXPECT_NE(inputs_of(drive, 1), before);
    EXPECT_NE(inputs_of(drive, 0, 8), before) << "other moments";
    EXPECT_NE(input_hashes(drive, drive.lamp_sets[0], {{"road.xodr", 3, "another hash"}}, 0, 9)[1], before[1]);
    Drive other_other = drive;
    other_other.views.front().width_px += 1;
    EXPECT_NE(inputs_of(other_other)[0], before[0]);
    other_other = drive;
    other_other.lamp_sets[0].lamps[0].pitch_rad += 1e-9;
    EXPECT_NE(inputs_of(other_other)[0], before[0]);
    other_other = drive;
    for (LampSource& source : other_other.lamp_sources)
        if (source.file == other_other.lamp_sets[0].lamps[0].file) {
            auto changed = std::make_shared<LampFile>(*source.file);
            changed->opened.front().xxh128 = "other bytes";
            source.file = changed;
            for (MountedLamp& lamp : other_other.lamp_sets[0].lamps)
                lamp.file = changed;
        }
    EXPECT_NE(inputs_of(other_other)[2], before[2]);
    EXPECT_EQ(inputs_of(other_other)[0], before[0]) << "a lamp's bytes are told from the drive's";
}

TEST(CellInputs, LevelsOfPixelsCountByTheirContentNotByTheirPlace) {
    const auto inputs = [&](const std::string& level) {
        const auto folder = tests::new_folder();
        tests::written("levels.csv", "0 1 1\n1 0 " + level + "\n", folder);
        tests::written(
            "pixels.yaml",
            "fernlicht_pixel_lamp: 1\nraster: {pixels: [2, 1], h_deg: [-4, 4], v_deg: [-1, 1], spread_deg: [0.2, 0.2], cd: 1000}\n",
            folder);
        return inputs_of(read_drive(tests::written("drive.yaml",
                                                   "fernlicht: 1\nname: one\nroad: " + library_file("roads/straight.xodr") +
                                                       "\nspeed_kmh: 72\nduration_s: 3\nlamp_sets:\n  one: {lamps: {left: {file: "
                                                       "pixels.yaml, levels: levels.csv}}}\n",
                                                   folder)));
    };
    const Inputs before = inputs("0.5");
    EXPECT_EQ(inputs("0.5"), before) << "in another folder";
    EXPECT_NE(inputs("0.25"), before);
}

TEST(CellInputs, ARecipeCountsByItsContentNotByItsPlace) {
    const std::string grid = "V;-1;1\n-1;500;500\n1;500;500\n";
    const std::string recipe = "fernlicht_recipe: 1\nlayout: matrix\ndelimiter: semicolon\nunit: cd\n";
    const auto inputs = [&](const std::string& recipe_text) {
        const auto folder = tests::new_folder();
        DriveEdits edits;
        edits.lamps = {{"", tests::written("grid.txt", grid, folder)}};
        edits.lamp_recipe = tests::written("recipe.yaml", recipe_text, folder);
        return inputs_of(read_drive(library_file("drives/straight.yaml"), edits));
    };
    const Inputs before = inputs(recipe);
    EXPECT_EQ(inputs(recipe), before) << "in another folder";
    EXPECT_EQ(inputs(recipe + "title: another\n")[0], before[0]);
    EXPECT_NE(inputs(recipe + "title: another\n")[2], before[2]);
}

// By this `fernlicht migrate` finds the drives of its baselines: a few of those that version 0.1 shipped, of whole drives and of five
// moments.
TEST(CellInputs, TextsAreHashedAsVersion01HashedThem) {
    std::set<std::string> hashes;
    const Study study = read_study(library_file("studies/standard.yaml"));
    for (const StudyCell& cell : cells_of(study)) {
        Drive drive = cell_drive(study, cell);
        drive.dressing = Dressing::plain; // as all were then
        for (const int last_tick : {4, tick_count(drive) - 1}) {
            const std::string text = text_hashed_before(drive) + fmt::format("moments: [0, {}]\n", last_tick);
            hashes.insert(content_hash(text.data(), text.size()));
        }
    }
    for (const char* shipped : {"e0c951e68b5f8766076a44e35e2c0a45", "75854be0867f440f7b3612808d57f391", "8b6c595e62c09bb408d8f048e9075833",
                                "529a4e3e1071bc2873b075b1f5b0a8ec"})
        EXPECT_TRUE(hashes.contains(shipped)) << shipped;
}

} // namespace
} // namespace fernlicht
