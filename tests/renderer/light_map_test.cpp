#include "renderer/light_map.h"
#include "renderer/renderer.h"
#include "renderer/twin.h"
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/lamps/lamp_model.h"
#include "scenarios/light/light.h"
#include "scenarios/models/road_user_bodies.h"
#include "tests/renderer/reference/rooms.h"

namespace fernlicht {
namespace {

Moment two_dim_lamps() {
    static const auto file = std::make_shared<LampFile>(lamp_of_model(lamp_models()[0]));
    Moment moment;
    for (const double side : {0.6, -0.6})
        moment.lamps.push_back({"lamp", file, Pose{{3.5, side, 0.65}, axes_from_angles(0.01 * side, 0.0, 0.0)}, 1.0, {}, 0.0});
    return moment;
}

Moment moved(Moment moment, const Pose& car) {
    moment.ego = compose(car, moment.ego);
    for (LitLamp& lamp : moment.lamps)
        lamp.pose = compose(car, lamp.pose);
    return moment;
}

/// 625 cd in every direction, 1 m above the road over the car's origin.
Moment one_even_lamp() { return {.lamps = {even_lamp(625.0, {{0.0, 0.0, 1.0}, glm::dmat3(1.0)})}}; }

TEST(LightMapAxis, IsEvenOrGrowsAndComesBack) {
    EXPECT_DOUBLE_EQ(position_m({-2.0, 6.0, 32, 1.0}, 0.25), 0.0);
    const LightMapAxis growing{10.0, 40.0, 2, 4.0}; // (4^u - 1) / 3: half way at u = 0.5 is a third of the length
    EXPECT_NEAR(position_m(growing, 0.5), 20.0, 1e-12);
    EXPECT_NEAR(position_m(growing, 1.0), 40.0, 1e-12);
    for (const double u : {0.0, 0.1, 0.77, 1.0})
        EXPECT_NEAR(texture_coordinate(growing, position_m(growing, u)), u, 1e-12);
    const LightMapAxis ahead = GroundMapExtent{}.ahead;
    EXPECT_NEAR(position_m(ahead, 1.0 / 512) - ahead.from_m, 0.036, 0.001);
    EXPECT_NEAR(ahead.to_m - position_m(ahead, 511.0 / 512), 0.576, 0.003);
}

TEST(LightMap, NodesHoldTheLightThere) {
    const Moment moment = two_dim_lamps();
    const VolumeMapExtent extent{{0.0, 100.0, 64, 8.0}, {-25.0, 25.0, 32, 1.0}, {-2.0, 6.0, 16, 1.0}};
    const LightMap ground = bake_ground(moment), volume = bake_volume(moment, extent);
    EXPECT_EQ(ground.bytes(), 512u * 256u * 4u);
    EXPECT_EQ(volume.bytes(), 64u * 32u * 16u * 4u);
    for (const LightMap* map : {&ground, &volume}) {
        double most = 0.0;
        for (int k = 0; k < map->up.cells; ++k)
            for (const auto& [i, row] : each_pixel(map->ahead.cells, map->left.cells)) {
                const glm::dvec3 p{100.0 * (std::pow(map->ahead.growth, (i + 0.5) / map->ahead.cells) - 1.0) / (map->ahead.growth - 1.0),
                                   -25.0 + 50.0 * (row + 0.5) / map->left.cells,
                                   map == &volume ? -2.0 + 8.0 * (k + 0.5) / map->up.cells : 0.0};
                if (glm::distance(p, moment.lamps[0].pose.position_m) < 0.5 || glm::distance(p, moment.lamps[1].pose.position_m) < 0.5)
                    continue;
                const double truth = map == &volume ? target_illuminance_lx(moment, p) : surface_illuminance_lx(moment, p, {0.0, 0.0, 1.0});
                const int at = (k * map->left.cells + row) * map->ahead.cells + i;
                ASSERT_NEAR(static_cast<double>(map->lx[static_cast<std::size_t>(at)]), truth, 1e-6 * truth + 1e-9) << p.x << ' ' << p.y;
                ASSERT_NEAR(mapped_lx(*map, p), truth, 1e-6 * truth + (map == &volume ? 1e-6 * most + 1e-4 : 1e-6));
                most = std::max(most, truth);
            }
        EXPECT_GT(most, map == &volume ? 100.0 : 10.0);
    }
}

TEST(LightMap, GroundUnderAnEvenLampIsInClosedForm) {
    const LightMap map = bake_ground(one_even_lamp(), {{0.0, 8.0, 2, 1.0}, {-3.0, 3.0, 3, 1.0}});
    const auto lx = [](double x, double y) { return 625.0 / std::pow(1.0 + x * x + y * y, 1.5); };
    const std::vector<double> expected{lx(2, -2), lx(6, -2), lx(2, 0), lx(6, 0), lx(2, 2), lx(6, 2)};
    ASSERT_EQ(map.lx.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(static_cast<double>(map.lx[i]), expected[i], 1e-5 * expected[i]) << i;
    EXPECT_NEAR(mapped_lx(map, {4.0, 0.0, 0.0}), 0.5 * (expected[2] + expected[3]), 1e-4);
    EXPECT_NEAR(mapped_lx(map, {2.0, 1.0, 0.0}), 0.5 * (expected[2] + expected[4]), 1e-4);
    EXPECT_EQ(mapped_lx(map, {8.1, 0.0, 0.0}), 0.0);
    EXPECT_EQ(mapped_lx(map, {-0.1, 0.0, 0.0}), 0.0);
    // Midway: the mean of four texels against the light there.
    const double wrong = std::abs((expected[0] + expected[1] + expected[2] + expected[3]) / 4.0 - lx(4, -1));
    EXPECT_NEAR(map.error.worst_lx, wrong, 1e-4);
    ASSERT_TRUE(map.error.p95_relative);
    EXPECT_NEAR(*map.error.p95_relative, wrong / lx(4, -1), 1e-5);
}

TEST(LightMap, VolumeHasNoPoleInALamp) {
    // One cell's centre is the lamp itself, where the direction is none; the next ones are 0.2 and 1 m away.
    const LightMap map = bake_volume(one_even_lamp(), {{-0.1, 0.5, 3, 1.0}, {-1.5, 1.5, 3, 1.0}, {0.5, 1.5, 1, 1.0}});
    ASSERT_EQ(map.lx.size(), 9u);
    for (const float lx : map.lx)
        EXPECT_TRUE(std::isfinite(lx));
    EXPECT_EQ(map.lx[4], 2500.0F);                // 625 / 0.5^2
    EXPECT_NEAR(map.lx[1], 625.0F / 1.04F, 1e-2); // 0.2 m ahead, 1 m to the right
}

TEST(LightMap, MovingCarAndLampsTogetherChangesNothing) {
    const GroundMapExtent ground{{0.0, 100.0, 64, 16.0}, {-25.0, 25.0, 32, 1.0}};
    const VolumeMapExtent volume{{0.0, 100.0, 32, 8.0}, {-25.0, 25.0, 16, 1.0}, {-2.0, 6.0, 8, 1.0}};
    const Moment here = two_dim_lamps(), there = moved(here, {{4.2e6, -1.7e6, 310.0}, axes_from_angles(2.0, 0.08, -0.03)});
    const auto same = [](const std::vector<float>& a, const std::vector<float>& b) {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) // 1e-9 m of a map's coordinates, at a cut-off of some 500 per radian
            ASSERT_NEAR(a[i], b[i], 1e-5F * a[i] + 1e-6F) << i;
    };
    same(bake_ground(here, ground).lx, bake_ground(there, ground).lx);
    same(bake_volume(here, volume).lx, bake_volume(there, volume).lx);
}

TEST(LightMap, LampsThatAreOffAddNothingAndAxesNeedCells) {
    Moment moment = two_dim_lamps();
    const LightMap lit = bake_ground(moment, {{0.0, 50.0, 16, 1.0}, {-5.0, 5.0, 8, 1.0}});
    moment.daylight.horizontal_illuminance_lx = 100.0;
    EXPECT_EQ(bake_ground(moment, {lit.ahead, lit.left}).lx, lit.lx);
    for (LitLamp& lamp : moment.lamps)
        lamp.intensity_factor = 0.0;
    const LightMap dark = bake_ground(moment, {lit.ahead, lit.left});
    EXPECT_EQ(dark.lx, std::vector<float>(dark.lx.size(), 0.0F));
    EXPECT_EQ(dark.error.worst_lx, 0.0);
    EXPECT_FALSE(dark.error.p95_relative);
    const Moment other_moment = two_dim_lamps();
    EXPECT_THROW(bake_ground(other_moment, {{0.0, 1.0, 0, 1.0}, {0.0, 1.0, 1, 1.0}}), std::invalid_argument);
    EXPECT_THROW(bake_ground(other_moment, {{0.0, 0.0, 4, 1.0}, {0.0, 1.0, 4, 1.0}}), std::invalid_argument);
    EXPECT_THROW(bake_ground(other_moment, {{0.0, 1.0, 4, 0.0}, {0.0, 1.0, 4, 1.0}}), std::invalid_argument);
    EXPECT_THROW(bake_volume(other_moment, {{0, 1, 60000, 1}, {0, 1, 60000, 1}, {0, 1, 60000, 1}}), std::invalid_argument);
}

TEST(LightMap, FinerMapsErrLess) {
    const Moment moment = two_dim_lamps();
    const LightMap coarse = bake_ground(moment, {{0.0, 100.0, 128, 16.0}, {-25.0, 25.0, 64, 1.0}}), fine = bake_ground(moment);
    ASSERT_TRUE(coarse.error.p95_relative && fine.error.p95_relative);
    EXPECT_LT(*fine.error.p95_relative, 0.5 * *coarse.error.p95_relative);
    EXPECT_LT(*fine.error.p95_relative, 0.02);
    const LightMap volume = bake_volume(moment);
    EXPECT_EQ(volume.bytes(), std::size_t{4} << 20);
    ASSERT_TRUE(volume.error.p95_relative);
    EXPECT_GT(*volume.error.p95_relative, *fine.error.p95_relative);
}

// The own car's body hides what lies behind it and takes no light from the road; a red reflector is seen red, as bright as its R_A says.

Scene level_road() {
    return {.materials = {{.name = "road", .kind = SurfaceKind::road}},
            .meshes = {quads("road", 0, {}, {{{-20, -40, 0}, {160, -40, 0}, {160, 40, 0}, {-20, 40, 0}}})}};
}

Moment two_low_beams() {
    static const auto file = std::make_shared<const LampFile>(lamp_of_model(lamp_models().at(0)));
    Moment moment;
    for (const double side : {0.558, -0.558}) {
        moment.lamps.push_back({.file = file, .pose = {{3.604, side, 0.587}, glm::dmat3(1.0)}, .colour = colour_of_temperature(3200.0)});
    }
    moment.daylight.horizontal_illuminance_lx = 0.2;
    return moment;
}

View over_the_bonnet() {
    return {.name = "driver", .position_m = {1.3, 0.35, 1.2}, .pitch_rad = radians(-6.0), .width_px = 160, .height_px = 120};
}

TEST(OwnCar, HidesWhatIsBehindItAndTakesNoLight) {
    constexpr FrameOutputs outputs{.illuminance = true, .luminance = true, .ids = true};
    Drive drive{.views = {over_the_bonnet()}};
    drive.own_car.emplace().model = std::make_shared<const Model>(car_body({}));
    const Scene without = level_road();
    Scene with = without;
    add_own_car(with, drive);
    ASSERT_EQ(with.meshes.size(), 2U);
    Moment moment = two_low_beams();
    moment.bodies.push_back({"own car", moment.ego, true, 0.0, true});
    Device device = open_device("auto");
    Renderer plain(device, without, {}), body(device, with, {});
    const Frame a = plain.draw(two_low_beams(), over_the_bonnet(), outputs), b = body.draw(moment, over_the_bonnet(), outputs);
    const Twin twin(with, true);
    std::size_t hidden = 0, road = 0;
    for (std::size_t i = 0; i < a.ids.size(); ++i) {
        if (b.ids.pixels()[i] == 2) {
            ++hidden;
            continue;
        }
        EXPECT_EQ(a.ids.pixels()[i], b.ids.pixels()[i]);
        EXPECT_EQ(a.illuminance_lx.pixels()[i], b.illuminance_lx.pixels()[i]) << "the body stands in no light's way";
        road += b.ids.pixels()[i] == 1 ? 1U : 0U;
    }
    EXPECT_GT(hidden, a.ids.size() / 10);
    EXPECT_GT(road, a.ids.size() / 10);
    // The eye looks down onto the bonnet, where twin and renderer see the sky's light alone.
    const int x = 80, y = 100;
    const TwinPixel pixel = twin.pixel(moment, over_the_bonnet(), x + 0.5, y + 0.5);
    EXPECT_EQ(pixel.id, b.ids.at(x, y));
    EXPECT_NEAR(static_cast<double>(b.illuminance_lx.at(x, y)), pixel.illuminance_lx, 1e-5);
    moment.bodies.clear();
    EXPECT_EQ(body.draw(moment, over_the_bonnet(), outputs).illuminance_lx, a.illuminance_lx) << "and is gone where the moment has none";
}

/// A wall that returns 100 cd/(lx m2) at the observation angle of the picture: red against white.
TEST(RetroTint, RedIsRedAndAsBrightAsItsFigure) {
    const auto drawn = [](const glm::vec3& rgb, double kelvin, const char* technique) {
        Scene scene = level_road();
        scene.materials.push_back({.name = "sheet", .albedo = glm::vec3(0.0F), .retro_rl = 100.0F, .retro_rgb = rgb});
        scene.meshes.push_back(quads("sheet", 1, {30, 0, 0}, {{{0, 3, 0.2}, {0, -3, 0.2}, {0, -3, 2}, {0, 3, 2}}}));
        Moment moment = two_low_beams();
        moment.daylight.horizontal_illuminance_lx = 0.0;
        for (LitLamp& lamp : moment.lamps)
            lamp.colour = colour_of_temperature(kelvin);
        View view = over_the_bonnet();
        view.pitch_rad = radians(-1.5);
        view.vertical_fov_rad = radians(6.0);
        RendererSettings settings{.technique = technique};
        Device device = open_device("auto");
        Renderer renderer(device, scene, settings);
        const Frame frame = renderer.draw(moment, view, {.colour = true, .luminance = true});
        const Twin twin(scene, true);
        const TwinPixel pixel = twin.pixel(moment, view, 80.5, 60.5);
        EXPECT_NEAR(static_cast<double>(frame.luminance_cdm2.at(80, 60)), pixel.luminance_cdm2, 1e-3 * pixel.luminance_cdm2) << technique;
        return std::pair(pixel.luminance_cdm2, frame.colour.at(80, 60).g); // and green of the picture
    };
    for (const char* technique : {"photometric", "photometric-unpruned", "photometric-naive"}) {
        const auto [white, white_green] = drawn(glm::vec3(1.0F), 2856.0, technique);
        const auto [red, red_green] = drawn({1.0F, 0.0F, 0.0F}, 2856.0, technique);
        EXPECT_GT(white, 0.1);
        EXPECT_NEAR(red, white, 1e-9 * white) << "R_A holds in illuminant A";
        EXPECT_LT(drawn({1.0F, 0.0F, 0.0F}, 4300.0, technique).first, 0.85 * white);
        EXPECT_GT(white_green, 0);
        EXPECT_EQ(red_green, 0);
    }
}

} // namespace
} // namespace fernlicht
