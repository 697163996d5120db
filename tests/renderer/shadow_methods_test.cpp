// Shadow methods that draw depth maps: where edges lie, that nothing shades itself, and that the bytes do not depend on what is left out.
#include "tests/renderer/shadow_methods.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using namespace tests;

constexpr Wanted all_results{.colour = true, .illuminance = true, .target = true, .luminance = true, .depth = true, .ids = true};
constexpr double lamp_x = 2.2, lamp_z = 0.65;

ShadowSettings method(ShadowMethod which) {
    ShadowSettings settings;
    settings.method = which;
    return settings;
}

Moment with_lamps(const std::vector<double>& sides) {
    Moment moment;
    const auto file = even_beam();
    for (std::size_t i = 0; i < sides.size(); ++i)
        moment.lamps.push_back(lamp_at(i == 0 ? "left" : "right", {lamp_x, sides[i], lamp_z}, file));
    return moment;
}

/// Where the edge of the shadow of something at (x, y) lies at `at_x`, of light from a place at `side`.
double shadow_y(double side, double x, double y, double at_x, double from_x = lamp_x) {
    return side + (y - side) * (at_x - from_x) / (x - from_x);
}

class ShadowMethodTest : public testing::Test {
  protected:
    Frame draw(const Scene& scene, const Moment& moment, const View& view, const ShadowSettings& shadows,
               const char* technique = "photometric", const Wanted& wanted = {.illuminance = true}) {
        RendererSettings settings;
        settings.technique = technique;
        settings.shadows = shadows;
        settings.tone_mapper.l_max_cdm2 = 20.0;
        Renderer renderer(device_, scene, settings);
        return renderer.draw(moment, view, wanted);
    }

    /// On the road in the row of the picture nearest to x: y where the lamp's share is one half, nearest to `about`.
    static double edge(const Frame& drawn, const Frame& free, const Moment& moment, const View& view, double x, double about) {
        const Camera camera = camera_of(moment, view);
        const auto on_road = [&](double px, double py) {
            const Ray ray = pixel_ray(camera, view, px, py);
            return ray.origin_m - ray.direction * (ray.origin_m.z / ray.direction.z);
        };
        int row = 0;
        double nearest = 1e9;
        for (int py = 0; py < view.height_px; ++py) {
            const glm::dvec3 p = on_road(0.5 * view.width_px, py + 0.5);
            if (p.x > 0.0 && std::abs(p.x - x) < nearest) {
                nearest = std::abs(p.x - x);
                row = py;
            }
        }
        double best = 1e9;
        const auto share = [&](int px) {
            const double f = static_cast<double>(free.illuminance_lx.at(px, row));
            return f > 0.0 ? static_cast<double>(drawn.illuminance_lx.at(px, row)) / f : 1.0;
        };
        for (int px = 0; px + 1 < view.width_px; ++px) {
            const double a = share(px) - 0.5, b = share(px + 1) - 0.5;
            if ((a < 0.0) == (b < 0.0))
                continue;
            const double y = on_road(px + 0.5 + a / (a - b), row + 0.5).y;
            if (std::abs(y - about) < std::abs(best - about))
                best = y;
        }
        return best;
    }
    Device device_ = open_device("auto");
};

class MapMethods : public ShadowMethodTest, public testing::WithParamInterface<ShadowMethod> {};

TEST_P(MapMethods, PrunedAndUnprunedGiveTheSameBytesTwice) {
    const Scene scene = road_with({{12.0, 0.4}, {25.0, -2.0, 0.1, 3.0}, {60.0, 1.0, 0.5}}, 120.0);
    Moment moment = with_lamps({0.6, -0.6});
    for (const bool one_is_off : {false, true}) {
        moment.lamps.back().intensity_factor = one_is_off ? 0.0 : 1.0;
        for (const double ahead : {1.5, -8.0}) {
            View view = driver_view(160, 120);
            view.position_m.x = ahead;
            const Frame a = draw(scene, moment, view, method(GetParam()), "photometric", all_results);
            for (const char* technique : {"photometric", "photometric-unpruned"}) {
                const Frame b = draw(scene, moment, view, method(GetParam()), technique, all_results);
                EXPECT_EQ(a.colour, b.colour) << technique;
                EXPECT_EQ(a.illuminance_lx, b.illuminance_lx) << technique;
                EXPECT_EQ(a.target_lx, b.target_lx) << technique;
                EXPECT_EQ(a.luminance_cdm2, b.luminance_cdm2) << technique;
            }
        }
    }
}

/// One lamp, so that each method has the same truth: rays.
TEST_P(MapMethods, NothingShadesItselfAndNothingLeaks) {
    const Scene scene = road_with({{8.0, 0.9}, {25.0, -1.0}, {60.0, 2.0, 0.8}}, 110.0);
    const Moment moment = with_lamps({0.6});
    for (const bool from_beside : {false, true}) {
        View view = driver_view(200, 150);
        if (from_beside) {
            view.position_m = {15.0, 14.0, 4.0};
            view.yaw_rad = radians(-70.0);
            view.pitch_rad = radians(-12.0);
            view.vertical_fov_rad = radians(50.0);
        }
        const Frame drawn = draw(scene, moment, view, method(GetParam()));
        const Twin lit(scene, false), shaded(scene, true);
        int dark = 0, total = 0, wrong = 0;
        for (int y = 1; y + 1 < view.height_px; ++y)
            for (int x = 1; x + 1 < view.width_px; ++x) {
                const TwinPixel pixel = lit.pixel(moment, view, x + 0.5, y + 0.5);
                const double free = pixel.illuminance_lx;
                if (pixel.id == 0 || free < 0.01)
                    continue;
                const auto is_dark = [&](const glm::dvec3& offset) {
                    const glm::dvec3 from = pixel.point_m + offset, way = moment.lamps[0].pose.position_m - from;
                    const auto hit = lit.cast(moment, {from, glm::normalize(way)}, 1e-4, Twin::Met::casters);
                    return hit && hit->distance_m < glm::length(way);
                };
                // Beyond doubt: two texels to each side, and up to twice the height that a look-up is raised by.
                const glm::dvec3 way = moment.lamps[0].pose.position_m - pixel.point_m;
                const double texel = glm::length(way) * 2.0 * std::tan(radians(30.0)) / 1022.0, raise = std::max(0.03, 1.5 * texel);
                const glm::dvec3 across = glm::normalize(glm::cross(way, glm::dvec3(0.0, 0.0, 1.0)));
                const glm::dvec3 up = glm::normalize(glm::cross(across, way));
                const bool truth = is_dark(1e-3 * pixel.normal);
                bool sure = true;
                for (const glm::dvec3& offset : {raise * pixel.normal, 2.0 * raise * pixel.normal,
                                                 raise * pixel.normal + 2.0 * texel * across, raise * pixel.normal - 2.0 * texel * across,
                                                 raise * pixel.normal + 2.0 * texel * up, raise * pixel.normal - 2.0 * texel * up})
                    sure = sure && is_dark(offset) == truth;
                if (!sure)
                    continue;
                ++total;
                dark += truth ? 1 : 0;
                wrong += (static_cast<double>(drawn.illuminance_lx.at(x, y)) < 0.5 * free) != truth ? 1 : 0;
            }
        EXPECT_GT(dark, 200) << from_beside;
        EXPECT_GT(total, 2500) << from_beside;
        EXPECT_EQ(wrong, 0) << from_beside << ": " << dark << " dark of " << total;
    }
}

TEST_P(MapMethods, EdgesLieWhereRaysSayWithinATexel) {
    const Moment moment = with_lamps({0.6});
    const View view = driver_view(1600, 1200);
    for (const auto& [x, at] : {std::pair(5.0, 10.0), std::pair(20.0, 30.0), std::pair(60.0, 80.0)}) {
        const Post post{x, -0.1, 0.3}; // its other side's shadow lies behind it
        const Scene scene = road_with({post});
        const Frame free = draw(scene, moment, view, method(ShadowMethod::none));
        const Frame drawn = draw(scene, moment, view, method(GetParam()));
        const double texel_m = (at - lamp_x) * 2.0 * std::tan(radians(30.0)) / 1022.0;
        const double truth = shadow_y(0.6, x, post.y - post.width, at), found = edge(drawn, free, moment, view, at, truth);
        RecordProperty(fmt::format("error_cm_at_{}_m", at), fmt::format("{:.2f}", 100.0 * (found - truth)));
        fmt::print("{} at {} m: {:.2f} cm, texel {:.2f} cm\n", name(GetParam()), at, 100.0 * (found - truth), 100.0 * texel_m);
        EXPECT_NEAR(found, truth, texel_m + 0.01) << x << " m, " << at << " m";
    }
}

std::string method_test_name(const testing::TestParamInfo<ShadowMethod>& one) {
    std::string text(name(one.param));
    std::erase(text, '-');
    return text;
}
INSTANTIATE_TEST_SUITE_P(All, MapMethods,
                         testing::Values(ShadowMethod::map, ShadowMethod::one_map, ShadowMethod::perspective_map,
                                         ShadowMethod::light_space_map, ShadowMethod::soft_map),
                         method_test_name);

/// Both lamps' shadows fall as from midway: the edge lies (z / z_c - 1) times the lamp's distance from midway beside its own.
TEST_F(ShadowMethodTest, OneMapForAllErrsByTheParallaxFromMidway) {
    View above;
    above.projection = Projection::map;
    above.map_ahead_m = 24.0;
    above.map_behind_m = -16.0;
    above.map_left_m = above.map_right_m = 3.0;
    above.width_px = 1200;
    above.height_px = 160;
    const Post post{12.0, 0.2, 0.4};
    const Scene scene = road_with({post});
    Moment moment = with_lamps({0.6, -0.6});
    const double at = 20.0, between = shadow_y(0.0, post.x, post.y, at), left = shadow_y(0.6, post.x, post.y, at);
    EXPECT_NEAR(between - left, 0.6 * ((at - lamp_x) / (post.x - lamp_x) - 1.0), 1e-9);
    EXPECT_GT(between - left, 0.4);
    const auto found = [&](ShadowMethod which, double about) {
        return edge(draw(scene, moment, above, method(which)), draw(scene, moment, above, method(ShadowMethod::none)), moment, above, at,
                    about);
    };
    EXPECT_NEAR(found(ShadowMethod::one_map, between), between, 0.03);
    moment.lamps.back().intensity_factor = 0.0;
    EXPECT_NEAR(found(ShadowMethod::one_map, left), left, 0.03) << "with one lamp on, midway is that lamp";
    EXPECT_NEAR(found(ShadowMethod::map, left), left, 0.03);
}

} // namespace
} // namespace fernlicht
