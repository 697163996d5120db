#include "renderer/gl/device/program.h"
#include "tests/renderer/device_test.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using ShaderProgram = DeviceTest;

// What is wrong lies in an included file: it is named, with its line, and not by the driver's number.
TEST_F(ShaderProgram, NamesFileAndLineOfAnError) {
    try {
        const gl::Program program(device_.context(), "lamp_face.vert.glsl", "lamp_face.frag.glsl",
                                  {{"WANTED", "1"}, {"TONE_KIND", "no_such_name"}, {"TONE_L_MAX", "1.0"}, {"TONE_S", "1.0"}});
        ADD_FAILURE() << "compiled";
    } catch (const DeviceError& error) {
        std::ifstream file(FERNLICHT_SOURCE_DIR "/renderer/shaders/outputs.glsl");
        int line = 1;
        for (std::string text; std::getline(file, text) && text.find("TONE_KIND == 0") == std::string::npos;)
            ++line;
        EXPECT_THAT(error.what(), testing::HasSubstr("lamp_face.frag.glsl does not compile on "));
        EXPECT_THAT(error.what(), testing::HasSubstr(": outputs.glsl:" + std::to_string(line)));
    }
}

} // namespace
} // namespace fernlicht
