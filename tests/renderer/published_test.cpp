// What the published techniques differ in, count and show: misprints, passes, textures, signs that glow, what is made once.
#include "scenarios/display/white_adaptation.h"
#include "tests/renderer/published_scene.h"

#include <functional>

namespace fernlicht {
namespace {

using namespace tests;

constexpr double moonless_lx = 3.4;
constexpr FrameOutputs lux_and_surfaces{.illuminance = true, .ids = true};

/// Symmetric: a projection with q = 1 + z would move the axis of any other.
CandelaTable round_beam() {
    return tests::table_of(tests::steps(-30.0, 30.0, 0.5), tests::steps(-15.0, 15.0, 0.5),
                           [](double h, double v) { return 10000.0 * std::exp(-(h * h + v * v) / 60.0); });
}

/// A wall across the lamps' axis, so many metres ahead of a lamp that stands in the camera, seen from there.
struct Wall {
    explicit Wall(double ahead_m) {
        moment.lamps = {mounted({}, "only", file_of(round_beam()), {0.0, 0.0, 0.0}, 1.0)};
        moment.lamps[0].pose.axes = glm::dmat3(1.0);
        scene.materials.resize(1);
        const double half = 0.6 * ahead_m;
        scene.meshes = {grid({}, "wall", 0, {ahead_m, half, -half}, {0, -2 * half, 0}, {0, 0, 2 * half}, {-1, 0, 0}, 64, 64)};
        view.width_px = 401;
        view.height_px = 41;
        view.vertical_fov_rad = 2.0 * std::atan(0.1025); // 0.005 a pixel
    }
    Scene scene;
    Moment moment;
    View view;
};

/// Where illuminance times fall-off crosses half of its value on the axis, tangent of the angle.
double half_width(const Frame& frame, const std::function<double(double)>& times) {
    const auto at = [&](int x) { return static_cast<double>(frame.illuminance_lx.at(200 + x, 20)) * times(0.005 * x); };
    const double half = 0.5 * at(0);
    int x = 0;
    while (x < 199 && at(x + 1) > half)
        ++x;
    return 0.005 * (x + (at(x) - half) / (at(x) - at(x + 1)));
}

TEST_F(PublishedTest, AsPrintedIsTooWideAndTooDim) {
    // q = 1 + z: the beam is wider by (1 + z) / z. d of a 4-vector: 2 + d^2 for 1 + d^2.
    for (const double z : {1.0, 4.0, 25.0}) {
        const Wall wall(z);
        const Frame printed = drawn("as-printed", wall.scene, wall.moment, wall.view, {.illuminance = true});
        const Frame repaired = drawn("full", wall.scene, wall.moment, wall.view, {.illuminance = true});
        const auto d2 = [&](double tangent) { return z * z * (1.0 + tangent * tangent); };
        EXPECT_NEAR(printed.illuminance_lx.at(200, 20) / repaired.illuminance_lx.at(200, 20), (1.0 + z * z) / (2.0 + z * z), 2e-3) << z;
        const double wide = half_width(printed, [&](double t) { return 2.0 + d2(t); }),
                     right = half_width(repaired, [&](double t) { return 1.0 + d2(t); });
        EXPECT_NEAR(wide / right, (1.0 + z) / z, 0.01 * (1.0 + z) / z) << z; // a hundredth: d between vertices, profile between pixels
    }
}

TEST_F(PublishedTest, LightBehindTheLampGoesWhereTheTestsLetIt) {
    // 0.5 m behind the lamp: q = 0.5 passes as printed, q = -0.5 fails where it is tested at all.
    Wall wall(-0.5);
    wall.view.yaw_rad = pi;
    const auto lux = [&](const char* technique) {
        return drawn(technique, wall.scene, wall.moment, wall.view, {.illuminance = true}).illuminance_lx.at(200, 20);
    };
    EXPECT_EQ(lux("full"), 0.0F);
    EXPECT_EQ(lux("full-no-sun"), 0.0F) << "the only lamp is the one that is tested";
    EXPECT_GT(lux("as-printed"), 0.0F);
}

TEST_F(PublishedTest, EachPairDiffersInPixelsOrInWork) {
    const Moment moment = two_lamps(moonless_lx);
    const Scene scene = ground_and_board(moment.ego, 20);
    const View view = view_towards(0.0, -4.0);
    constexpr FrameOutputs outputs{.colour = true, .illuminance = true};
    struct Drawn {
        std::string_view name;
        TechniqueKind kind;
        Frame frame;
        Work work;
    };
    std::vector<Drawn> all;
    for (const Technique& row : techniques()) {
        Renderer r = renderer(std::string(row.name), scene);
        all.push_back({row.name, row.kind, r.draw(moment, view, outputs), r.count(moment, view, outputs)});
        EXPECT_EQ(all.back().frame.illuminance_lx.empty(), !row.illuminance) << row.name;
        EXPECT_FALSE(all.back().frame.colour.empty());
        if (row.kind != TechniqueKind::ours) {
            EXPECT_EQ(all.back().work.passes, row.passes) << row.name;
            EXPECT_TRUE(r.draw(moment, view, {.target = true, .luminance = true}).target_lx.empty()) << row.name;
        }
    }
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (all[i].kind != TechniqueKind::ours || all[k].kind != TechniqueKind::ours) { // ours give the same bytes
                EXPECT_FALSE(all[i].frame.colour == all[k].frame.colour && all[i].work == all[k].work)
                    << all[i].name << " and " << all[k].name;
            }
}

TEST_F(PublishedTest, WorkIsCounted) {
    const Moment moment = two_lamps(moonless_lx);
    const Scene scene = ground_and_board(moment.ego, 4);
    const auto work = [&](const char* technique) {
        return renderer(technique, scene).count(moment, view_towards(0.0, -4.0), {.colour = true});
    };
    EXPECT_EQ(work("plain").samplers, 0);
    EXPECT_EQ(work("plain").texture_bytes, 0U);
    EXPECT_EQ(work("full").samplers, 2);
    EXPECT_EQ(work("full").lamps, 2);
    EXPECT_EQ(work("full").triangles, 2U * 4 * 4 + 2U * 2 * 2);
    EXPECT_EQ(work("two-pass-projective").triangles, 2 * work("full").triangles);
    EXPECT_GT(work("two-pass-projective").fragments, 1.9 * static_cast<double>(work("full").fragments));
    EXPECT_LE(work("two-pass-projective").fragments, 2 * work("full").fragments) << "the second pass draws over nothing";
    EXPECT_EQ(work("merged-beams").lamps, 1);
    EXPECT_EQ(work("merged-beams").samplers, 1);
    EXPECT_EQ(work("light-map-3d").texture_bytes, 256U * 128 * 32 * 4);
    EXPECT_EQ(work("light-map-2d").texture_bytes, 512U * 256 * 4);
    EXPECT_EQ(work("vertex-spots").texture_bytes, 0U);
}

TEST_F(PublishedTest, TwoPassesAddUpToOne) {
    const Moment moment = two_lamps(moonless_lx);
    Scene scene = ground_and_board(moment.ego, 40);
    scene.meshes.pop_back(); // the board glows, in one of them with its distance
    const View view = view_towards(0.0, -4.0);
    constexpr FrameOutputs outputs{.colour = true, .illuminance = true, .depth = true, .ids = true};
    const Frame two = drawn("two-pass-projective", scene, moment, view, outputs), one = drawn("full-clamped", scene, moment, view, outputs);
    EXPECT_EQ(std::tuple(two.ids, two.depth_m), std::tuple(one.ids, one.depth_m));
    int lit = 0;
    for (const auto& [x, y] : each_pixel(view)) {
        if (one.illuminance_lx.at(x, y) < 99.0F) { // each pass rounds to half a step, and so does the one
            EXPECT_NEAR(two.colour.at(x, y).b, one.colour.at(x, y).b, 1.0) << x << ' ' << y;
        } else { // white stops the sum, not the surface's colour
            EXPECT_GE(two.colour.at(x, y).b, one.colour.at(x, y).b - 1);
        }
        EXPECT_NEAR(two.illuminance_lx.at(x, y), one.illuminance_lx.at(x, y), 1e-5F * one.illuminance_lx.at(x, y));
        lit += one.colour.at(x, y).b > 30 ? 1 : 0;
    }
    EXPECT_GT(lit, 500);
}

TEST_F(PublishedTest, ColoursAndTexturesCombineAsOpenGlDoes) {
    // Encoded: own (0.5, 0.4, 0.8), texel (0.6, 1, 0.2) with opacity 0.25, blend colour (1, 0, 0.5).
    const auto linear = [](double c) { return static_cast<float>(std::pow((c + 0.055) / 1.055, 2.4)); };
    Wall wall(4.0);
    Material& material = wall.scene.materials[0];
    material.albedo = {linear(0.5), linear(0.4), linear(0.8)};
    material.blend_colour = {1.0F, 0.0F, linear(0.5)};
    SurfaceTexture texture{"plain", 4, 4, {}};
    for (int i = 0; i < 16; ++i)
        for (const double c : {0.6, 1.0, 0.2})
            texture.rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0F * linear(c))));
    std::vector<std::uint8_t> rgba;
    for (std::size_t i = 0; i < texture.rgba.size(); i += 3)
        rgba.insert(rgba.end(), {texture.rgba[i], texture.rgba[i + 1], texture.rgba[i + 2], 64});
    texture.rgba = rgba;
    const std::pair<std::optional<TextureMode>, glm::dvec3> expected[] = {{std::nullopt, {0.5, 0.4, 0.8}},
                                                                          {TextureMode::modulate, {0.3, 0.4, 0.16}},
                                                                          {TextureMode::replace, {0.6, 1.0, 0.2}},
                                                                          {TextureMode::decal, {0.525, 0.55, 0.65}},
                                                                          {TextureMode::blend, {0.8, 0.0, 0.74}}};
    for (const auto& [mode, colour] : expected) {
        material.texture = mode ? 0 : -1;
        material.texture_mode = mode.value_or(TextureMode::modulate);
        wall.scene.textures = {texture};
        const double lux =
            static_cast<double>(drawn("full", wall.scene, wall.moment, wall.view, {.illuminance = true}).illuminance_lx.at(200, 20));
        ASSERT_GT(lux, 100.0);
        const double shown[] = {1.0, 0.2, 20.0 * 271.0 * lux / ((20.0 * 271.0 - 1.0) * lux + 27100.0)};
        const char* names[] = {"texturing-only", "plain", "full"};
        for (int k = 0; k < 3; ++k) {
            const Rgb8 found = drawn(names[k], wall.scene, wall.moment, wall.view, {.colour = true}).colour.at(200, 20);
            SCOPED_TRACE(std::string(names[k]) + ", mode " + (mode ? std::to_string(static_cast<int>(*mode)) : "none"));
            // Texels come in 8 bits, linear and then encoded: 1.2 of 255 for the darkest of them; the picture is rounded once more.
            EXPECT_NEAR(found.r, 255.0 * colour.r * shown[k], 2.0);
            EXPECT_NEAR(found.g, 255.0 * colour.g * shown[k], 2.0);
            EXPECT_NEAR(found.b, 255.0 * colour.b * shown[k], 2.0);
        }
    }
}

TEST_F(PublishedTest, SheetingGlowsAndFades) {
    // No lamp, no sky: what is seen of the board is what glows. (1 - d / 500) of its colour, or all of it.
    Moment moment = two_lamps(0.0);
    moment.lamps.clear();
    Scene scene = ground_and_board(moment.ego, 4);
    const auto green = [&](const char* technique, double ahead_m) {
        scene.meshes[1] = grid(moment.ego, "board", 1, {ahead_m, -20, -20}, {0, 40, 0}, {0, 0, 40}, {-1, 0, 0}, 8, 8);
        View view = view_towards(0.0, 0.0);
        view.position_m = {0.0, 0.0, 1.0};
        return static_cast<int>(drawn(technique, scene, moment, view, {.colour = true}).colour.at(48, 32).r);
    };
    const double own = 255.0 * 0.7354; // linear 0.5
    EXPECT_NEAR(green("full", 100.0), 0.8 * own, 1.0);
    EXPECT_NEAR(green("full", 400.0), 0.2 * own, 1.0);
    EXPECT_EQ(green("full", 600.0), 0);
    EXPECT_NEAR(green("simplified", 400.0), own, 1.0);
    scene.materials[1].retro_rl = 9.0F;
    EXPECT_EQ(green("full", 100.0), 0) << "asphalt and paint do not glow";
    EXPECT_EQ(green("simplified", 100.0), 0);
    scene.materials[1].emission_cdm2 = {300.0F, 0.0F, 0.0F};
    EXPECT_NEAR(green("simplified", 100.0), own, 1.0) << "what shines by itself does";
}

TEST_F(PublishedTest, NothingCompilesOrIsMadeAfterPreparing) {
    const Moment moment = two_lamps(moonless_lx);
    Moment dark = moment;
    dark.lamps[0].intensity_factor = 0.0;
    const Scene scene = ground_and_board(moment.ego, 4);
    for (const Technique& row : techniques()) {
        if (row.kind == TechniqueKind::ours)
            continue;
        Renderer r = renderer(std::string(row.name), scene);
        constexpr FrameOutputs outputs{.colour = true};
        r.prepare({moment, dark}, view_towards(0.0, -4.0), outputs);
        const int compiled = r.compiled_programs();
        EXPECT_GT(compiled, 0);
        r.draw(moment, view_towards(0.0, -4.0), outputs);
        EXPECT_TRUE(std::ranges::none_of(r.pruned(), [](const PrunedFeature& l) { return l.why == "switched off"; }));
        r.draw(dark, view_towards(0.0, -4.0), outputs);
        EXPECT_EQ(r.pruned().at(0), (PrunedFeature{"1 of 2 lamps", "switched off"}));
        EXPECT_EQ(r.compiled_programs(), compiled) << row.name;
    }
}

/// They know no colours of lamps: whatever light the eye is adapted to, their sky is grey.
TEST_F(PublishedTest, SkyIsGreyForAnyEye) {
    const Moment moment = two_lamps(moonless_lx);
    const Scene scene = ground_and_board(moment.ego, 4);
    RendererSettings settings;
    settings.technique = "full";
    settings.white = light_adaptation({0.66, glm::dvec2(0.4234, 0.3990)});
    Renderer r(device_, scene, settings);
    const Frame frame = r.draw(moment, view_towards(0.0, 60.0), {.colour = true, .ids = true});
    ASSERT_EQ(frame.ids.at(48, 32), 0U);
    const Rgb8 sky = frame.colour.at(48, 32);
    EXPECT_GT(sky.r, 50);
    EXPECT_EQ(sky, (Rgb8{sky.r, sky.r, sky.r}));
}

TEST_F(PublishedTest, BakedLightIsMadeAnewForMovedLampsAndNotForAMovedCar) {
    Moment moment = two_lamps(moonless_lx);
    const Scene scene = ground_and_board(moment.ego, 20);
    const View view = view_towards(0.0, -4.0);
    for (const char* technique : {"merged-beams", "light-map-2d", "light-map-3d"}) {
        Renderer r = renderer(technique, scene);
        const std::size_t bytes = r.count(moment, view, lux_and_surfaces).texture_bytes;
        Moment further = moment;
        const glm::dvec3 step = moment.ego.forward() * 1.2345;
        further.ego.position_m += step;
        for (LitLamp& lamp : further.lamps)
            lamp.pose.position_m += step;
        EXPECT_EQ(r.count(further, view, lux_and_surfaces).texture_bytes, bytes) << technique;
        Moment dimmed = moment;
        for (LitLamp& lamp : dimmed.lamps)
            lamp.intensity_factor *= 0.5;
        const Frame bright = r.draw(moment, view, lux_and_surfaces), dim = r.draw(dimmed, view, lux_and_surfaces);
        EXPECT_EQ(r.count(dimmed, view, lux_and_surfaces).texture_bytes, 2 * bytes) << technique;
        const float sky = static_cast<float>(moonless_lx), full_lx = bright.illuminance_lx.at(48, 45) - sky;
        EXPECT_GT(full_lx, 1.0F);
        EXPECT_NEAR(dim.illuminance_lx.at(48, 45) - sky, 0.5F * full_lx, 1e-3F * full_lx) << technique;
    }
}

} // namespace
} // namespace fernlicht
