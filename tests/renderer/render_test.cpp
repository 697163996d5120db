// The GPU's float frames against the double-precision twin, pixel by pixel, within a bound that is derived, not tuned.
#include "renderer/device.h"
#include "renderer/gl/device/program.h"
#include "renderer/gpu_timer.h"
#include "renderer/renderer.h"
#include "renderer/twin.h"
#include "scenarios/lamps/level_track.h"
#include "scenarios/lamps/pixel_lamp.h"
#include "scenarios/photometry.h"
#include "scenarios/values/errors.h"
#include "tests/renderer/device_test.h"
#include "tests/renderer/reference/rooms.h"
#include "tests/trial.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

/// A beam with a cut-off and a kink, steep enough to hurt: ln I falls by about 500 per radian at the cut-off.
CandelaTable steep_beam() {
    return tests::table_of(tests::steps(-30.0, 30.0, 0.1), tests::steps(-10.0, 5.0, 0.05), [](double h, double v) {
        const double cut = -0.57 + (h > 0.0 ? std::min(h * 0.268, 2.0) : 0.0);
        return 300.0 + 20000.0 / (1.0 + std::exp((v - cut) / 0.11)) * std::exp(-h * h / 200.0) * std::exp(-(v - cut) * (v - cut) / 40.0);
    });
}

/// A road plane, a retroreflecting board and a post of a box before it.
Scene small_scene(glm::dvec3 origin) {
    Material road = lambert(0.08), post = lambert(0.08, SurfaceKind::object), board = lambert(0.0, SurfaceKind::board);
    road.retro_rl = post.retro_rl = 0.0145F;
    board.albedo = {0.6F, 0.1F, 0.1F};
    board.retro_rl = 180.0F;
    board.retro_reference_rad = 0.00576F;
    board.retro_falloff_rad = 0.0079F;
    return {.materials = {road, board, post},
            .meshes = {quads("plane", 0, origin + glm::dvec3(40.0, 0.0, 0.0), {{{-60, -30, 0}, {110, -30, 0}, {110, 30, 0}, {-60, 30, 0}}}),
                       quads("board", 1, origin + glm::dvec3(35.0, -4.0, 2.0), {{{0, 1, -1}, {0, -1, -1}, {0, -1, 1}, {0, 1, 1}}}),
                       quads("box", 2, origin + glm::dvec3(22.0, 1.5, 0.0),
                             {{{0, 0.5, 0}, {0, -0.5, 0}, {0, -0.5, 1.2}, {0, 0.5, 1.2}},
                              {{0, 0.5, 1.2}, {1, 0.5, 1.2}, {1, 0.5, 0}, {0, 0.5, 0}}})}};
}

Moment two_lamps(glm::dvec3 origin, double sky_lx = 0.0) {
    const auto file = tests::file_of(steep_beam());
    Moment moment{.ego = {origin, glm::dmat3(1.0)}};
    moment.daylight.horizontal_illuminance_lx = sky_lx;
    LampColour warm;
    warm.linear_srgb = glm::dvec3(1.6, 0.9, 0.22) / glm::dot(glm::dvec3(1.6, 0.9, 0.22), glm::dvec3(0.2126, 0.7152, 0.0722));
    for (const double side : {0.6, -0.6})
        moment.lamps.push_back({side > 0 ? "left" : "right", file,
                                Pose{origin + glm::dvec3(3.5, side, 0.65), axes_from_angles(0.01 * side, 0.0, 0.0)}, 1.0, warm, 0.0});
    return moment;
}

class TwinTest : public DeviceTest {};

struct TwinComparison {
    int compared = 0, beyond = 0;
    double worst_ratio = 0.0, worst_relative_luminance = 0.0;
};

/// Compares every pixel whose corners all show the same mesh.
TwinComparison compare(const Frame& frame, const Twin& twin, const Moment& moment, const View& view) {
    TwinComparison result;
    for (const auto& [x, y] : each_pixel(view)) {
        const TwinPixel truth = twin.pixel(moment, view, x + 0.5, y + 0.5);
        bool inner = true;
        for (const double dx : {0.4, 0.6})
            for (const double dy : {0.4, 0.6})
                inner = inner && twin.pixel(moment, view, x + dx, y + dy).id == truth.id;
        if (!inner)
            continue;
        EXPECT_EQ(frame.ids.at(x, y), truth.id) << x << ' ' << y;
        if (truth.id == 0)
            continue;
        ++result.compared;
        const double difference = std::abs(static_cast<double>(frame.illuminance_lx.at(x, y)) - truth.illuminance_lx);
        const double bound = truth.bound_lx + 1e-9;
        result.worst_ratio = std::max(result.worst_ratio, difference / bound);
        result.beyond += difference > bound ? 1 : 0;
        if (truth.luminance_cdm2 > 0.0)
            result.worst_relative_luminance = std::max(
                result.worst_relative_luminance, std::abs(static_cast<double>(frame.luminance_cdm2.at(x, y)) / truth.luminance_cdm2 - 1.0));
    }
    return result;
}

TEST_F(TwinTest, DriverIsSane) { EXPECT_LT(check_sanity(device_), sanity_bound); }

TEST_F(TwinTest, EveryPixelLiesWithinTheDerivedBound) {
    const Scene scene = small_scene({});
    RendererSettings settings{.shadows = {.method = ShadowMethod::none}};
    Renderer renderer(device_, scene, settings);
    for (const double sky_lx : {0.0, 3.4}) {
        const Moment moment = two_lamps({}, sky_lx);
        const TwinComparison c =
            compare(renderer.draw(moment, driver_view(96, 64), all_results), Twin(scene, false, place_px_), moment, driver_view(96, 64));
        EXPECT_GT(c.compared, 3000);
        EXPECT_EQ(c.beyond, 0) << "worst " << c.worst_ratio << " of the bound";
        EXPECT_LT(c.worst_relative_luminance, place_px_ > 0.0 ? 5e-3 : 4e-3);
    }
}

/// Twelve pixels whose levels differ from lamp to lamp and from moment to moment.
TEST_F(TwinTest, StatesOfPixelsAreDrawnAsTheTwinHasThem) {
    PixelParts parts;
    parts.raster.push_back({4, 3, {-16.0, 16.0, -6.0, 3.0}, 0.6, 0.4, std::vector<double>(12, 20000.0)});
    auto lamp = std::make_shared<LampFile>();
    lamp->pixels = std::make_shared<const PixelLamp>(parts);
    lamp->table = lamp->pixels->table(std::vector<float>(12, 1.0F));
    std::vector<std::unique_ptr<LevelTrack>> tracks;
    for (int side = 0; side < 2; ++side) {
        tracks.push_back(std::make_unique<LevelTrack>(lamp));
        for (int second = 0; second < 4; ++second) {
            std::vector<float> levels;
            for (int pixel = 0; pixel < 12; ++pixel)
                levels.push_back(second == 3 ? 1.0F : static_cast<float>((pixel * (3 + second) + 5 * side) % 7) / 6.0F);
            tracks.back()->ask(second, levels);
        }
    }
    const Scene scene = small_scene({});
    for (const LightPass pass : {LightPass::shader, LightPass::cpu}) {
        Renderer renderer(device_, scene, {.shadows = {.method = ShadowMethod::none}, .light_pass = pass});
        for (const double time_s : {0.0, 2.0, 1.0, 3.0, 0.0}) { // back, too
            Moment moment = two_lamps({});
            for (std::size_t i = 0; i < 2; ++i)
                moment.lamps[i].file = tracks[i]->at(time_s);
            const Frame frame = renderer.draw(moment, driver_view(96, 64), all_results);
            const TwinComparison c = compare(frame, Twin(scene, false, place_px_), moment, driver_view(96, 64));
            EXPECT_GT(c.compared, 3000);
            EXPECT_EQ(c.beyond, 0) << time_s << " s: worst " << c.worst_ratio << " of the bound";
        }
    }
}

TEST_F(TwinTest, BesideWhereAnybodyLooksNothingIsDrawn) {
    const Scene scene = small_scene({});
    for (const LightPass pass : {LightPass::shader, LightPass::cpu}) {
        Renderer renderer(device_, scene, {.light_pass = pass});
        const FrameOutputs outputs{.illuminance = true, .target = true, .ids = true};
        View view = map_view(80.0, 5.0, 20.0, 90, 130);
        const Frame whole = renderer.draw(two_lamps({}), view, outputs);
        view.looked_at = {{10, 0, 31, 16}, {3, 16, 80, 50}, {40, 60, 50, 70}};
        const Frame part = renderer.draw(two_lamps({}), view, outputs);
        const auto looked_at = [&](int x, int y) {
            return std::ranges::any_of(view.looked_at, [&](const PixelBox& box) {
                return x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height;
            });
        };
        for (const auto& [x, y] : each_pixel(view)) {
            const bool looked = looked_at(x, y);
            EXPECT_EQ(part.ids.at(x, y), looked ? whole.ids.at(x, y) : 0) << x << ' ' << y;
            EXPECT_EQ(part.illuminance_lx.at(x, y), looked ? whole.illuminance_lx.at(x, y) : 0.0F) << x << ' ' << y;
            EXPECT_EQ(part.target_lx.at(x, y), looked ? whole.target_lx.at(x, y) : 0.0F) << x << ' ' << y;
        }
        view.looked_at = {};
        EXPECT_TRUE(std::ranges::equal(renderer.draw(two_lamps({}), view, outputs).illuminance_lx.pixels(), whole.illuminance_lx.pixels()));
    }
}

TEST_F(TwinTest, TheBoundIsNotSlack) {
    // A flipped sign, a lamp left out, a texel's shift: each must break the bound on many pixels.
    const Scene scene = small_scene({});
    RendererSettings settings{.shadows = {.method = ShadowMethod::none}};
    Renderer renderer(device_, scene, settings);
    const Moment moment = two_lamps({});
    const Frame frame = renderer.draw(moment, driver_view(96, 64), all_results);
    Moment one_lamp = moment;
    one_lamp.lamps.pop_back();
    EXPECT_GT(compare(frame, Twin(scene, false, place_px_), one_lamp, driver_view(96, 64)).beyond, 1000);
    Moment shifted = moment;
    for (LitLamp& lamp : shifted.lamps)
        lamp.pose.axes = axes_from_angles(0.0, radians(0.01), 0.0);
    EXPECT_GT(compare(frame, Twin(scene, false, place_px_), shifted, driver_view(96, 64)).beyond, 1000);
    Moment brighter = moment;
    for (LitLamp& lamp : brighter.lamps)
        lamp.intensity_factor = 1.0005;
    EXPECT_GT(compare(frame, Twin(scene, false, place_px_), brighter, driver_view(96, 64)).beyond, place_px_ > 0.0 ? 500 : 1000);
}

TEST_F(TwinTest, UtmCoordinatesGiveTheSameFrame) {
    const glm::dvec3 far{6.8e5, 5.4e6, 412.0};
    const Scene here = small_scene({}), there = small_scene(far);
    RendererSettings settings;
    Renderer at_origin(device_, here, settings);
    const Frame a = at_origin.draw(two_lamps({}), driver_view(96, 64), all_results);
    Renderer at_utm(device_, there, settings);
    const Frame b = at_utm.draw(two_lamps(far), driver_view(96, 64), all_results);
    const Twin twin(here, false);
    const Moment moment = two_lamps({});
    int differing = 0;
    for (const auto& [x, y] : each_pixel(driver_view(96, 64))) {
        const TwinPixel truth = twin.pixel(moment, driver_view(96, 64), x + 0.5, y + 0.5);
        const double difference = std::abs(static_cast<double>(a.illuminance_lx.at(x, y)) - static_cast<double>(b.illuminance_lx.at(x, y)));
        differing += difference > 2.0 * truth.bound_lx + 1e-9 ? 1 : 0;
    }
    EXPECT_LE(differing, 12) << "pixels on silhouettes and shadow edges may fall to either side";
}

TEST_F(TwinTest, TwiceTheSameBytesAndExactlyZeroOfABlackLamp) {
    const Scene scene = small_scene({});
    const Moment moment = two_lamps({}, 1.0);
    const auto draw = [&] {
        Renderer renderer(device_, scene, {});
        return renderer.draw(moment, driver_view(96, 64), all_results);
    };
    expect_same_frames(draw(), draw(), "again");
    Moment other_moment = two_lamps({});
    for (LitLamp& lamp : other_moment.lamps)
        lamp.intensity_factor = 0.0;
    Renderer renderer(device_, scene, {});
    const Frame frame = renderer.draw(other_moment, driver_view(96, 64), all_results);
    for (const float e : frame.illuminance_lx.pixels())
        ASSERT_EQ(e, 0.0F);
}

TEST_F(TwinTest, RetroreflectionAtTheThirtyMetreGeometryIsMeasuredInTheImage) {
    // EN 1436: lamp 0.65 m and eye 1.2 m above the road, 30 m before the point, one above the other: R_L = L / E_perp.
    Scene scene = small_scene({});
    scene.meshes.resize(1);
    Moment moment = two_lamps({});
    moment.lamps.resize(1);
    moment.lamps[0].colour = {};
    moment.lamps[0].pose = {glm::dvec3(0.0, 0.0, 0.65), axes_from_angles(0.0, -std::atan(0.65 / 30.0) * 1.5, 0.0)};
    View view = driver_view(96, 64);
    view.position_m = {0.0, 0.0, 1.2};
    view.pitch_rad = -std::atan(1.2 / 30.0);
    view.vertical_fov_rad = radians(2.0);
    view.width_px = view.height_px = 33;
    Renderer renderer(device_, scene, {});
    const Frame frame = renderer.draw(moment, view, all_results);
    const double luminance = static_cast<double>(frame.luminance_cdm2.at(16, 16)),
                 illuminance = static_cast<double>(frame.illuminance_lx.at(16, 16));
    const double cosine = 0.65 / std::hypot(30.0, 0.65), rl = luminance / (illuminance / cosine);
    // 0.0145 by retroreflection and 0.08 cos / pi = 0.00055 by diffusion; the text book's 0.55 mcd is the latter alone.
    EXPECT_NEAR(rl, 0.0145 + 0.08 * cosine / pi, 2e-4);
}

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
