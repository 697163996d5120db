#include "runner/experiments/town/town.h"

#include "runner/experiments/town/two_lamps.h"
#include "scenarios/light/light.h"
#include "scenarios/models/triangle_soup.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"
#include "tests/scenarios/models/written_gltf.h"
#include "tests/trial.h"

#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

/// Ground of 300 m x 60 m, and a house 2 m wide that stands 12 to 14 m ahead of the lamps of a car at the origin, to its right.
Model town() {
    Model model;
    model.name = "town";
    model.materials = {{.name = "ground", .albedo = glm::vec3(0.1F)}, {.name = "house", .albedo = glm::vec3(0.4F)}};
    TriangleSoup soup;
    append_box(soup, {-100, -30, -1}, {200, 30, 0}, 0);
    append_box(soup, {15.6, -4, 0}, {17.6, -2, 5}, 1);
    add_meshes(model, soup);
    return model;
}

TownRequest small_request() {
    TownRequest request;
    request.width_px = 160;
    request.height_px = 90;
    request.at_m = glm::dvec2(0.0);
    request.heading_rad = 0.0;
    return request;
}

/// Of both lamps on level ground, from the tables, without the renderer and without shadows.
double lux_at(const glm::dvec3& point_m) { return surface_illuminance_lx(in_two_lamps("halogen-low", {}), point_m, {0.0, 0.0, 1.0}); }

TEST(Town, LuxOnTheGroundIsThatOfTheLamps) {
    const TownFound found = look_at_town(town(), small_request());
    EXPECT_EQ(found.car.position_m, glm::dvec3(0.0));
    for (const TownFound::Row& row : found.rows) {
        const double expected = lux_at({two_lamps_x_m + row.ahead_m, 0.0, 0.0});
        EXPECT_NEAR(row.ground_lx[1].value(), expected, 0.002 * expected + 1e-4) << row.ahead_m;
    }
    EXPECT_EQ(found.rows[3].ahead_m, 20.0);
    EXPECT_LT(found.rows[3].ground_lx[2].value(), 0.6 * lux_at({two_lamps_x_m + 20.0, -3.0, 0.0})) << "behind the house";
    // The picture from above has the same light, by the renderer.
    const int row = static_cast<int>((found.map.ahead_m - two_lamps_x_m - 20.0) / 0.25);
    EXPECT_NEAR(found.map.lx.at(found.map.lx.width() / 2, row), found.rows[3].ground_lx[1].value(), 0.4);
    EXPECT_EQ(found.view.width(), 160);
}

TEST(Town, AModelWithoutAStreetIsDoubted) {
    EXPECT_EQ(look_at_town(town(), small_request()).doubt, "");
    Model van = town();
    van.meshes.clear();
    TriangleSoup soup;
    append_box(soup, {0, -1, 0}, {5, 1, 2}, 1);
    add_meshes(van, soup);
    EXPECT_THAT(look_at_town(van, {.width_px = 160, .height_px = 90}).doubt, testing::HasSubstr("is this a model of streets"));
}

TEST(Town, ThePictureIsThatOfAnEyeAdaptedToTheLamps) {
    const Moment moment = in_two_lamps("halogen-low", {});
    const glm::dvec3 light = moment.lamps.front().colour.linear_srgb, seen = white_of(moment).value() * light;
    const auto warmth = [](const glm::dvec3& c) { return (c.x - c.z) / c.y; };
    EXPECT_GT(warmth(seen), 0.1) << "partly: halogen stays warm";
    EXPECT_LT(warmth(seen), 0.6 * warmth(light));
}

TEST(Town, WhereNoCarCanStandIsSaid) {
    TownRequest request = small_request();
    request.at_m = glm::dvec2(500.0, 0.0);
    EXPECT_THAT(tests::refusal_of([&] { look_at_town(town(), request); }), testing::HasSubstr("--place: no ground at 500, 0"));
    Model wall;
    wall.materials = {{.name = "wall"}};
    TriangleSoup soup;
    soup.add({glm::dvec3(0, 0, 0), glm::dvec3(9, 0, 0), glm::dvec3(0, 0, 9)}, 0);
    add_meshes(wall, soup);
    request.at_m.reset();
    EXPECT_THAT(tests::refusal_of([&] { look_at_town(wall, request); }), testing::HasSubstr("no ground that a car could stand on"));
    request = small_request();
    request.lamp = "nothing.ies";
    EXPECT_THAT(tests::refusal_of([&] { look_at_town(town(), request); }), testing::HasSubstr("--low-beams: found 'nothing.ies'"));
}

TEST(Town, TheCommandWritesToANewFolderAlone) {
    const TemporaryFolder folder;
    test::WrittenGltf({{-30, 0, -100}, {-30, 0, 200}, {30, 0, 200}, {30, 0, -100}}, {0, 1, 2, 0, 2, 3}).write_glb(folder / "ground.glb");
    const std::string call = fmt::format("town {}/ground.glb --out {}/night", folder.path().string(), folder.path().string());
    const Outcome drawn = run_program(call);
    EXPECT_EQ(drawn.exit_code, 0) << drawn.output;
    const std::string picture = content_of(folder / "night/driver.png");
    EXPECT_THAT(content_of(folder / "night/town.txt"), testing::HasSubstr("lux on the ground"));
    EXPECT_FALSE(std::filesystem::exists(folder / "night/INCOMPLETE"));
    const Outcome again = run_program(call + " --yaw 90");
    EXPECT_EQ(again.exit_code, 2) << again.output;
    EXPECT_THAT(again.output, testing::HasSubstr("night"));
    EXPECT_EQ(content_of(folder / "night/driver.png"), picture);
}

} // namespace
} // namespace fernlicht
