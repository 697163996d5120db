// The play loop with a picture that is made up: no GPU, so that what the loop does can be told exactly.
#include "runner/files/output_folder.h"
#include "runner/play/play.h"
#include "runner/play/preparation.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "tests/runner/program.h"

#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>

namespace fernlicht {
namespace {

TEST(Capture, TakesTheFirstTickAtOrAfterEachInterval) {
    const Capture twice_a_second{};
    std::vector<int> captured;
    for (int tick = 0; tick < 91; ++tick)
        if (is_captured(twice_a_second, tick, 1.0 / 30.0))
            captured.push_back(tick);
    EXPECT_EQ(captured, (std::vector<int>{0, 15, 30, 45, 60, 75, 90}));
    Capture none{.per_second = 0.0};
    EXPECT_TRUE(is_captured(none, 0, 0.1));
    EXPECT_FALSE(is_captured(none, 1, 0.1));
    Capture all{.all = true};
    EXPECT_TRUE(is_captured(all, 17, 0.1));
    Capture often{.per_second = 1000.0};
    EXPECT_TRUE(is_captured(often, 1, 0.1));
}

TEST(Capture, FileNamesKeepToPlainLetters) {
    EXPECT_EQ(file_name_of("driver"), "driver");
    EXPECT_EQ(file_name_of("../../etc/passwd"), "_._.._etc_passwd");
    EXPECT_EQ(file_name_of("<script>\n"), "_script__");
    EXPECT_EQ(file_name_of(""), "_");
    EXPECT_LE(file_name_of(std::string(500, 'x')).size(), 80U);
}

TEST(Writers, DoEverythingAndReportTheFirstFailureAtTheNextSubmit) {
    std::atomic<int> done{0};
    {
        Writers writers(2, 3);
        for (int i = 0; i < 50; ++i)
            writers.submit([&] { ++done; });
        writers.finish();
        EXPECT_EQ(done, 50);
        writers.submit([] { throw std::runtime_error("full disk"); });
        EXPECT_THROW(writers.finish(), std::runtime_error);
        writers.submit([&] { ++done; }); // goes on afterwards
        writers.finish();
    }
    EXPECT_EQ(done, 51);
    Writers writers(1, 2);
    writers.submit([] { throw std::runtime_error("full disk"); });
    bool thrown = false;
    for (int i = 0; i < 1000 && !thrown; ++i) {
        try {
            writers.submit([] {});
        } catch (const std::runtime_error&) {
            thrown = true;
        }
    }
    try {
        writers.finish();
    } catch (const std::runtime_error&) {
        thrown = true;
    }
    EXPECT_TRUE(thrown);
}

Stage stage_of(const char* name) {
    DriveEdits edits{.resolution = std::pair(160, 120)};
    Drive drive = read_drive(std::string(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/") + name, edits);
    drive.capture.exr = drive.capture.png = true;
    return Stage(std::move(drive));
}

TEST(Preparation, AMomentForEachSetOfLampsThatShine) {
    const Stage stage = stage_of("first-light.yaml"); // high beam from 5 s to 8 s
    const std::vector<Moment> moments = distinct_moments(stage.drive, stage.route, stage.drive.lamp_sets[0], {});
    ASSERT_EQ(moments.size(), 2U);
    EXPECT_EQ(moments[0].tick, 0);
    EXPECT_NEAR(moments[1].time_s, 5.0, stage.drive.step_s);
    EXPECT_EQ(distinct_moments(stage.drive, stage.route, stage.drive.lamp_sets[0], {0, 30}).size(), 1U);
}

// With lamps of others there could be 228 variants here, one for each case of light on each kind of surface.
TEST(Preparation, OnlyWhatTheDriveShowsIsCompiledWhereOthersHaveLamps) {
    const Stage stage = stage_of("adaptive-motorway.yaml");
    const LampSet& dipped = stage.drive.lamp_sets[0];
    const TickRange ticks{0, 20};
    Device device = open_device("auto");
    RendererSettings settings{.technique = "photometric"};
    settings.shadows.width = settings.shadows.height = 64;
    Renderer renderer(device, stage.scene, settings);
    prepare(renderer, stage.drive, stage.route, dipped, ticks);
    const int compiled = renderer.compiled_programs();
    EXPECT_LT(compiled, 120);
    const std::vector<Moment> moments = moments_at({0, 20}, stage, dipped);
    for (const Moment& moment : moments)
        for (const auto& [view, outputs] : pictures_of(stage.drive))
            renderer.render(moment, view, outputs);
    renderer.finish();
    EXPECT_EQ(renderer.compiled_programs(), compiled);
    renderer.keep_programs_of(moments);
    prepare(renderer, stage.drive, stage.route, dipped, ticks);
    EXPECT_EQ(renderer.compiled_programs(), compiled);
    LampSet another = dipped; // a file of its own on the same grid
    for (MountedLamp& lamp : another.lamps)
        lamp.file = std::make_shared<const LampFile>(*lamp.file);
    prepare(renderer, stage.drive, stage.route, another, ticks);
    EXPECT_EQ(renderer.compiled_programs(), compiled);
    renderer.keep_programs_of({});
    prepare(renderer, stage.drive, stage.route, dipped, {0, 0});
    EXPECT_GT(renderer.compiled_programs(), compiled);
}

TEST(Preparation, NothingCompilesWhileADriveIsPlayed) {
    for (const char* technique : {"photometric", "two-pass-projective"}) {
        const Stage stage = stage_of("first-light.yaml");
        Device device = open_device("auto");
        RendererSettings settings{.technique = technique};
        settings.shadows.width = settings.shadows.height = 64;
        Renderer renderer(device, stage.scene, settings);
        for (const LampSet& lamp_set : stage.drive.lamp_sets) {
            prepare(renderer, stage.drive, stage.route, lamp_set, {});
            const int compiled = renderer.compiled_programs();
            EXPECT_GT(compiled, 0);
            State state = start(stage.drive);
            for (int tick = 0; tick < tick_count(stage.drive); ++tick, state = advance(state, stage.drive)) {
                if (tick % 40 != 0)
                    continue;
                const Moment moment = moment_at(state, stage.drive, stage.route, lamp_set);
                for (const auto& [view, outputs] : pictures_of(stage.drive))
                    renderer.render(moment, view, outputs);
            }
            renderer.finish();
            EXPECT_EQ(renderer.compiled_programs(), compiled) << technique << ", " << lamp_set.name;
        }
    }
}

} // namespace

} // namespace fernlicht
