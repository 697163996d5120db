// Sun and moon as they are drawn: against the double-precision twin, the reference, and closed forms; left out where they do not shine.
#include "renderer/twin.h"
#include "scenarios/display/display_profile.h"
#include "scenarios/display/tone_mapper.h"
#include "tests/renderer/device_test.h"
#include "tests/renderer/reference/rooms.h"

namespace fernlicht {
namespace {

/// Ground and an upright board with a post before it, 20 m ahead.
Scene yard() {
    Scene scene = level_ground(300.0, lambert(0.2));
    scene.materials.push_back(lambert(0.5, SurfaceKind::object));
    scene.meshes.push_back(quads("board", 1, {20.0, 0.0, 0.0},
                                 {{{0, 3, 0}, {0, -3, 0}, {0, -3, 3}, {0, 3, 3}}, {{0.2, -3, 0}, {0.2, 3, 0}, {0.2, 3, 3}, {0.2, -3, 3}}}));
    scene.meshes.push_back(
        quads("post", 1, {16.0, 1.0, 0.0},
              {{{0, 0.2, 0}, {0, -0.2, 0}, {0, -0.2, 2}, {0, 0.2, 2}}, {{0.2, -0.2, 0}, {0.2, 0.2, 0}, {0.2, 0.2, 2}, {0.2, -0.2, 2}}}));
    return scene;
}

Moment sunlit(double azimuth_deg, double elevation_deg, double lx, double sky_lx) {
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = sky_lx;
    moment.daylight.sun = {radians(azimuth_deg), radians(elevation_deg), lx};
    moment.lamps = {even_lamp(1000.0, looking({3.5, 0.0, 0.65}, 0, 0))};
    return moment;
}

class DrawnDaylight : public DeviceTest {
  protected:
    Frame draw(const Scene& scene, const Moment& moment, bool shadows, const char* technique = "photometric", Work* work = nullptr) {
        RendererSettings settings{.shadows = {.method = shadows ? ShadowMethod::map : ShadowMethod::none}};
        settings.technique = technique;
        Renderer renderer(device_, scene, settings);
        if (work != nullptr)
            *work = renderer.count(moment, driver_view(96, 64), all_results);
        return renderer.draw(moment, driver_view(96, 64), all_results);
    }
};

struct Tally {
    int compared = 0, beyond = 0;
};

Tally against_twin(const Frame& frame, const Twin& twin, const Moment& moment, const View& view) {
    Tally tally;
    for (const auto& [x, y] : each_pixel(view)) {
        const TwinPixel truth = twin.pixel(moment, view, x + 0.5, y + 0.5);
        if (truth.id != frame.ids.at(x, y))
            continue; // an outline
        ++tally.compared;
        const double off = std::abs(static_cast<double>(frame.illuminance_lx.at(x, y)) - truth.illuminance_lx);
        const double dim = std::abs(static_cast<double>(frame.luminance_cdm2.at(x, y)) - truth.luminance_cdm2);
        tally.beyond += off > truth.bound_lx + 1e-9 || dim > 1e-5 * truth.luminance_cdm2 + 1e-12 ? 1 : 0;
    }
    return tally;
}

/// From behind, from the side, from ahead, high, at the horizon, at the zenith; bright sun and faint moon.
TEST_F(DrawnDaylight, LiesWithinTheBoundOfTheTwin) {
    const Scene scene = yard();
    const Twin twin(scene, false);
    for (const auto& [azimuth, elevation, lx] :
         {std::tuple(270.0, 30.0, 80'000.0), std::tuple(0.0, 10.0, 9000.0), std::tuple(90.0, 45.0, 0.2), std::tuple(200.0, 0.0, 500.0),
          std::tuple(10.0, 90.0, 100'000.0), std::tuple(1.0, -5.0, 3.0)})
        for (const double sky : {0.0, 12'000.0}) {
            Moment moment = sunlit(azimuth, elevation, lx, sky);
            moment.lamps.clear();
            const Tally tally = against_twin(draw(scene, moment, false), twin, moment, driver_view(96, 64));
            EXPECT_GT(tally.compared, 6000);
            EXPECT_EQ(tally.beyond, 0) << azimuth << ' ' << elevation;
        }
}

/// The ground shows E sin(elevation), and a sun below the horizon no light on it.
TEST_F(DrawnDaylight, GivesTheGroundTheSineOfTheElevation) {
    const Scene scene = level_ground(300.0, lambert(0.2));
    for (const double elevation : {90.0, 30.0, 1.0}) {
        Moment moment = sunlit(123.0, elevation, 50'000.0, 0.0);
        moment.lamps.clear();
        const double e = static_cast<double>(draw(scene, moment, true).illuminance_lx.at(48, 60));
        EXPECT_NEAR(e, 50'000.0 * std::sin(radians(elevation)), 0.04);
    }
    Moment below = sunlit(123.0, -1.0, 50'000.0, 0.0);
    below.lamps.clear();
    EXPECT_EQ(draw(scene, below, true).illuminance_lx.at(48, 60), 0.0F);
}

/// Shadows of board and post fall where rays say; the map's texels of 0.12 m blur their edges.
TEST_F(DrawnDaylight, ShadowsFallWhereRaysSay) {
    const Scene scene = yard();
    const Twin lit(scene, false), shaded(scene, true);
    const View above = map_view(40.0, 0.0, 12.0, 96, 160);
    for (const auto& [azimuth, elevation] : {std::pair(60.0, 25.0), std::pair(300.0, 12.0)}) {
        Moment moment = sunlit(azimuth, elevation, 1000.0, 0.0);
        moment.lamps.clear();
        Renderer renderer(device_, scene, {});
        const Frame frame = renderer.draw(moment, above, {.illuminance = true});
        int dark = 0, wrong = 0;
        const auto dark_at = [&](double x, double y) { return shaded.pixel(moment, above, x, y).illuminance_lx == 0.0; };
        for (const auto& [x, y] : each_pixel(above)) {
            const bool truth = dark_at(x + 0.5, y + 0.5);
            bool edge = false;
            for (const double d : {-1.0, 1.0})
                edge = edge || dark_at(x + 0.5 + d, y + 0.5) != truth || dark_at(x + 0.5, y + 0.5 + d) != truth;
            if (edge)
                continue;
            dark += truth ? 1 : 0;
            wrong += (static_cast<double>(frame.illuminance_lx.at(x, y)) < 500.0 * std::sin(radians(elevation))) != truth ? 1 : 0;
        }
        EXPECT_GT(dark, 300) << azimuth;
        EXPECT_LE(wrong, dark / 50) << azimuth;
    }
}

TEST_F(DrawnDaylight, PrunedAndUnprunedGiveTheSameBytesWithItOnAndOff) {
    const Scene scene = yard();
    for (const auto& [lx, elevation, sky] :
         {std::tuple(0.0, 0.0, 0.0), std::tuple(60'000.0, 30.0, 9000.0), std::tuple(0.2, 60.0, 0.0), std::tuple(100.0, -2.0, 0.0)}) {
        const Moment moment = sunlit(300.0, elevation, lx, sky);
        expect_same_frames(draw(scene, moment, true), draw(scene, moment, true, "photometric-unpruned"), std::to_string(lx));
    }
}

TEST_F(DrawnDaylight, NeitherSunNorMoonCostsNothing) {
    const Scene scene = yard();
    Work night, day;
    draw(scene, sunlit(300.0, 30.0, 0.0, 0.0), true, "photometric", &night);
    draw(scene, sunlit(300.0, 30.0, 1000.0, 0.0), true, "photometric", &day);
    EXPECT_EQ(night.passes + 1, day.passes);
    EXPECT_EQ(night.shadow_maps + 1, day.shadow_maps);
    EXPECT_EQ(night.samplers + 1, day.samplers);
    EXPECT_LT(night.features, day.features);
}

/// The reference's direct light and paths, and the twin, look at the same sun.
TEST(ReferenceDaylight, AgreesWithTheTwin) {
    const Scene scene = yard();
    const Moment moment = sunlit(300.0, 20.0, 3000.0, 100.0);
    ReferenceSettings settings{.footprint = Footprint::centre};
    const View view = driver_view(96, 64);
    const ReferenceImage image = Reference(scene).render(moment, view, everything, settings);
    const Twin twin(scene, true);
    int differ = 0, shaded = 0;
    for (const auto& [x, y] : each_pixel(view)) {
        const TwinPixel truth = twin.pixel(moment, view, x + 0.5, y + 0.5);
        differ +=
            std::abs(static_cast<double>(image.illuminance_lx.mean.at(x, y)) - truth.illuminance_lx) > 1e-6 * truth.illuminance_lx ? 1 : 0;
        shaded += truth.id != 0 && truth.illuminance_lx < 200.0 ? 1 : 0;
    }
    EXPECT_LE(differ, 20); // outlines and edges of shadows
    EXPECT_GT(shaded, 20);
}

// Luminance with its colour: beside the luminance, and shown by the equations of a display beside what the GPU shows.

/// A red board on grey ground under a warm lamp; another's lamp in view; some sky.
Scene red_board() {
    Scene scene = level_ground(300.0, lambert(0.2));
    Material red = lambert(0.5, SurfaceKind::object);
    red.albedo = {0.6F, 0.05F, 0.03F};
    scene.materials.push_back(red);
    scene.meshes.push_back(quads("board", 1, {20.0, 0.0, 0.0}, {{{0, 3, 0}, {0, -3, 0}, {0, -3, 3}, {0, 3, 3}}}));
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

constexpr FrameOutputs as_seen{.colour = true, .luminance = true, .light = true};

class ColouredLight : public testing::TestWithParam<const char*> {
  protected:
    Frame draw(const FrameOutputs& outputs, const ToneMapper& mapper = {}) {
        Renderer renderer(device_, scene_, RendererSettings{.technique = GetParam(), .tone_mapper = mapper});
        return renderer.draw(warm_night(), driver_view(96, 64), outputs);
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
    const double a_code = device_.info().software ? 0.52 : 0.57; // half of one by rounding; a GPU's pow adds 0.065
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
            EXPECT_NEAR(255.0 * encoded(srgb, shares.r), shown.r, a_code);
            EXPECT_NEAR(255.0 * encoded(srgb, shares.g), shown.g, a_code);
            EXPECT_NEAR(255.0 * encoded(srgb, shares.b), shown.b, a_code);
        }
    }
}

TEST_P(ColouredLight, AskingForItChangesNothingElse) {
    FrameOutputs without = as_seen;
    without.light = false;
    const Frame with = draw(as_seen), plain = draw(without);
    EXPECT_EQ(std::tuple(with.colour, with.luminance_cdm2), std::tuple(plain.colour, plain.luminance_cdm2));
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
    Renderer renderer(device, scene, RendererSettings{.technique = "full"});
    EXPECT_FALSE(renderer.available(as_seen).light);
    EXPECT_TRUE(renderer.draw(warm_night(), driver_view(96, 64), as_seen).light.empty());
}

} // namespace
} // namespace fernlicht
