// A dark polygon under a car is its outline from above on the ground: no more, no less, whatever lamps shine.
#include "renderer/gl/shadows/ground_shadows.h"

#include "tests/renderer/shadow_scene.h"

namespace fernlicht {
namespace {

constexpr glm::dvec2 car_low{-1.0, -0.9}, car_high{3.0, 0.9};

/// A car 4 m long that stands askew 12 m ahead.
struct StreetAtNight {
    Scene scene = level_road_for_shadows();
    Moment moment;
    StreetAtNight() {
        Mesh car = box({0.0, 0.0, 0.0}, {car_low, 0.2F}, {car_high, 1.4F});
        car.body = 0;
        scene.meshes.push_back(std::move(car));
        moment.lamps = {lamp_at({3.5, 0.6, 0.65}), lamp_at({3.5, -0.6, 0.65})};
        moment.bodies.push_back({"car", {{12.0, -1.0, 0.0}, axes_from_angles(0.4, 0.0, 0.0)}, true, 0.0, false});
    }
};

class UnderCar : public DeviceTest {};

TEST(ConvexHull, GoesRoundTheOutermostPoints) {
    const std::vector<glm::dvec2> square = gl::convex_hull({{1, 1}, {0, 0}, {0.5, 0.2}, {1, 0}, {0, 1}, {0.5, 0.0}, {1, 1}});
    EXPECT_EQ(square, (std::vector<glm::dvec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(gl::convex_hull({{2, 0}, {0, 0}, {1, 0}}), (std::vector<glm::dvec2>{{0, 0}, {2, 0}})) << "in line";
    EXPECT_EQ(gl::convex_hull({{3, 4}, {3, 4}}).size(), 1U);
}

TEST_F(UnderCar, TheGroundWithinTheOutlineIsDarkAndAllElseIsAsWithoutShadows) {
    const StreetAtNight s;
    const View map = map_for_shadows(30.0, 10.0, 10);
    const Frame with = drawn_with(device_, s.scene, s.moment, map, ShadowMethod::under_car),
                without = drawn_with(device_, s.scene, s.moment, map, ShadowMethod::none);
    const Camera camera = camera_of(s.moment, map);
    int inside = 0;
    for (const auto& [x, y] : each_pixel(map)) {
        const glm::dvec3 ground = pixel_ray(camera, map, x + 0.5, y + 0.5).origin_m;
        const glm::dvec3 in_car = to_local(s.moment.bodies[0].pose, {ground.x, ground.y, 0.0});
        const double beyond =
            std::max(std::max(car_low.x - in_car.x, in_car.x - car_high.x), std::max(car_low.y - in_car.y, in_car.y - car_high.y));
        if (std::abs(beyond) < 1e-3)
            continue; // on the outline
        inside += beyond < 0.0 ? 1 : 0;
        EXPECT_EQ(with.illuminance_lx.at(x, y), beyond < 0.0 ? 0.0F : without.illuminance_lx.at(x, y)) << x << ' ' << y;
        EXPECT_EQ(with.target_lx.at(x, y), beyond < 0.0 ? 0.0F : without.target_lx.at(x, y)) << x << ' ' << y;
    }
    EXPECT_NEAR(inside, 4.0 * 1.8 * 100.0, 10.0);
}

TEST_F(UnderCar, UprightThingsStayAsLitAsWithoutShadows) {
    StreetAtNight s;
    s.scene.meshes.push_back(box({16.0, 0.0, 0.0}, {0, -3, 0}, {0.2F, 3, 2})); // behind the car, in its shadow if it cast one
    const Frame with = drawn_with(device_, s.scene, s.moment, driver_for_shadows(), ShadowMethod::under_car),
                without = drawn_with(device_, s.scene, s.moment, driver_for_shadows(), ShadowMethod::none);
    int upright = 0, darker = 0;
    for (std::size_t i = 0; i < with.ids.size(); ++i) {
        if (with.ids.pixels()[i] > 1) {
            ++upright;
            EXPECT_EQ(with.illuminance_lx.pixels()[i], without.illuminance_lx.pixels()[i]);
        }
        darker += with.illuminance_lx.pixels()[i] < without.illuminance_lx.pixels()[i] ? 1 : 0;
    }
    EXPECT_GT(upright, 1000);
    EXPECT_GT(darker, 50) << "the ground seen between car and road";
}

TEST_F(UnderCar, CostsNothingWhereNoLampShinesOnACar) {
    StreetAtNight s;
    RendererSettings settings{.shadows = {.method = ShadowMethod::under_car}};
    Renderer renderer(device_, s.scene, settings);
    const Work near = renderer.count(s.moment, driver_for_shadows(), all_results);
    s.moment.bodies[0].pose.position_m.x = -30.0; // behind the lamps
    const Work behind = renderer.count(s.moment, driver_for_shadows(), all_results);
    EXPECT_GT(near.passes, 1);
    EXPECT_EQ(behind.passes, 1);
    renderer.draw(s.moment, driver_for_shadows(), all_results);
    const std::vector<PrunedFeature> pruned = renderer.pruned();
    EXPECT_TRUE(std::ranges::any_of(pruned, [](const PrunedFeature& one) { return one.what == "dark polygons under cars"; }));
}

} // namespace
} // namespace fernlicht
