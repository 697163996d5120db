#include "runner/judge/cell_inputs.h"

#include "tests/runner/program.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using Inputs = std::vector<std::pair<std::string, std::string>>;

const FilesRead road{{"road.xodr", 3, "a hash"}};

Inputs inputs_of(const Drive& drive, std::size_t variant = 0, int last_tick = 9) {
    return cell_inputs(drive, drive.variants.at(variant), road, 0, last_tick);
}

TEST(CellInputs, WhatChangesResultsCountsAndNothingElse) {
    const Drive drive = read_drive(library_file("drives/straight.yaml"), {});
    ASSERT_GE(drive.variants.size(), 2U);
    const Inputs before = inputs_of(drive);
    ASSERT_GE(before.size(), 3U);
    EXPECT_EQ(before[0].first, "drive");
    EXPECT_EQ(before[1].first, "road");
    EXPECT_EQ(before[2].first, "lamp file 1");
    Drive other = drive;
    other.title = "another title";
    other.limits.clear();
    other.road_file = "/elsewhere/road.xodr";
    other.variants.pop_back();
    for (LampSource& source : other.lamp_sources)
        source.path = "/elsewhere" / source.path.filename();
    EXPECT_EQ(inputs_of(other), before);
    EXPECT_NE(inputs_of(drive, 1), before);
    EXPECT_NE(inputs_of(drive, 0, 8), before) << "other moments";
    EXPECT_NE(cell_inputs(drive, drive.variants[0], {{"road.xodr", 3, "another hash"}}, 0, 9)[1], before[1]);
    Drive other_other = drive;
    other_other.views.front().width_px += 1;
    EXPECT_NE(inputs_of(other_other)[0], before[0]);
    other_other = drive;
    other_other.variants[0].lamps[0].pitch_rad += 1e-9;
    EXPECT_NE(inputs_of(other_other)[0], before[0]);
    other_other = drive;
    for (LampSource& source : other_other.lamp_sources)
        if (source.file == other_other.variants[0].lamps[0].file) {
            auto changed = std::make_shared<LampFile>(*source.file);
            changed->opened.front().xxh128 = "other bytes";
            source.file = changed;
            for (MountedLamp& lamp : other_other.variants[0].lamps)
                lamp.file = changed;
        }
    EXPECT_NE(inputs_of(other_other)[2], before[2]);
    EXPECT_EQ(inputs_of(other_other)[0], before[0]) << "a lamp's bytes are told from the drive's";
}

} // namespace
} // namespace fernlicht
