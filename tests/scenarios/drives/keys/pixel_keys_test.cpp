// Pixel lamps in drives: levels from a file, and what cannot stand beside them.
#include "scenarios/lamps/level_track.h"
#include "tests/scenarios/drives/drive_fixture.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

class PixelKeys : public DriveFixture {
  protected:
    PixelKeys() {
        write_file(folder / "pixels.yaml",
                   "fernlicht_pixel_lamp: 1\nraster: {pixels: [2, 1], h_deg: [-4, 4], v_deg: [-1, 1], spread_deg: [0.2, 0.2], cd: 1000}\n");
        write_file(folder / "levels.csv", "0, 1, 1\n1, 0, 0.5\n");
    }
    const std::string head = "fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 3\n";
    std::string lamps(const std::string& high, const std::string& more = "") const {
        return head + "car: {mounts: {left: [3, 0, 1], high: [3, 0, 1]}}\nlamp_sets:\n  one: {lamps: {left: low.ies, high: {" + high +
               "}}" + more + "}\n";
    }
};

TEST_F(PixelKeys, LevelsAreReadAndWrittenBack) {
    const std::string yaml = lamps("file: pixels.yaml, levels: levels.csv");
    const Drive drive = read(yaml);
    const MountedLamp& lamp = drive.lamp_sets[0].lamps[1];
    ASSERT_NE(lamp.levels, nullptr);
    EXPECT_EQ(lamp.levels->levels(2.0), (std::vector{0.0F, 0.5F}));
    EXPECT_EQ(lamp.levels->opened().size(), 1U);
    EXPECT_THAT(drive.opened, testing::Contains(testing::Field(&FileRead::path, folder / "levels.csv")));
    const std::string written = write_drive(drive);
    EXPECT_EQ(write_drive(read(written)), written);
}

TEST_F(PixelKeys, WhatCannotStandBesideThemIsRefused) {
    const std::string levels = "file: pixels.yaml, levels: levels.csv";
    const auto masked = [](const std::string& windows) {
        return ", control: {high_beam: automatic, glare_free: {windows_deg: {high: " + windows + "}}}";
    };
    EXPECT_EQ(refusal(lamps("file: pixels.yaml", masked("pixels"))), "not refused");
    EXPECT_THAT(refusal(lamps("file: low.ies, levels: levels.csv")), HasSubstr("levels of a lamp without pixels"));
    EXPECT_THAT(refusal(lamps("file: pixels.yaml, levels: none.csv")), HasSubstr("there is no file"));
    EXPECT_THAT(refusal(lamps("file: low.ies", masked("pixels"))), HasSubstr("pixels of 'high', no pixel lamp, expected windows"));
    EXPECT_THAT(refusal(lamps("file: pixels.yaml", masked("[-1, 1]"))), HasSubstr("windows of 'high', a pixel lamp, expected pixels"));
    EXPECT_THAT(refusal(lamps(levels, masked("pixels"))), HasSubstr("whose levels come from a file"));
    EXPECT_THAT(refusal(lamps(levels, ", changes: [{at_s: 1, lamp: high, file: other.ies}]")),
                HasSubstr("another file for 'high', whose pixels have levels from a file"));
    EXPECT_THAT(refusal(lamps("file: pixels.yaml", masked("pixels") + ", changes: [{at_s: 1, lamp: high, file: other.ies}]")),
                HasSubstr("another file for 'high', whose beam is masked"));
    EXPECT_THAT(refusal(lamps(levels, ", control: {modes: {lamps: [high], v: {file: other.ies}}}")),
                HasSubstr("files of modes for 'high'"));
    EXPECT_THAT(refusal(lamps("file: pixels.yaml, between_samples: log_cd")), HasSubstr("its table is the sum of its pixels'"));
    EXPECT_THAT(refusal(lamps("file: pixels.yaml, type_c_axis: nadir")), HasSubstr("type_c_axis of a pixel lamp"));
    EXPECT_THAT(refusal(lamps("file: pixels.yaml, texture: {distance_m: 10}")), HasSubstr("texture of a pixel lamp"));
    DriveEdits edits;
    edits.lamps = {{"high", folder / "other.ies"}};
    EXPECT_THAT(refusal(lamps(levels), edits), HasSubstr("another file for 'high', whose pixels have levels from a file"));
    EXPECT_THAT(refusal(lamps("file: pixels.yaml", masked("pixels")), edits),
                HasSubstr("no pixel lamp for 'high', whose glare_free has pixels"));
}

} // namespace
} // namespace fernlicht
