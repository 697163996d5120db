#include "renderer/device.h"
#include "renderer/gl/device/program.h"
#include "renderer/gpu_timer.h"
#include "scenarios/values/errors.h"
#include "tests/renderer/device_test.h"
#include "tests/renderer/reference/rooms.h"
#include "tests/trial.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

/// A wall of two by two metres, ten metres ahead, under an even sky.
Scene wall() { return {.materials = {{}}, .meshes = {quads("wall", 0, {}, {{{10, 1, -1}, {10, -1, -1}, {10, -1, 1}, {10, 1, 1}}})}}; }

class RenderTest : public DeviceTest {
  protected:
    RenderTest() {
        moment_.daylight.horizontal_illuminance_lx = 10.0;
        view_.width_px = 64;
        view_.height_px = 48;
    }
    Scene scene_ = wall();
    Moment moment_;
    View view_;
};

TEST_F(RenderTest, DrawsWithTheProgramOfAFrameAndLeavesNothingBehind) {
    constexpr FrameOutputs outputs{.colour = true, .illuminance = true};
    const Frame expected = Renderer(device_, scene_, {}).draw(moment_, view_, outputs);
    ASSERT_GT(expected.illuminance_lx.at(32, 24), 0.0F);
    Renderer used(device_, scene_, {});
    const int before = used.compiled_programs();
    for (int i = 0; i < 3; ++i)
        used.render(moment_, view_, outputs);
    used.finish();
    const int after = used.compiled_programs();
    EXPECT_GT(after, before);
    const Frame frame = used.draw(moment_, view_, outputs);
    EXPECT_EQ(used.compiled_programs(), after);
    EXPECT_EQ(std::tuple(frame.colour, frame.illuminance_lx), std::tuple(expected.colour, expected.illuminance_lx));
}

TEST_F(RenderTest, TheGpusClockSumsPiecesAndStartsAgain) {
    Renderer renderer(device_, scene_, {});
    GpuTimer timer(device_);
    EXPECT_EQ(timer.seconds(), 0.0);
    for (int i = 0; i < 2; ++i) {
        timer.begin();
        renderer.render(moment_, view_, {.colour = true});
        timer.end();
    }
    const double sum = timer.seconds();
    EXPECT_TRUE(std::isfinite(sum));
    EXPECT_GT(sum, 0.0);
    EXPECT_EQ(timer.seconds(), 0.0);
}

TEST(Device, NamesWhatItDoesNotKnowOrHave) {
    for (const char* name : {"", "vulkan", "egl-device=", "egl-device=x", "egl-device=-1", "egl-device=99999", "EGL"})
        EXPECT_THROW(open_device(name), InputError) << name;
    EXPECT_THAT(tests::refusal_of<DeviceError>([] { open_device("egl-device=99"); }), testing::HasSubstr("EGL devices"));
}

TEST(Device, TriesEveryBackendAndOneWorks) {
    int working = 0;
    for (const BackendAttempt& attempt : try_all_backends()) {
        EXPECT_NE(attempt.works, attempt.info.gl_version.empty());
        EXPECT_NE(attempt.works, !attempt.failure.empty()) << attempt.backend;
        working += attempt.works ? 1 : 0;
    }
    EXPECT_GE(working, 1);
}

TEST(Device, SoftwareDrawsOnTheCpuAndOneOpensAfterAnother) {
    EXPECT_TRUE(open_device("software").info().software);
    for (int i = 0; i < 3; ++i)
        EXPECT_FALSE(open_device("auto").info().gl_renderer.empty());
}

TEST(Program, AnErrorNamesFileAndLine) {
    Device device = open_device("auto");
    const std::vector<gl::Program::Define> broken{{"LAMP_COUNT", "1"}, {"WANT_COLOUR", "nonsense("}};
    // The condition in an included file cannot be read: the message names that file.
    EXPECT_THAT(tests::refusal_of<DeviceError>([&] { gl::Program(device.context(), "naive.vert.glsl", "naive.frag.glsl", broken); }),
                testing::HasSubstr("outputs.glsl:"));
}

} // namespace
} // namespace fernlicht
