// Nothing compiles once a drive is prepared: counted over whole drives as they are played.
#include "runner/play/preparation.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

Stage stage_of(const char* name) {
    DriveEdits edits{.resolution = std::pair(160, 120)};
    Drive drive = read_drive(std::string(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/") + name, edits);
    drive.capture.exr = drive.capture.png = true;
    return Stage(std::move(drive));
}

TEST(Preparation, AMomentForEachSetOfLampsThatShine) {
    const Stage stage = stage_of("first-light.yaml"); // high beam from 5 s to 8 s
    const std::vector<Moment> moments = distinct_moments(stage.drive, stage.route, stage.drive.variants[0], {});
    ASSERT_EQ(moments.size(), 2U);
    EXPECT_EQ(moments[0].tick, 0);
    EXPECT_NEAR(moments[1].time_s, 5.0, stage.drive.step_s);
    EXPECT_EQ(distinct_moments(stage.drive, stage.route, stage.drive.variants[0], {0, 30}).size(), 1U);
}

TEST(Preparation, NothingCompilesWhileADriveIsPlayed) {
    for (const char* technique : {"photometric", "two-pass-projective"}) {
        const Stage stage = stage_of("first-light.yaml");
        Device device = open_device("auto");
        RendererSettings settings{.technique = technique};
        settings.shadows.width = settings.shadows.height = 64;
        Renderer renderer(device, stage.scene, settings);
        for (const Variant& variant : stage.drive.variants) {
            prepare(renderer, stage.drive, stage.route, variant, {});
            const int compiled = renderer.compiled_programs();
            EXPECT_GT(compiled, 0);
            State state = start(stage.drive);
            for (int tick = 0; tick < tick_count(stage.drive); ++tick, state = advance(state, stage.drive)) {
                if (tick % 40 != 0)
                    continue;
                const Moment moment = moment_at(state, stage.drive, stage.route, variant);
                for (const auto& [view, wanted] : pictures_of(stage.drive))
                    renderer.render(moment, view, wanted);
            }
            renderer.finish();
            EXPECT_EQ(renderer.compiled_programs(), compiled) << technique << ", " << variant.name;
        }
    }
}

} // namespace
} // namespace fernlicht
