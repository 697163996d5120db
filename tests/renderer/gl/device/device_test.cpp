#include "renderer/device.h"

#include "renderer/gl/device/program.h"
#include "scenarios/values/errors.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(Device, RefusesABackendThatItDoesNotKnow) {
    for (const char* name : {"", "vulkan", "egl-device=", "egl-device=x", "egl-device=-1", "egl-device=99999", "EGL"})
        EXPECT_THROW(open_device(name), InputError) << name;
}

TEST(Device, NamesTheCountOfDevicesForOneThatIsNotThere) {
    try {
        open_device("egl-device=99");
        FAIL();
    } catch (const DeviceError& error) {
        EXPECT_NE(std::string(error.what()).find("EGL devices"), std::string::npos) << error.what();
    }
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

TEST(Device, SoftwareDrawsOnTheCpuWhateverElseThereIs) { EXPECT_TRUE(open_device("software").info().software); }

TEST(Device, AfterOneIsClosedAnotherCanBeOpened) {
    for (int i = 0; i < 3; ++i)
        EXPECT_FALSE(open_device("auto").info().gl_renderer.empty());
}

TEST(Program, AnErrorNamesFileAndLine) {
    Device device = open_device("auto");
    try {
        // The condition in an included file cannot be read: the message names that file.
        gl::Program(device.context(), "naive.vert.glsl", "naive.frag.glsl", {{"LAMP_COUNT", "1"}, {"WANT_COLOUR", "nonsense("}});
        FAIL();
    } catch (const DeviceError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("outputs.glsl:"), std::string::npos) << text;
    }
}

} // namespace
} // namespace fernlicht
