#include "runner/commands/model_command.h"
#include "scenarios/models/model.h"
#include "scenarios/values/errors.h"
#include "tests/runner/commands/written_flight.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using test::FlightWriter;
using testing::HasSubstr;

class Import : public testing::Test {
  protected:
    void SetUp() override {
        program_ = std::filesystem::path(FERNLICHT_BINARY).parent_path() / "fernlicht-import";
        if (!std::filesystem::exists(program_))
            GTEST_SKIP() << "built without OpenSceneGraph";
        folder_ = std::filesystem::path(testing::TempDir()) /
                  ("import_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override {
        if (!folder_.empty())
            std::filesystem::remove_all(folder_);
    }
    Model imported(const std::filesystem::path& file, char forward = 'y') {
        testing::internal::CaptureStdout();
        const int code = import_command({file, folder_ / "out.glb", forward, true, program_});
        said_ = testing::internal::GetCapturedStdout();
        EXPECT_EQ(code, 0);
        return read_model(folder_ / "out.glb");
    }
    std::string refusal(const std::string& bytes) {
        std::ofstream(folder_ / "bad.flt", std::ios::binary) << bytes;
        try {
            import_command({folder_ / "bad.flt", folder_ / "out.glb", 'y', true, program_});
        } catch (const InputError& error) {
            return error.what();
        }
        return "not refused";
    }
    std::filesystem::path folder_, program_;
    std::string said_;
};

TEST_F(Import, UnitsAxesAndColours) {
    FlightWriter flight(4); // feet
    flight.group("g");
    flight.push();
    flight.object();
    flight.push();
    flight.square(10.0, 100.0, 5.0, 0xFF8000);
    flight.pop();
    flight.pop();
    flight.write(folder_ / "feet.flt");
    const Model model = imported(folder_ / "feet.flt");
    EXPECT_EQ(model.triangles(), 2U);
    // 100 ft forward, 10 ft to the right, 5 ft up.
    EXPECT_NEAR(0.5 * (model.low_m.x + model.high_m.x), 30.48, 1e-5);
    EXPECT_NEAR(0.5 * (model.low_m.y + model.high_m.y), -3.048, 1e-5);
    EXPECT_NEAR(model.low_m.z, 1.524, 1e-5);
    EXPECT_NEAR(model.high_m.x - model.low_m.x, 0.6096, 1e-5);
    for (const Vertex& vertex : model.meshes.at(0).vertices)
        EXPECT_NEAR(vertex.normal.z, 1.0F, 1e-6F);
    const Material& paint = model.materials.at(model.meshes[0].batches.at(0).material);
    EXPECT_FLOAT_EQ(paint.albedo.r, 1.0F);
    EXPECT_NEAR(paint.albedo.g, 0.216F, 0.01F) << "128 of 255, made linear";
    EXPECT_EQ(paint.albedo.b, 0.0F);
    const Model place = imported(folder_ / "feet.flt", 'x');
    EXPECT_NEAR(0.5 * (place.low_m.x + place.high_m.x), 3.048, 1e-5);
    EXPECT_NEAR(0.5 * (place.low_m.y + place.high_m.y), 30.48, 1e-5);
}

TEST_F(Import, FinestLevelsSwitchesReferencesAndLamps) {
    FlightWriter part(0);
    part.group("p");
    part.push();
    part.object();
    part.push();
    part.square(0.0, 50.0, 0.0, 0x808080);
    part.pop();
    part.pop();
    part.write(folder_ / "part.flt");

    FlightWriter flight(0);
    flight.group("car");
    flight.push();
    for (const auto& [from, to, count] : {std::tuple(0.0, 100.0, 3), std::tuple(100.0, 1000.0, 1)}) {
        flight.level_of_detail(from, to);
        flight.push();
        flight.object();
        flight.push();
        for (int i = 0; i < count; ++i)
            flight.square(5.0 * i, 0.0, 0.0, 0x404040);
        flight.pop();
        flight.pop();
    }
    flight.switch_first();
    flight.push();
    for (const double z : {1.0, 2.0}) { // only the first is on
        flight.group("c");
        flight.push();
        flight.object();
        flight.push();
        flight.square(0.0, 0.0, z, 0x202020);
        flight.pop();
        flight.pop();
    }
    flight.pop();
    flight.external("part.flt");
    flight.group("h");
    flight.long_name("headlight_left");
    flight.push();
    flight.object();
    flight.push();
    flight.square(-0.7, 3.6, 0.65, 0xFFFFFF);
    flight.pop();
    flight.pop();
    flight.pop();
    flight.write(folder_ / "car.flt");
    const Model model = imported(folder_ / "car.flt");
    EXPECT_EQ(model.triangles(), 2U * (3 + 1 + 1 + 1)) << said_;
    EXPECT_NEAR(model.high_m.x, 51.0, 1e-4) << "the external reference";
    EXPECT_NEAR(model.high_m.z, 1.0, 1e-4) << "the switch's second child is off";
    ASSERT_EQ(model.mounts.size(), 1U);
    EXPECT_EQ(model.mounts[0].name, "lamp.low.left");
    EXPECT_LT(glm::length(model.mounts[0].pose.position_m - glm::dvec3(3.6, 0.7, 0.65)), 1e-5);
    EXPECT_THAT(said_, HasSubstr("coarser levels of detail are left out"));
}

TEST_F(Import, BrokenFilesAreOneSentence) {
    FlightWriter flight(0);
    flight.group("g");
    flight.push();
    flight.object();
    flight.push();
    flight.square(0.0, 0.0, 0.0, 0xFFFFFF);
    flight.pop();
    flight.pop();
    const std::string good = flight.text();
    EXPECT_THAT(refusal(""), HasSubstr("bad.flt"));
    EXPECT_THAT(refusal("no flight at all"), HasSubstr("no OpenFlight header"));
    EXPECT_THAT(refusal(good.substr(0, good.size() - 10)), HasSubstr("expected"));
    EXPECT_THAT(refusal(good.substr(0, good.size() - 4)), HasSubstr("1 levels still open"));
    EXPECT_THAT(refusal(good + std::string("\0\x0b\0\4", 4)), HasSubstr("a level closed that was not opened"));
    std::string wrong = good;
    wrong[14] = 0; // revision
    wrong[15] = 7;
    EXPECT_THAT(refusal(wrong), HasSubstr("revision 7"));
    std::string far = good;
    far.replace(far.size() - 4 - 4 - 4 - 4 - 16, 4, "\x7f\xff\xff\xff"); // the first vertex lies beyond the palette
    const std::string said = refusal(far);
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    for (const std::size_t cut : {330U, 391U, 460U, 541U}) // cut anywhere, it ends in a sentence
        EXPECT_THAT(refusal(good.substr(0, cut)), HasSubstr("expected")) << cut;
}

} // namespace
} // namespace fernlicht
