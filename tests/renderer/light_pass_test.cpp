// Light on the CPU is that of the fragment shader, whatever the packs' width; what it does not do is lit by the shader.
#include "renderer/light_pass/light_pass_packs.h"
#include "renderer/light_pass/peaks.h"
#include "scenarios/display/white_adaptation.h"
#include "scenarios/photometry.h"
#include "tests/renderer/reference/rooms.h"
#include "tests/renderer/shadow_scene.h"

#include <algorithm>

namespace fernlicht {
namespace {

/// A road whose normals turn, with a texture, a sign, a lantern and a post.
Scene varied_scene() {
    Material road = lambert(0.1), board = lambert(0.3, SurfaceKind::board), lantern = lambert(0.2, SurfaceKind::object),
             post = lambert(0.2, SurfaceKind::object);
    road.retro_rl = 0.0145F;
    road.texture = 0;
    road.texture_mode = TextureMode::decal;
    board.retro_rl = 180.0F;
    board.retro_rgb = {1.0F, 0.8F, 0.1F};
    lantern.emission_cdm2 = {5.0F, 3.0F, 1.0F};
    SurfaceTexture picture{"noise", 16, 16, {}};
    for (int i = 0; i < 16 * 16 * 4; ++i)
        picture.rgba.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(i) * 2654435761U >> 24));
    Scene scene{.materials = {road, board, lantern, post},
                .meshes = {quads("road", 0, {40, 0, 0}, {{{-45, -30, 0}, {80, -30, 0}, {80, 30, 0}, {-45, 30, 0}}}),
                           quads("board", 1, {38, 3, 2}, {{{0, 1, -1}, {0, -1, -1}, {0, -1, 1}, {0, 1, 1}}}),
                           quads("lantern", 2, {35, -4, 1}, {{{0, 1, -1}, {0, -1, -1}, {0, -1, 1}, {0, 1, 1}}}),
                           quads("post", 3, {15, 0.5, 0}, {{{0, 0.3, 0}, {0, -0.3, 0}, {0, -0.3, 1}, {0, 0.3, 1}}})},
                .textures = {picture}};
    float turn = -0.02F;
    for (Vertex& vertex : scene.meshes[0].vertices) {
        vertex.normal = glm::normalize(glm::vec3(turn, 0.5F * turn, 1.0F));
        turn += 0.013F;
        vertex.uv = {0.25F * vertex.position_m.x, 0.25F * vertex.position_m.y};
    }
    return scene;
}

Moment night(double sky_lx, bool one_colour) {
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = sky_lx;
    const std::vector<double> angles = tests::steps(-25.0, 25.0, 0.5);
    const auto beam = tests::file_of(
        tests::table_of(angles, angles, [](double h, double v) { return 15000.0 * std::exp(-0.005 * h * h - 0.02 * v * v); }));
    for (const double side : {0.6, -0.6}) {
        LampColour colour;
        if (side > 0.0 && !one_colour)
            colour.linear_srgb = {1.2, 0.95, 0.89};
        moment.lamps.push_back(
            {side > 0.0 ? "left" : "right", beam, {{3.5, side, 0.65}, axes_from_angles(0.0, -0.01, 0.0)}, 1.0, colour, 0.0});
    }
    return moment;
}

class LightPassTest : public DeviceTest {
  protected:
    void SetUp() override {
        if (!device_.info().software)
            GTEST_SKIP() << "a GPU's shaders light";
    }
    Frame draw(const Moment& moment, const View& view, RendererSettings settings, Renderer::LightPassesUsed* used = nullptr) {
        settings.tone_mapper.l_max_cdm2 = 20.0;
        Renderer renderer(device_, scene_, settings);
        FrameOutputs outputs = all_results;
        outputs.light = true;
        Frame frame = renderer.draw(moment, view, outputs);
        if (used != nullptr)
            *used = renderer.light_passes_used();
        return frame;
    }
    Scene scene_ = varied_scene();
};

/// Share of pixels where the two differ by more than that share of the larger.
double share_beyond(const std::vector<float>& a, const std::vector<float>& b, float share) {
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        beyond += std::abs(a[i] - b[i]) <= share * std::max(std::abs(a[i]), std::abs(b[i])) ? 0U : 1U;
    return static_cast<double>(beyond) / static_cast<double>(a.size());
}

TEST_F(LightPassTest, IsTheShadersLight) {
    for (const View& view : {driver_view(203, 120, 40.0), map_view(60.0, 5.0, 20.0, 131, 90)})
        for (const ShadowMethod method :
             {ShadowMethod::none, ShadowMethod::map, ShadowMethod::one_map, ShadowMethod::light_space_map, ShadowMethod::soft_map})
            for (const bool one_colour : {true, false}) {
                const Moment moment = night(method == ShadowMethod::map ? 0.0 : 1.5, one_colour);
                const std::string what = view.name + ", " + std::string(name(method));
                Renderer::LightPassesUsed by_shader, by_cpu;
                const RendererSettings settings{.shadows = {.method = method, .width = 256, .height = 128}, .light_pass = LightPass::cpu};
                RendererSettings other = settings;
                other.light_pass = LightPass::shader;
                const Frame cpu = draw(moment, view, settings, &by_cpu), shader = draw(moment, view, other, &by_shader);
                EXPECT_EQ(by_cpu.cpu, 1) << what << by_cpu.why_shader;
                EXPECT_EQ(by_shader.shader, 1) << what;
                EXPECT_EQ(cpu.ids, shader.ids) << what;
                EXPECT_EQ(share_beyond(cpu.depth_m.pixels(), shader.depth_m.pixels(), 1e-4F), 0.0) << what;
                // Shadows' edges fall to either side.
                EXPECT_LT(share_beyond(cpu.illuminance_lx.pixels(), shader.illuminance_lx.pixels(), 3e-4F), 2e-3) << what;
                EXPECT_LT(share_beyond(cpu.target_lx.pixels(), shader.target_lx.pixels(), 3e-4F), 2e-3) << what;
                EXPECT_LT(share_beyond(cpu.luminance_cdm2.pixels(), shader.luminance_cdm2.pixels(), 1e-3F), 2e-3) << what;
                EXPECT_GT(*std::ranges::max_element(cpu.illuminance_lx.pixels()), 1.0F) << what;
                int far_off = 0;
                for (std::size_t i = 0; i < cpu.colour.size(); ++i) {
                    const Rgb8 a = cpu.colour.pixels()[i], b = shader.colour.pixels()[i];
                    far_off += std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > 1 ? 1 : 0;
                }
                EXPECT_LT(far_off, 30) << what;
            }
}

TEST_F(LightPassTest, GivesTheSameBytesAtEveryWidth) {
    const Moment moment = night(0.7, false);
    const View view = driver_view(203, 120, 40.0); // no multiple of any width
    RendererSettings settings{.light_pass = LightPass::cpu};
    const Frame widest = draw(moment, view, settings);
    for (const packs::Level level : packs::levels_here()) {
        settings.light_level = level;
        const Frame frame = draw(moment, view, settings);
        expect_same_frames(frame, widest, std::to_string(static_cast<int>(level)));
        EXPECT_EQ(frame.light, widest.light);
    }
}

/// What is shown of the light, by the equations themselves.
Rgb8 shown(const glm::vec3& light, const ToneMapper& tone, const glm::dmat3& white) {
    const glm::dvec3 weights(0.2126, 0.7152, 0.0722), adapted = white * glm::dvec3(light);
    const double share = toned(tone, glm::dot(weights, glm::dvec3(light)));
    const auto code = [&](double channel) {
        const double part = share > 0.0 ? channel * share / glm::dot(weights, adapted) : 0.0;
        return static_cast<std::uint8_t>(std::lround(255.0 * photometry::srgb_encoded(std::clamp(part, 0.0, 1.0))));
    };
    return {code(adapted.r), code(adapted.g), code(adapted.b)};
}

TEST_F(LightPassTest, AnAdaptedEyeSeesOtherColoursAndNothingElseChanges) {
    const View view = driver_view(203, 120, 40.0);
    const Moment moment = night(0.7, false);
    const std::optional<glm::dmat3> white = light_adaptation({0.66, glm::dvec2(0.4234, 0.3990)});
    const Image<glm::vec3> light = draw(moment, view, {}).light; // the naive technique has none
    for (const auto& [technique, pass] : {std::pair("photometric", LightPass::cpu), std::pair("photometric", LightPass::shader),
                                          std::pair("photometric-naive", LightPass::shader)}) {
        RendererSettings settings{.technique = technique, .light_pass = pass};
        Frame plain = draw(moment, view, settings);
        settings.white = white;
        Frame adapted = draw(moment, view, settings);
        ToneMapper tone;
        tone.l_max_cdm2 = 20.0;
        int off = 0;
        for (std::size_t i = 0; i < light.size(); ++i)
            for (const auto& [frame, matrix] : {std::pair(&plain, glm::dmat3(1.0)), std::pair(&adapted, *white)}) {
                const Rgb8 a = frame->colour.pixels()[i], b = shown(light.pixels()[i], tone, matrix);
                off += std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > 1 ? 1 : 0;
            }
        EXPECT_LT(off, technique == std::string("photometric") ? 30 : 487)
            << technique; // 1 %: the naive one computes angles by other means
        EXPECT_NE(adapted.colour, plain.colour);
        EXPECT_EQ(adapted.light, plain.light);
        plain.colour = adapted.colour;
        expect_same_frames(adapted, plain, technique);
    }
}

TEST_F(LightPassTest, SaysWhyTheShaderLights) {
    Moment foggy = night(0.0, true);
    foggy.weather.extinction_per_m = 0.02;
    const View view = driver_view(32, 24, 40.0);
    Renderer::LightPassesUsed used;
    expect_same_frames(draw(foggy, view, {.light_pass = LightPass::cpu}, &used), draw(foggy, view, {.light_pass = LightPass::shader}),
                       "fog");
    EXPECT_EQ(used.shader, 1);
    EXPECT_NE(used.why_shader, "");
    draw(night(0.0, true), view, {.shadows = {.method = ShadowMethod::volumes}, .light_pass = LightPass::cpu}, &used);
    EXPECT_NE(used.why_shader, "");
}

TEST_F(LightPassTest, CountsWhatAPictureTakes) {
    const View view = driver_view(203, 120, 40.0);
    Renderer by_cpu(device_, scene_, {.light_pass = LightPass::cpu}), by_shader(device_, scene_, {.light_pass = LightPass::shader});
    const FrameOutputs outputs{.colour = true, .ids = true};
    const Moment moment = night(0.0, true);
    const Work work = by_cpu.count(moment, view, outputs, true);
    ASSERT_TRUE(work.light);
    const Frame frame = by_cpu.draw(moment, view, outputs);
    EXPECT_EQ(work.light->pixels, std::ranges::count_if(frame.ids.pixels(), [](int id) { return id != 0; }));
    EXPECT_EQ(work.light->bytes, (8 + 3 + 4) * 203 * 120);
    EXPECT_EQ(work.light->beam_texels, 1002 * 1002); // one each 0.05 degrees, and one more each way
    EXPECT_GT(work.light->operations, 100 * work.light->pixels);
    EXPECT_GT(work.light->look_ups, 0);
    EXPECT_GT(work.light->cpu_s, 0.0);
    EXPECT_FALSE(by_cpu.count(moment, view, outputs).light);
    EXPECT_FALSE(by_shader.count(moment, view, outputs, true).light);
}

/// A pixel that looks along the axis at a wall 10 m away, with one lamp at the eye and no shadow; counted by hand from the text.
TEST(LightPassCounts, AreThoseOfTheText) {
    static packs::PassMaterial material{.albedo = {0.5F, 0.5F, 0.5F}, .texture_mode = -1};
    static packs::PassTriangle wall{.nearness = {0.0F, 0.0F, 0.1F},
                                    .nearest = 10.0F,
                                    .farthest = 10.0F,
                                    .normal = {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, -1.0F},
                                    .material = &material,
                                    .mesh = 1,
                                    .flat = true,
                                    .lit = true,
                                    .shadowed = true};
    const std::vector<float> cd(std::size_t{4} * 4, 1000.0F);
    const packs::PassLamp lamp{.right = {1.0F, 0.0F, 0.0F},
                               .up = {0.0F, 1.0F, 0.0F},
                               .forward = {0.0F, 0.0F, 1.0F},
                               .factor = 1.0F,
                               .grid = {-0.1F, -0.1F, 10.0F, 10.0F},
                               .count = {3.0F, 3.0F},
                               .cd = cd.data()};
    const std::int32_t visible[2] = {1, 0};
    float lux = 0.0F;
    const packs::PassPicture picture{.width = 1,
                                     .visible = visible,
                                     .lamps = &lamp,
                                     .lamp_count = 1,
                                     .illuminance = &lux,
                                     .triangle = [](void*, std::int32_t) -> const packs::PassTriangle& { return wall; }};
    const packs::PassCounts counts = packs::counting::count_rows(picture, nullptr, 0, 1);
    EXPECT_FLOAT_EQ(lux, 10.0F);
    const int showing = 2 + 2 + 2 + 1 + 18 + 2, place = 3 + 4 + 2 + 2; // 18 selections of what a triangle has; X, 1 / depth, depth, place
    const int lift = 5 + 1 + 1, lamp_space = 3 + 3 * 5, distance = 5, cosine = 8, asked = 4;
    const int asin = 11, atan = 5 + 16 + 4 + 3 + 3, position = 4, known = 13, texel = 10, bilinear = 4 + 9 + 1 + 1; // factor, selection
    const int sum = 2 + 4 + 1 + 2 + 1, stored = 1; // E, whether lit, E across, E, sum
    EXPECT_EQ(counts.operations, showing + place + lift + lamp_space + distance + cosine + asked + asin + atan + position + known + texel +
                                     bilinear + sum + stored);
    EXPECT_EQ(counts.divisions, 1 + 2 + 1); // depth, distance, atan
    EXPECT_EQ(counts.look_ups, 2);
}

TEST(LightPassPeaks, ArePlausible) {
    for (const packs::Level level : packs::levels_here()) {
        const Peaks peaks = measure_peaks(level, 10'000);
        EXPECT_EQ(peaks.level, level);
        EXPECT_GE(peaks.threads, 1);
        EXPECT_GT(peaks.bytes_per_s, 0.0);
        EXPECT_GT(peaks.look_ups_per_s, 0.0);
        EXPECT_GT(peaks.divisions_per_s, 0.0);
        EXPECT_GT(peaks.operations_per_s, 1.5 * peaks.divisions_per_s);
        EXPECT_GT(peaks.operations_per_s, 1.5 * peaks.look_ups_per_s);
    }
}

} // namespace
} // namespace fernlicht
