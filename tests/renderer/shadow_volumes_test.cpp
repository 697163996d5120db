// Shadow volumes against rays in double precision: edges within one pixel, and no surface towards the light that shades itself.
#include "scenarios/drives/play/camera.h"
#include "tests/renderer/shadow_scene.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr ShadowSettings volumes{.method = ShadowMethod::volumes, .tolerance_m = 1e-4};

Moment one_lamp(const glm::dvec3& at = {3.5, 0.6, 0.65}) { return {.lamps = {lamp_at(at, 0.0, 0.0)}}; }

class ShadowVolumesTest : public DeviceTest {
  protected:
    /// No pixel wrong but within one pixel of an edge, and there is shadow to see.
    void expect_as_rays(const Scene& scene, const Moment& moment, const View& view, const std::string& what, int min_hidden = 50) {
        const HiddenPixels pixels = hidden_pixels(device_, scene, moment, view, volumes);
        EXPECT_EQ(pixels.wrong_inside(), 0) << what;
        EXPECT_GE(pixels.count(1), min_hidden) << what;
        EXPECT_GT(pixels.count(0), 1000) << what;
        EXPECT_LE(pixels.differ(), 2 + pixels.count(1) / 50) << what << ": edges fall on the same side of nearly all centres";
    }
};

TEST_F(ShadowVolumesTest, PostsNearAndFar) {
    for (const double ahead : {5.0, 20.0, 80.0}) {
        Scene scene = level_road_for_shadows();
        scene.meshes.push_back(box({3.5 + ahead, 0.3, 0.0}, {-0.05F, -0.05F, 0.0F}, {0.05F, 0.05F, 1.0F}));
        View view = driver_for_shadows();
        if (ahead > 50.0) { // a picture of where it stands
            view.vertical_fov_rad = radians(4.0);
            view.pitch_rad = radians(-1.0);
        }
        expect_as_rays(scene, one_lamp(), view, fmt::format("post at {} m", ahead), 20);
    }
}

TEST_F(ShadowVolumesTest, AFenceOfOpenSheets) {
    Scene scene = level_road_for_shadows();
    Mesh fence = thing({12.0, 0.0, 0.0});
    for (int i = 0; i < 30; ++i) { // slats towards the lamp and away from it in turn
        const float y = -6.0F + 0.4F * static_cast<float>(i);
        if (i % 2 == 0)
            add_flat(fence, 1, {0, y, 0}, {0, y, 1.2F}, {0, y + 0.1F, 1.2F}, {0, y + 0.1F, 0});
        else
            add_flat(fence, 1, {0, y, 0}, {0, y + 0.1F, 0}, {0, y + 0.1F, 1.2F}, {0, y, 1.2F});
    }
    scene.meshes.push_back(fence);
    scene.meshes.push_back(box({25.0, 0.0, 0.0}, {0, -12, 0}, {0.3F, 12, 3}, "wall"));
    expect_as_rays(scene, one_lamp(), driver_for_shadows(), "fence", 1000);
}

TEST_F(ShadowVolumesTest, ABodyThatMovesCloseBeforeTheLampAndAsItTurns) {
    Scene scene = level_road_for_shadows();
    Mesh car = thing({0.0, 0.0, 0.0}, "car");
    car.body = 0;
    add_box(car, 1, {-1.0F, -0.9F, 0.2F}, {3.0F, 0.9F, 0.8F});
    add_box(car, 1, {0.0F, -0.8F, 0.8F}, {2.0F, 0.8F, 1.4F});
    scene.meshes.push_back(car);
    scene.meshes.push_back(box({40.0, 0.0, 0.0}, {0, -25, 0}, {0.3F, 25, 6}, "wall"));
    for (const double ahead : {4.6, 6.0, 15.0})
        for (const double yaw : {0.0, 0.7}) {
            Moment moment = one_lamp();
            moment.bodies.push_back({"car", {{ahead + 1.0, 1.0, 0.0}, axes_from_angles(yaw, 0.02, 0.01)}, true, 0.0, false});
            expect_as_rays(scene, moment, driver_for_shadows(), fmt::format("car at {} m, turned by {}", ahead, yaw), 500);
        }
}

TEST_F(ShadowVolumesTest, TheCameraInAShadowAndTheLampInABody) {
    Scene scene = level_road_for_shadows();
    scene.meshes.push_back(box({8.0, 0.0, 0.0}, {0, -1.5F, 0.0F}, {0.4F, 1.5F, 1.0F}, "slab"));
    View behind = driver_for_shadows();
    behind.position_m = {11.0, 0.3, 0.7}; // beyond the slab, within its shadow
    behind.yaw_rad = radians(25.0);
    expect_as_rays(scene, one_lamp(), behind, "camera in shadow", 500);
    View back = driver_for_shadows();
    back.position_m = {30.0, 3.0, 6.0};
    back.yaw_rad = pi;
    back.pitch_rad = radians(-15.0);
    expect_as_rays(scene, one_lamp(), back, "looking back", 500);
    const Moment within = one_lamp({8.2, 0.0, 0.5});
    const HiddenPixels dark = hidden_pixels(device_, scene, within, driver_for_shadows(), volumes);
    EXPECT_EQ(dark.wrong_inside(), 0);
    EXPECT_EQ(dark.count(0), 0) << "a lamp in a closed body lights nothing outside";
    EXPECT_GT(dark.count(1), 1000);
}

/// Bodies whose faces towards the lamp see all of it: a sphere in facets, a cylinder, boards; nothing on them may be dark.
TEST_F(ShadowVolumesTest, NoAcneOnFacesTowardsTheLight) {
    for (const double ahead : {6.0, 30.0, 150.0}) {
        Scene scene = level_road_for_shadows();
        Mesh ball = thing({ahead, -1.0, 1.2}, "ball");
        constexpr int rings = 12, sides = 24;
        const auto at = [](int ring, int side) {
            const double v = pi * ring / rings, h = 2.0 * pi * (side % sides) / sides;
            return glm::vec3(0.8 * std::sin(v) * std::cos(h), 0.8 * std::sin(v) * std::sin(h), -0.8 * std::cos(v));
        };
        for (int r = 0; r < rings; ++r)
            for (int s = 0; s < sides; ++s) {
                const auto first = static_cast<std::uint32_t>(ball.vertices.size());
                const glm::vec3 corners[] = {at(r, s), at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)};
                const glm::vec3 normal = glm::normalize(glm::cross(corners[2] - corners[0], corners[3] - corners[1]));
                for (const glm::vec3& p : corners)
                    ball.vertices.push_back({p, normal, {}});
                ball.indices.insert(ball.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
            }
        ball.batches = {{1, 0, static_cast<std::uint32_t>(ball.indices.size())}};
        scene.meshes.push_back(ball);
        Mesh board = thing({ahead, 2.0, 1.0}, "board"); // nearly along the light
        add_flat(board, 1, {0, 0, -0.5F}, {4.0F, -0.05F, -0.5F}, {4.0F, -0.05F, 0.5F}, {0, 0, 0.5F});
        scene.meshes.push_back(board);
        View view = driver_for_shadows();
        view.vertical_fov_rad = 2.0 * std::atan(4.0 / ahead);
        view.pitch_rad = 0.0;
        const HiddenPixels pixels = hidden_pixels(device_, scene, one_lamp(), view, volumes);
        EXPECT_EQ(pixels.wrong_inside(), 0) << ahead;
        EXPECT_GT(pixels.count(0), 3000) << ahead;
    }
}

TEST_F(ShadowVolumesTest, CrestsShadeWhatLiesBehindAndNotThemselves) {
    Scene scene = level_road_for_shadows();
    scene.meshes.clear();
    Mesh road = thing({0.0, 0.0, 0.0}, "road");
    const auto height = [](int i) { return static_cast<float>(0.5 * (1.0 - std::cos(0.15 * i)) - 0.5); }; // waves 42 m long, 1 m high
    for (int i = -10; i < 100; ++i) {
        const auto x = static_cast<float>(i);
        const auto first = static_cast<std::uint32_t>(road.vertices.size());
        for (const int k : {0, 1})
            for (const float y : {-10.0F, 10.0F}) {
                const glm::vec3 slope(1.0F, 0.0F, 0.075F * std::sin(0.15F * (x + static_cast<float>(k))));
                road.vertices.push_back(
                    {{x + static_cast<float>(k), y, height(i + k)}, glm::normalize(glm::vec3(-slope.z, 0.0F, 1.0F)), {}});
            }
        road.indices.insert(road.indices.end(), {first, first + 2, first + 3, first, first + 3, first + 1});
    }
    road.batches = {{0, 0, static_cast<std::uint32_t>(road.indices.size())}};
    scene.meshes.push_back(road);
    View view = driver_for_shadows();
    view.position_m.z = 8.0;
    view.pitch_rad = radians(-12.0);
    expect_as_rays(scene, one_lamp({3.5, 0.6, 0.3}), view, "waves", 500);
    expect_as_rays(scene, one_lamp({3.5, 0.6, 0.3}), map_for_shadows(90.0, 9.0, 4), "waves from above", 500);
}

TEST_F(ShadowVolumesTest, MapsAndTargetsAboveTheRoad) {
    Scene scene = level_road_for_shadows();
    scene.meshes.push_back(box({12.0, 0.5, 0.0}, {0, -0.8F, 0}, {0.3F, 0.8F, 0.4F}, "low"));
    scene.meshes.push_back(box({20.0, 0.0, 0.0}, {0, -5, 5}, {0.5F, 5, 6}, "gantry")); // shades nothing on the ground
    const Moment moment = one_lamp();
    const View map = map_for_shadows(60.0, 12.0, 5);
    expect_as_rays(scene, moment, map, "map", 1000);

    const Frame with = drawn_with(device_, scene, moment, map, ShadowMethod::volumes),
                without = drawn_with(device_, scene, moment, map, ShadowMethod::none);
    const Twin twin(scene, true);
    const Camera camera = camera_of(moment, map);
    const auto hidden = [&](double x, double y) {
        glm::dvec3 target = pixel_ray(camera, map, x, y).origin_m;
        target.z = RendererSettings{}.target_height_m;
        const glm::dvec3 way = moment.lamps[0].pose.position_m - target;
        const auto met = twin.cast(moment, {target, glm::normalize(way)}, 1e-6, Twin::Met::casters);
        return met && met->distance_m < glm::length(way);
    };
    int wrong = 0, dark = 0, differs_from_ground = 0;
    for (const auto& [x, y] : each_pixel(map)) {
        if (without.target_lx.at(x, y) == 0.0F)
            continue;
        const bool here = hidden(x + 0.5, y + 0.5);
        dark += here ? 1 : 0;
        differs_from_ground += here != (with.illuminance_lx.at(x, y) == 0.0F) ? 1 : 0;
        if (here == (with.target_lx.at(x, y) == 0.0F))
            continue;
        bool edge = false;
        for (const double dx : {-1.0, 0.0, 1.0})
            for (const double dy : {-1.0, 0.0, 1.0})
                edge = edge || hidden(x + 0.5 + dx, y + 0.5 + dy) != here;
        wrong += edge ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(dark, 100);
    EXPECT_GT(differs_from_ground, 100) << "targets stand higher than the road: the low box hides fewer of them";
}

/// A count of 8 bits that wraps: 255 bodies one behind another are dark, 257 are, 256 are as none.
TEST_F(ShadowVolumesTest, CountsEndAt255Layers) {
    for (const int layers : {1, 127, 128, 255, 256, 257}) {
        Scene scene = level_road_for_shadows();
        Mesh stack = thing({10.0, 0.6, 0.0}, "stack");
        for (int i = 0; i < layers; ++i) {
            const float x = 0.004F * static_cast<float>(i);
            add_flat(stack, 1, {x, -0.5F, 0}, {x, -0.5F, 0.5F}, {x, 0.5F, 0.5F}, {x, 0.5F, 0});
        }
        scene.meshes.push_back(stack);
        const Moment moment = one_lamp();
        const View map = map_for_shadows(40.0, 4.0, 5);
        const Frame with = drawn_with(device_, scene, moment, map, ShadowMethod::volumes);
        const glm::dvec2 at = map_pixel(camera_of(moment, map), map, moment, {15.0, 0.6, 0.0});
        const float lx = with.illuminance_lx.at(static_cast<int>(at.x), static_cast<int>(at.y));
        EXPECT_EQ(lx > 0.0F, layers == 256) << layers;
    }
}

Scene busy_scene() {
    Scene scene = level_road_for_shadows();
    Mesh posts = thing({10.0, 0.0, 0.0}, "posts");
    for (int i = 0; i < 12; ++i)
        add_box(posts, 1, {3.0F * static_cast<float>(i), -3.1F, 0}, {3.0F * static_cast<float>(i) + 0.1F, -3.0F, 1.0F});
    scene.meshes.push_back(posts);
    Mesh car = thing({0.0, 0.0, 0.0}, "car");
    car.body = 0;
    add_box(car, 1, {-1.0F, -0.9F, 0.2F}, {3.0F, 0.9F, 1.4F});
    scene.meshes.push_back(car);
    return scene;
}

Moment busy_moment(double time_s) {
    Moment moment;
    moment.ego.position_m.x = 3.0 * time_s;
    moment.lamps = {lamp_at({3.5 + 3.0 * time_s, 0.6, 0.65}), lamp_at({3.5 + 3.0 * time_s, -0.6, 0.65}, 0.1, -0.01)};
    moment.lamps[1].intensity_factor = time_s > 1.5 ? 0.0 : 1.0;
    moment.bodies.push_back({"car", {{14.0 + 2.0 * time_s, 1.0, 0.0}, axes_from_angles(0.2 * time_s, 0.0, 0.0)}, true, 0.0, false});
    return moment;
}

/// Maps have a window, 24 degrees downwards; hulls and planes do not need one.
TEST_F(ShadowVolumesTest, WhatStandsBelowTheWindowOfAMapCastsToo) {
    Scene scene = level_road_for_shadows();
    scene.meshes.push_back(box({5.5, 0.6, 0.6}, {-0.1F, -0.1F, 0.0F}, {0.1F, 0.1F, 0.2F}));
    const Moment moment = one_lamp({3.5, 0.6, 2.0}); // 31 degrees above it
    for (const ShadowMethod method : {ShadowMethod::volumes, ShadowMethod::planar}) {
        const HiddenPixels pixels = hidden_pixels(device_, scene, moment, map_for_shadows(10.0, 3.0, 20), {.method = method});
        EXPECT_EQ(pixels.wrong_inside(), 0) << name(method);
        EXPECT_GT(pixels.count(1), 30) << name(method);
    }
}

TEST_F(ShadowVolumesTest, PrunedAndUnprunedGiveTheSameBytesWhateverWasDrawnBefore) {
    const Scene scene = busy_scene();
    for (const ShadowMethod method : {ShadowMethod::volumes, ShadowMethod::planar, ShadowMethod::under_car}) {
        RendererSettings settings{.shadows = {.method = method}};
        Renderer pruned(device_, scene, settings);
        settings.technique = "photometric-unpruned";
        Renderer unpruned(device_, scene, settings);
        View mirror = driver_for_shadows();
        mirror.mirrored = true;
        for (const double time_s : {0.0, 1.0, 1.0, 2.0})
            for (const View& view : {driver_for_shadows(), map_for_shadows(60.0, 10.0, 5), mirror}) {
                const std::string what = fmt::format("{} {} at {} s", name(method), view.name, time_s);
                const Frame frame = pruned.draw(busy_moment(time_s), view, all_results);
                expect_same_frames(frame, unpruned.draw(busy_moment(time_s), view, all_results), what);
                expect_same_frames(frame, drawn_with(device_, scene, busy_moment(time_s), view, method), what + ", alone");
            }
    }
}

TEST_F(ShadowVolumesTest, CostNothingWhereNothingStandsInABeam) {
    const Scene scene = busy_scene();
    for (const ShadowMethod method : {ShadowMethod::volumes, ShadowMethod::planar}) {
        RendererSettings settings{.shadows = {.method = method}};
        Renderer renderer(device_, scene, settings);
        Moment moment = busy_moment(0.0);
        EXPECT_EQ(renderer.count(moment, driver_for_shadows(), all_results).passes, 1 + 2 * 2 + 1)
            << "depth, surfaces and targets of two lamps, the view";
        for (LitLamp& lamp : moment.lamps)
            lamp.pose.axes = axes_from_angles(pi, 0.0, 0.0); // backwards, where nothing stands
        EXPECT_EQ(renderer.count(moment, driver_for_shadows(), all_results).passes, 1);
        renderer.draw(moment, driver_for_shadows(), all_results);
        const std::string title = method == ShadowMethod::volumes ? "shadow volumes" : "planar shadows";
        EXPECT_TRUE(std::ranges::any_of(renderer.pruned(), [&](const PrunedFeature& one) { return one.what == title; }));
    }
}

/// The mask's textures are made when something first casts, whatever was prepared; pictures do not depend on it.
TEST_F(ShadowVolumesTest, TexturesAreMadeWhenSomethingFirstCasts) {
    const Scene scene = busy_scene();
    Moment near = busy_moment(0.0), away = near;
    for (LitLamp& lamp : away.lamps)
        lamp.pose.axes = axes_from_angles(pi, 0.0, 0.0); // backwards, where nothing stands
    const View view = driver_for_shadows();
    RendererSettings settings{.shadows = {.method = ShadowMethod::none}, .light_pass = LightPass::shader};
    Renderer none(device_, scene, settings);
    const std::size_t least = none.count(near, view, all_results).texture_bytes;
    for (const ShadowMethod method : {ShadowMethod::volumes, ShadowMethod::planar, ShadowMethod::under_car}) {
        settings.shadows.method = method;
        Renderer renderer(device_, scene, settings);
        renderer.prepare({away, near}, view, all_results);
        expect_same_frames(renderer.draw(away, view, all_results), none.draw(away, view, all_results), std::string(name(method)));
        EXPECT_EQ(renderer.count(away, view, all_results).texture_bytes, least) << name(method);
        // One picture: 2 bytes a pixel of the mask, 8 of depth and stencil; drawn again it needs no more.
        const std::size_t mask = 10 * static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px);
        for (int i = 0; i < 2; ++i)
            EXPECT_EQ(renderer.count(near, view, all_results).texture_bytes, least + mask) << name(method);
        expect_same_frames(renderer.draw(near, view, all_results), drawn_with(device_, scene, near, view, method),
                           std::string(name(method)) + ", alone");
    }
}

} // namespace
} // namespace fernlicht
