// Luminance with its colour: beside the luminance, and shown by the equations of a display beside what the GPU shows.
#include "tests/renderer/reference/rooms.h"

#include "renderer/renderer.h"
#include "scenarios/display/display_profile.h"
#include "scenarios/display/tone_mapper.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// A red board on grey ground under a warm lamp; another's lamp in view; some sky.
Scene red_board() {
    Scene scene = level_ground(300.0, lambert(0.2));
    Material red = lambert(0.5, SurfaceKind::object);
    red.albedo = {0.6F, 0.05F, 0.03F};
    scene.materials.push_back(red);
    Mesh board{"board", {20.0, 0.0, 0.0}, {}, {}, {}};
    add_quad(board, {0, 3, 0}, {0, -3, 0}, {0, -3, 3}, {0, 3, 3});
    scene.meshes.push_back(finished(board, 1));
    return scene;
}

Moment warm_night() {
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = 0.5;
    LitLamp own = even_lamp(20000.0, looking({3.5, 0.0, 0.65}, 0, 0));
    own.colour = colour_of_temperature(3200.0);
    moment.lamps = {own};
    LitLamp other = even_lamp(800.0, looking({40.0, 12.0, 0.65}, 180, 0));
    other.face_m = {0.3, 0.2};
    moment.other_lamps = {other};
    return moment;
}

View ahead_of_board() {
    View view = camera({1.5, 0.35, 1.2}, 0, -3, 30, 96);
    view.height_px = 64;
    return view;
}

constexpr Wanted as_seen{.colour = true, .luminance = true, .light = true};

class ColouredLight : public testing::TestWithParam<const char*> {
  protected:
    Frame draw(const Wanted& wanted, const ToneMapper& mapper = {}) {
        RendererSettings settings;
        settings.technique = GetParam();
        settings.tone_mapper = mapper;
        Renderer renderer(device_, scene_, settings);
        return renderer.draw(warm_night(), ahead_of_board(), wanted);
    }
    Device device_ = open_device("auto");
    Scene scene_ = red_board();
};

TEST_P(ColouredLight, ItsLuminanceIsTheLuminance) {
    const Frame frame = draw(as_seen);
    ASSERT_EQ(frame.light.size(), frame.luminance_cdm2.size());
    int coloured = 0, bright = 0;
    for (std::size_t i = 0; i < frame.light.size(); ++i) {
        const glm::vec3 light = frame.light.pixels()[i];
        const double luminance =
            0.2126 * static_cast<double>(light.r) + 0.7152 * static_cast<double>(light.g) + 0.0722 * static_cast<double>(light.b);
        EXPECT_NEAR(luminance, static_cast<double>(frame.luminance_cdm2.pixels()[i]), 1.0e-6 * luminance);
        coloured += light.r > 3.0F * light.g ? 1 : 0;
        bright += luminance > 1000.0 ? 1 : 0;
    }
    EXPECT_GT(coloured, 100); // the board
    if (std::string_view(GetParam()) != "photometric-naive") {
        EXPECT_GT(bright, 0); // the other's lamp
    }
}

/// The GPU shows it as an sRGB display does: luminance through the tone mapper, each channel clipped, the code rounded.
TEST_P(ColouredLight, TheGpuShowsItsColours) {
    const DisplayProfile srgb = srgb_display();
    for (const ToneMapper& mapper :
         {ToneMapper{ToneMapperKind::rational, 20.0, 100.0, {}}, ToneMapper{ToneMapperKind::linear, 1.0, 50.0, {}},
          ToneMapper{ToneMapperKind::logarithmic, 50.0, 1000.0, {}}}) {
        const Frame frame = draw(as_seen, mapper);
        for (std::size_t i = 0; i < frame.light.size(); ++i) {
            const glm::dvec3 light(frame.light.pixels()[i]);
            const double luminance = glm::dot(light, glm::dvec3(0.2126, 0.7152, 0.0722));
            const glm::dvec3 shares =
                luminance > 0.0 ? glm::clamp(light * (toned(mapper, luminance) / luminance), 0.0, 1.0) : glm::dvec3(0.0);
            const Rgb8 shown = frame.colour.pixels()[i];
            EXPECT_NEAR(255.0 * encoded(srgb, shares.r), shown.r, 0.52);
            EXPECT_NEAR(255.0 * encoded(srgb, shares.g), shown.g, 0.52);
            EXPECT_NEAR(255.0 * encoded(srgb, shares.b), shown.b, 0.52);
        }
    }
}

TEST_P(ColouredLight, AskingForItChangesNothingElse) {
    Wanted without = as_seen;
    without.light = false;
    const Frame with = draw(as_seen), plain = draw(without);
    EXPECT_EQ(with.colour, plain.colour);
    EXPECT_EQ(with.luminance_cdm2, plain.luminance_cdm2);
    EXPECT_TRUE(plain.light.empty());
    EXPECT_EQ(draw({.light = true}).light, with.light);
}

INSTANTIATE_TEST_SUITE_P(, ColouredLight, testing::Values("photometric", "photometric-unpruned", "photometric-naive"),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::erase(name, '-');
                             return name;
                         });

TEST(ColouredLightOfOthers, TechniquesWithoutLuminanceHaveNone) {
    Device device = open_device("auto");
    const Scene scene = red_board();
    RendererSettings settings;
    settings.technique = "full";
    Renderer renderer(device, scene, settings);
    EXPECT_FALSE(renderer.available(as_seen).light);
    EXPECT_TRUE(renderer.draw(warm_night(), ahead_of_board(), as_seen).light.empty());
}

} // namespace
} // namespace fernlicht
