// Shadows flattened onto the road's plane: as rays have them on the ground, none on upright things, and no drive on ground that is no
// plane.
#include "renderer/gl/shadows/ground_shadows.h"
#include "scenarios/values/errors.h"
#include "tests/renderer/shadow_scene.h"
#include "tests/trial.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

constexpr ShadowSettings planar{.method = ShadowMethod::planar};

/// A box lower than the lamp, a post that is higher, and a board in the air.
Scene three_casters() {
    Scene scene = level_road_for_shadows();
    Mesh things = box({12.0, 0.0, 0.0}, {0, -0.8F, 0}, {0.5F, 0.2F, 0.4F});
    add_box(things, 1, {-2.0F, 1.5F, 0}, {-1.9F, 1.6F, 3.0F});
    add_flat(things, 1, {3, -3, 0.2F}, {3, -3, 0.4F}, {3, -2, 0.4F}, {3, -2, 0.2F});
    scene.meshes.push_back(things);
    return scene;
}

/// Everything turned about the y axis: the road climbs.
void tilt(Scene& scene, double slope_rad) {
    const glm::dmat3 turn = axes_from_angles(0.0, slope_rad, 0.0);
    for (Mesh& mesh : scene.meshes) {
        for (Vertex& v : mesh.vertices) {
            v.position_m = glm::vec3(turn * (glm::dvec3(v.position_m) + mesh.origin_m));
            v.normal = glm::vec3(turn * glm::dvec3(v.normal));
        }
        mesh.origin_m = glm::dvec3(0.0);
    }
}

class PlanarShadows : public DeviceTest {};

TEST(PlaneFit, FindsAPlaneAndAnswersForLinesAndNothing) {
    gl::PlaneFit fit;
    EXPECT_FALSE(fit.plane());
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(10.0, 0.0), std::pair(0.0, 5.0), std::pair(7.0, 3.0)})
        fit.add({x, y, 2.0 + 0.1 * x - 0.2 * y});
    const glm::dvec4 plane = fit.plane().value();
    const double length = std::sqrt(1.0 + 0.01 + 0.04);
    EXPECT_NEAR(plane.x, -0.1 / length, 1e-12);
    EXPECT_NEAR(plane.y, 0.2 / length, 1e-12);
    EXPECT_NEAR(plane.w, -2.0 / length, 1e-12);
    gl::PlaneFit line;
    line.add({0.0, 0.0, 1.0});
    line.add({1.0, 1.0, 1.0});
    EXPECT_EQ(line.plane().value(), glm::dvec4(0.0, 0.0, 1.0, -1.0));
}

TEST_F(PlanarShadows, OnTheGroundAreAsRaysHaveThem) {
    for (const double slope_rad : {0.0, 0.05}) {
        Scene scene = three_casters();
        tilt(scene, slope_rad);
        Moment moment;
        moment.ego.axes = axes_from_angles(0.0, slope_rad, 0.0);
        moment.lamps = {lamp_at(moment.ego.axes * glm::dvec3(3.5, 0.6, 0.65), 0.0, slope_rad)};
        for (const View& view : {driver_for_shadows(), map_for_shadows(60.0, 12.0, 5)}) {
            HiddenPixels pixels = hidden_pixels(device_, scene, moment, view, planar);
            const Twin twin(scene, false);
            for (const auto& [x, y] : each_pixel(view))
                if (twin.pixel(moment, view, x + 0.5, y + 0.5).id != 1) // upright
                    pixels.rays[static_cast<std::size_t>(y * view.width_px + x)] = -1;
            EXPECT_EQ(pixels.wrong_inside(), 0) << view.name << slope_rad;
            EXPECT_GT(pixels.count(1), 500) << view.name;
            EXPECT_GT(pixels.count(0), 10000) << view.name;
            EXPECT_LE(pixels.differ(), pixels.count(1) / 20) << view.name;
        }
    }
}

TEST_F(PlanarShadows, FallOnNothingUpright) {
    Scene scene = three_casters();
    scene.meshes.push_back(box({20.0, 0.0, 0.0}, {0, -6, 0}, {0.3F, 6, 3}));
    Moment moment{.lamps = {lamp_at({3.5, 0.6, 0.65})}};
    const Frame with = drawn_with(device_, scene, moment, driver_for_shadows(), ShadowMethod::planar),
                without = drawn_with(device_, scene, moment, driver_for_shadows(), ShadowMethod::none);
    int upright = 0;
    for (std::size_t i = 0; i < with.ids.size(); ++i)
        if (with.ids.pixels()[i] > 1) {
            ++upright;
            EXPECT_EQ(with.illuminance_lx.pixels()[i], without.illuminance_lx.pixels()[i]);
        }
    EXPECT_GT(upright, 1000);
}

TEST_F(PlanarShadows, TargetsAboveTheRoadAreHiddenAsByVolumes) {
    const Scene scene = three_casters();
    Moment moment{.lamps = {lamp_at({3.5, 0.6, 0.65})}};
    const View map = map_for_shadows(60.0, 12.0, 5);
    const Frame plane = drawn_with(device_, scene, moment, map, ShadowMethod::planar),
                volumes = drawn_with(device_, scene, moment, map, ShadowMethod::volumes);
    int differ = 0, dark = 0;
    for (std::size_t i = 0; i < plane.target_lx.size(); ++i) {
        differ += plane.target_lx.pixels()[i] != volumes.target_lx.pixels()[i] ? 1 : 0;
        dark += volumes.target_lx.pixels()[i] == 0.0F ? 1 : 0;
    }
    EXPECT_GT(dark, 200);
    EXPECT_LE(differ, dark / 100);
}

TEST_F(PlanarShadows, RefuseGroundThatIsNotOnePlane) {
    Scene scene = three_casters();
    Mesh bank{"bank", {30.0, 0.0, 0.0}, {}, {}, {}};
    add_flat(bank, 0, {0, -10, 0.0F}, {20, -10, 0.5F}, {20, 10, 0.5F}, {0, 10, 0.0F});
    scene.meshes.push_back(bank);
    Moment moment{.lamps = {lamp_at({3.5, 0.6, 0.65})}};
    RendererSettings settings{.shadows = planar};
    Renderer renderer(device_, scene, settings);
    const auto message = [](auto act) { return tests::refusal_of(act, ""); };
    using testing::AllOf;
    using testing::HasSubstr;
    const auto refused =
        AllOf(HasSubstr("shadows"), HasSubstr("within 3.0 cm of one plane"), HasSubstr("at x 50.0 m"), HasSubstr(" cm above it"));
    EXPECT_THAT(message([&] { renderer.prepare({moment}, driver_for_shadows(), all_results); }), refused) << "before the first frame";
    EXPECT_THAT(message([&] { renderer.draw(moment, driver_for_shadows(), all_results); }), refused);
    settings.shadows.tolerance_m = 0.6;
    Renderer generous(device_, scene, settings);
    EXPECT_EQ(message([&] { generous.draw(moment, driver_for_shadows(), all_results); }), "");
    moment.lamps[0].pose.axes = axes_from_angles(pi, 0.0, 0.0); // away from the bank
    EXPECT_EQ(message([&] { renderer.draw(moment, driver_for_shadows(), all_results); }), "");
}

} // namespace
} // namespace fernlicht
