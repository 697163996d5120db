// The own car's body hides what lies behind it and takes no light from the road; a red reflector is seen red, as bright as its R_A says.
#include "renderer/renderer.h"
#include "renderer/twin.h"
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/lamps/lamp_model.h"
#include "scenarios/light/light.h"
#include "scenarios/models/road_user_bodies.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

Scene level_road() {
    Scene scene;
    scene.materials.push_back({.name = "road", .kind = SurfaceKind::road});
    Mesh road;
    road.name = "road";
    for (const auto& [x, y] : {std::pair(-20.0F, -40.0F), std::pair(160.0F, -40.0F), std::pair(160.0F, 40.0F), std::pair(-20.0F, 40.0F)})
        road.vertices.push_back({{x, y, 0.0F}, {0.0F, 0.0F, 1.0F}});
    road.indices = {0, 1, 2, 0, 2, 3};
    road.batches.push_back({0, 0, 6});
    scene.meshes.push_back(std::move(road));
    return scene;
}

Moment two_low_beams() {
    static const auto file = std::make_shared<const LampFile>(lamp_of_model(lamp_models().at(0)));
    Moment moment;
    for (const double side : {0.558, -0.558}) {
        LitLamp lamp;
        lamp.file = file;
        lamp.pose = {{3.604, side, 0.587}, glm::dmat3(1.0)};
        lamp.colour = colour_of_temperature(3200.0);
        moment.lamps.push_back(std::move(lamp));
    }
    moment.daylight.horizontal_illuminance_lx = 0.2;
    return moment;
}

View over_the_bonnet() {
    View view;
    view.name = "driver";
    view.position_m = {1.3, 0.35, 1.2};
    view.pitch_rad = radians(-6.0);
    view.width_px = 160;
    view.height_px = 120;
    return view;
}

TEST(OwnCar, HidesWhatIsBehindItAndTakesNoLight) {
    constexpr Wanted wanted{.illuminance = true, .luminance = true, .ids = true};
    Drive drive;
    drive.views = {over_the_bonnet()};
    drive.own_car.emplace().model = std::make_shared<const Model>(car_body({}));
    const Scene without = level_road();
    Scene with = without;
    add_own_car(with, drive);
    ASSERT_EQ(with.meshes.size(), 2U);
    Moment moment = two_low_beams();
    moment.bodies.push_back({"own car", moment.ego, true, 0.0, true});
    Device device = open_device("auto");
    Renderer plain(device, without, {}), body(device, with, {});
    const Frame a = plain.draw(two_low_beams(), over_the_bonnet(), wanted), b = body.draw(moment, over_the_bonnet(), wanted);
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
    EXPECT_EQ(body.draw(moment, over_the_bonnet(), wanted).illuminance_lx, a.illuminance_lx) << "and is gone where the moment has none";
}

/// A wall that returns 100 cd/(lx m2) at the observation angle of the picture: red against white.
TEST(RetroTint, RedIsRedAndAsBrightAsItsFigure) {
    const auto drawn = [](const glm::vec3& rgb, double kelvin, const char* technique) {
        Scene scene = level_road();
        scene.materials.push_back({.name = "sheet", .albedo = glm::vec3(0.0F), .retro_rl = 100.0F, .retro_rgb = rgb});
        Mesh sheet;
        sheet.name = "sheet";
        for (const auto& [y, z] : {std::pair(-3.0F, 0.2F), std::pair(-3.0F, 2.0F), std::pair(3.0F, 2.0F), std::pair(3.0F, 0.2F)})
            sheet.vertices.push_back({{30.0F, y, z}, {-1.0F, 0.0F, 0.0F}});
        sheet.indices = {0, 1, 2, 0, 2, 3};
        sheet.batches.push_back({1, 0, 6});
        scene.meshes.push_back(std::move(sheet));
        Moment moment = two_low_beams();
        moment.daylight.horizontal_illuminance_lx = 0.0;
        for (LitLamp& lamp : moment.lamps)
            lamp.colour = colour_of_temperature(kelvin);
        View view = over_the_bonnet();
        view.pitch_rad = radians(-1.5);
        view.vertical_fov_rad = radians(6.0);
        RendererSettings settings;
        settings.technique = technique;
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
