#include "runner/commands/model_command.h"
#include "scenarios/models/model.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"
#include "tests/trial.h"

#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

/// Small OpenFlight databases, record by record, as the OpenFlight specification lays them out (16.0).
class FlightWriter {
  public:
    /// `unit`: 0 metres, 4 feet.
    explicit FlightWriter(int unit) {
        std::string body(320, '\0');
        const auto at = [&](std::size_t byte, const std::string& bytes) { body.replace(byte - 4, bytes.size(), bytes); };
        at(4, "db");
        at(12, big(1600, 4));
        at(60, big(1, 2));
        at(62, big(static_cast<std::uint64_t>(unit), 1));
        at(126, big(1, 2)); // vertices in double precision
        header_ = record(1, body);
    }

    void group(const std::string& name) { body_ += record(2, padded(name, 8) + std::string(32, '\0')); }
    /// With squares of 2 x 2 about these centres, facing up, in a colour.
    void object(const std::vector<glm::dvec3>& centres, std::uint32_t rgb) {
        body_ += record(4, padded("o", 8) + std::string(16, '\0'));
        push();
        for (const glm::dvec3& centre : centres)
            square(centre, rgb);
        pop();
    }
    void push() { body_ += record(10, ""); }
    void pop() { body_ += record(11, ""); }
    /// Longer than the 7 letters that a record's own name has.
    void long_name(const std::string& name) { body_ += record(33, name + '\0'); }
    void level_of_detail(double from_m, double to_m) {
        body_ += record(73, padded("lod", 8) + big(0, 4) + number(to_m) + number(from_m) + std::string(48, '\0'));
    }
    /// The first of two children is on.
    void switch_first() { body_ += record(96, padded("sw", 8) + big(0, 4) + big(0, 4) + big(1, 4) + big(1, 4) + big(1, 4)); }
    void external(const std::string& file) { body_ += record(63, padded(file, 200) + std::string(12, '\0')); }
    std::string text() const {
        const std::string palette = record(67, big(8 + vertices_.size(), 4)) + vertices_;
        return header_ + palette + record(10, "") + body_ + record(11, "");
    }
    void write(const std::string& path) const { std::ofstream(path, std::ios::binary) << text(); }

  private:
    void square(const glm::dvec3& at, std::uint32_t rgb) {
        std::string face(76, '\0');
        face.replace(0, 1, "f");
        face.replace(22, 4, std::string("\xff\xff\xff\xff", 4)); // detail texture, texture: none
        face.replace(26, 2, std::string("\xff\xff", 2));         // material: none
        face.replace(40, 4, big(0x10000000, 4));                 // packed colour
        const std::uint32_t bgr = (rgb & 0xFF) << 16 | (rgb & 0xFF00) | rgb >> 16;
        face.replace(52, 4, big(0xFF000000U | bgr, 4));
        body_ += record(5, face);
        push();
        std::string list;
        for (const auto& [dx, dy] : {std::pair(-1.0, -1.0), std::pair(1.0, -1.0), std::pair(1.0, 1.0), std::pair(-1.0, 1.0)}) {
            list += big(8 + vertices_.size(), 4);
            vertices_ += record(68, big(0, 2) + big(0x1000, 2) + number(at.x + dx) + number(at.y + dy) + number(at.z) +
                                        big(0xFF000000U | bgr, 4) + big(0, 4));
        }
        body_ += record(72, list);
        pop();
    }
    static std::string big(std::uint64_t value, int bytes) {
        std::string out;
        for (int i = bytes - 1; i >= 0; --i)
            out += static_cast<char>(value >> (8 * i) & 0xFF);
        return out;
    }
    static std::string number(double value) { return big(std::bit_cast<std::uint64_t>(value), 8); }
    static std::string padded(std::string text, std::size_t size) {
        text.resize(size, '\0');
        return text;
    }
    static std::string record(std::uint64_t code, const std::string& body) { return big(code, 2) + big(body.size() + 4, 2) + body; }

    std::string header_, vertices_, body_;
};

class Import : public testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(program_))
            GTEST_SKIP() << "built without OpenSceneGraph";
    }
    Model imported(const std::string& file, char forward = 'y') {
        testing::internal::CaptureStdout();
        const int code = import_command({folder_ / file, folder_ / "out.glb", forward, true, program_});
        said_ = testing::internal::GetCapturedStdout();
        EXPECT_EQ(code, 0);
        return read_model(folder_ / "out.glb");
    }
    std::string refusal(const std::string& bytes) {
        std::ofstream(folder_ / "bad.flt", std::ios::binary) << bytes;
        return tests::refusal_of([&] { import_command({folder_ / "bad.flt", folder_ / "out.glb", 'y', true, program_}); });
    }
    const std::filesystem::path program_ = std::filesystem::path(FERNLICHT_BINARY).parent_path() / "fernlicht-import";
    TemporaryFolder folder_;
    std::string said_;
};

TEST_F(Import, UnitsAxesAndColours) {
    FlightWriter flight(4); // feet
    flight.group("g");
    flight.push();
    flight.object({{10.0, 100.0, 5.0}}, 0xFF8000);
    flight.pop();
    flight.write(folder_ / "feet.flt");
    const Model model = imported("feet.flt");
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
    const Model place = imported("feet.flt", 'x');
    EXPECT_NEAR(0.5 * (place.low_m.x + place.high_m.x), 3.048, 1e-5);
    EXPECT_NEAR(0.5 * (place.low_m.y + place.high_m.y), 30.48, 1e-5);
}

TEST_F(Import, FinestLevelsSwitchesReferencesAndLamps) {
    FlightWriter part(0);
    part.group("p");
    part.push();
    part.object({{0.0, 50.0, 0.0}}, 0x808080);
    part.pop();
    part.write(folder_ / "part.flt");

    FlightWriter flight(0);
    flight.group("car");
    flight.push();
    const std::vector<glm::dvec3> three{{0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}, {10.0, 0.0, 0.0}}, one{three.front()};
    for (const auto& [from, to, squares] : {std::tuple(0.0, 100.0, three), std::tuple(100.0, 1000.0, one)}) {
        flight.level_of_detail(from, to);
        flight.push();
        flight.object(squares, 0x404040);
        flight.pop();
    }
    flight.switch_first();
    flight.push();
    for (const double z : {1.0, 2.0}) { // only the first is on
        flight.group("c");
        flight.push();
        flight.object({{0.0, 0.0, z}}, 0x202020);
        flight.pop();
    }
    flight.pop();
    flight.external("part.flt");
    flight.group("h");
    flight.long_name("headlight_left");
    flight.push();
    flight.object({{-0.7, 3.6, 0.65}}, 0xFFFFFF);
    flight.pop();
    flight.pop();
    flight.write(folder_ / "car.flt");
    const Model model = imported("car.flt");
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
    flight.object({{0.0, 0.0, 0.0}}, 0xFFFFFF);
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
