// Fog and a wet road as they are drawn: against integrals in double, the twin and the reference; pruned as unpruned; nothing in clear air.
#include "tests/renderer/reference/rooms.h"

#include "renderer/twin.h"
#include "scenarios/light/fog_light.h"
#include "tests/renderer/device_test.h"

namespace fernlicht {
namespace {

LitLamp beam(const glm::dvec3& at) {
    const auto cd = [](double h, double v) { return 300.0 + 15000.0 / (1.0 + std::exp((v + 0.6) / 0.3)) * std::exp(-h * h / 200.0); };
    const auto file = tests::file_of(tests::table_of(tests::steps(-30.0, 30.0, 0.5), tests::steps(-15.0, 10.0, 0.25), cd));
    return {"beam", file, {at, axes_from_angles(0.0, 0.0, 0.0)}, 1.0, {}, 0.0};
}

Moment in(const Weather& weather, double sky_lx = 0.0) {
    Moment moment{.weather = weather};
    moment.daylight.horizontal_illuminance_lx = sky_lx;
    moment.lamps = {beam({3.4, 0.6, 0.65}), beam({3.4, -0.6, 0.65})};
    moment.lamps[1].colour.linear_srgb = {1.6, 0.85, 0.95};
    return moment;
}

Scene road(double albedo) {
    Scene scene = level_ground(300.0, lambert(albedo));
    scene.materials.push_back(lambert(albedo, SurfaceKind::board));
    scene.meshes.push_back(quads("board", 1, {30.0, 3.0, 0.0}, {{{0, 2, 0}, {0, -2, 0}, {0, -2, 3}, {0, 2, 3}}}));
    return scene;
}

View ahead_in_weather(int width_px = 32, int height_px = 24) { return camera({1.3, 0.35, 1.2}, 0, -1, 30, width_px, height_px); }

class DrawnWeather : public DeviceTest {
  protected:
    Frame draw(const Scene& scene, const Moment& moment, const char* technique = "photometric", int samples = 32, Work* work = nullptr,
               const View& view = ahead_in_weather()) {
        // By the shader in clear air too: what thin air changes is less than the two passes differ by.
        Renderer renderer(device_, scene,
                          RendererSettings{.technique = technique, .light_pass = LightPass::shader, .fog_samples = samples});
        if (work != nullptr)
            *work = renderer.count(moment, view, all_results);
        return renderer.draw(moment, view, all_results);
    }
};

/// Black ground and no sky: what is seen is the air alone. Float against double at the same places, in every pixel, sky and surfaces.
TEST_F(DrawnWeather, AirlightIsThatOfDoublePrecision) {
    const Scene scene = road(0.0);
    const View view = ahead_in_weather();
    for (const Weather& fog : {Weather{0.001, 1.0, 0.85, 0.0}, Weather{0.03, 0.9, 0.5, 0.0}, Weather{0.5, 1.0, 0.9, 0.0}}) {
        const Moment moment = in(fog);
        const Frame frame = draw(scene, moment);
        const Twin twin(scene, false);
        const Camera camera = camera_of(moment, view);
        for (const auto& [x, y] : each_pixel(view)) {
            const TwinPixel seen = twin.pixel(in({}), view, x + 0.5, y + 0.5);
            if (seen.id != frame.ids.at(x, y))
                continue; // an outline
            const Ray ray = pixel_ray(camera, view, x + 0.5, y + 0.5);
            const glm::dvec3 end =
                seen.id != 0 ? seen.point_m : ray.origin_m + ray.direction * (5000.0 / glm::dot(ray.direction, camera.axis));
            double truth = 0.0;
            for (const LitLamp& lamp : moment.lamps)
                truth +=
                    glm::dot(lamp.colour.linear_srgb, glm::dvec3(0.2126, 0.7152, 0.0722)) * airlight_cdm2(lamp, fog, camera.eye_m, end, 32);
            // Midpoints at a table's edge fall to one side or the other: 2 % of one of 32 parts.
            EXPECT_NEAR(static_cast<double>(frame.luminance_cdm2.at(x, y)), truth, 2e-3 * truth + 1e-9)
                << x << ' ' << y << ' ' << fog.extinction_per_m;
        }
    }
}

/// Everything together against the twin, which integrates until nothing moves: what 32 midpoints leave, and 128.
TEST_F(DrawnWeather, MeetsTheTwinWithMoreMidpoints) {
    const Scene scene = road(0.1);
    const View view = ahead_in_weather(16, 12);
    Moment moment = in({0.03, 1.0, 0.85, 0.0}, 2.0);
    moment.lamps.pop_back();
    const Twin twin(scene, true, place_px_);
    double error[3] = {}, sum = 0.0;
    int beyond = 0;
    const Frame frames[] = {draw(scene, moment, "photometric", 16, nullptr, view), draw(scene, moment, "photometric", 32, nullptr, view),
                            draw(scene, moment, "photometric", 128, nullptr, view)};
    for (const auto& [x, y] : each_pixel(view)) {
        const TwinPixel truth = twin.pixel(moment, view, x + 0.5, y + 0.5);
        if (truth.id != frames[0].ids.at(x, y))
            continue;
        sum += truth.luminance_cdm2;
        for (int k = 0; k < 3; ++k)
            error[k] += std::abs(static_cast<double>(frames[k].luminance_cdm2.at(x, y)) - truth.luminance_cdm2);
        const double off = std::abs(static_cast<double>(frames[1].illuminance_lx.at(x, y)) - truth.illuminance_lx);
        beyond += off > truth.bound_lx + 1e-4 * truth.illuminance_lx ? 1 : 0;
    }
    EXPECT_LE(beyond, 2); // of 192: where the shadow's edge runs through the pixel, the map has it between its texels
    EXPECT_LT(error[1], 0.03 * sum);
    EXPECT_LT(error[2], 0.003 * sum);
}

TEST_F(DrawnWeather, WetRoadIsTheTwins) {
    const Scene scene = road(0.1);
    const View view = ahead_in_weather();
    for (const double wetness : {0.4, 1.0})
        for (const bool sun : {false, true}) {
            Moment moment = in({0.0, 1.0, 0.85, wetness}, 3.0);
            if (sun)
                moment.daylight.sun = {radians(80.0), radians(20.0), 40.0};
            const Frame frame = draw(scene, moment);
            const Twin twin(scene, true);
            int beyond = 0;
            for (const auto& [x, y] : each_pixel(view)) {
                const TwinPixel truth = twin.pixel(moment, view, x + 0.5, y + 0.5);
                const double off = std::abs(static_cast<double>(frame.luminance_cdm2.at(x, y)) - truth.luminance_cdm2);
                beyond += truth.id == frame.ids.at(x, y) && off > 1e-3 * truth.luminance_cdm2 ? 1 : 0;
            }
            EXPECT_LE(beyond, 3) << wetness << ": edges of shadows";
        }
}

TEST_F(DrawnWeather, PrunedAndUnprunedGiveTheSameBytesWithItOnAndOff) {
    const Scene scene = road(0.1);
    for (const Weather& weather : {Weather{}, Weather{0.03, 1.0, 0.85, 0.0}, Weather{1e-9, 1.0, 0.85, 0.0}, Weather{10.0, 0.5, 0.0, 0.0},
                                   Weather{0.0, 1.0, 0.85, 1.0}, Weather{0.01, 1.0, 0.85, 0.3}}) {
        Moment moment = in(weather, weather.wetness > 0.5 ? 0.0 : 1.0);
        moment.lamps[1].intensity_factor = weather.extinction_per_m > 0.02 ? 0.0 : 1.0;
        expect_same_frames(draw(scene, moment), draw(scene, moment, "photometric-unpruned"),
                           std::to_string(weather.extinction_per_m) + ' ' + std::to_string(weather.wetness));
    }
}

TEST_F(DrawnWeather, ClearAndDryCostsNothing) {
    const Scene scene = road(0.1);
    Work clear, foggy, wet;
    draw(scene, in({}), "photometric", 32, &clear);
    draw(scene, in({0.03, 1.0, 0.85, 0.0}), "photometric", 32, &foggy);
    draw(scene, in({0.0, 1.0, 0.85, 1.0}), "photometric", 32, &wet);
    EXPECT_LT(clear.features, foggy.features);
    EXPECT_LT(clear.features, wet.features);
    EXPECT_LT(clear.calls, foggy.calls);
    EXPECT_EQ(clear.passes, foggy.passes);
}

/// From no fog to the thickest that a drive may have: nothing that is not a number, and air as thin as 1e-9 changes nothing but its share.
TEST_F(DrawnWeather, HoldsAtTheExtremes) {
    const Scene scene = road(0.1);
    const Frame clear = draw(scene, in({}, 1.0));
    for (const double extinction : {1e-9, 1e-6, 1.0, 10.0})
        for (const double g : {0.0, 0.9}) {
            const Frame frame = draw(scene, in({extinction, 1.0, g, 1.0}, 1.0));
            for (const float l : frame.luminance_cdm2.pixels())
                ASSERT_TRUE(std::isfinite(l) && l >= 0.0F) << extinction;
        }
    const Frame thin = draw(scene, in({1e-9, 1.0, 0.85, 0.0}, 1.0));
    for (const auto& [x, y] : each_pixel(32, 24))
        EXPECT_NEAR(thin.luminance_cdm2.at(x, y), clear.luminance_cdm2.at(x, y), 1e-5F * clear.luminance_cdm2.at(x, y) + 1e-7F);
}

/// Two cars that come towards the eye, one that drives ahead and a street lamp: `beam` has sharp edges and shines to all sides.
std::vector<LitLamp> others() {
    std::vector<LitLamp> lamps;
    for (const auto& [place, yaw_deg, pitch_deg] :
         {std::tuple(glm::dvec3(40.0, 4.0, 0.7), 180.0, 0.0), std::tuple(glm::dvec3(40.0, 2.8, 0.7), 180.0, 0.0),
          std::tuple(glm::dvec3(160.0, 4.0, 0.7), 180.0, 0.0), std::tuple(glm::dvec3(20.0, -1.0, 0.7), 0.0, 0.0),
          std::tuple(glm::dvec3(15.0, -4.0, 6.0), 0.0, -90.0), std::tuple(glm::dvec3(-30.0, 3.0, 0.7), 0.0, 0.0)}) {
        lamps.push_back(beam(place));
        lamps.back().pose.axes = axes_from_angles(radians(yaw_deg), radians(pitch_deg), 0.0);
        lamps.back().body = -2;
        lamps.back().colour.linear_srgb = {1.3, 0.9, 0.7};
    }
    return lamps;
}

/// The air alone, lit by others' lamps: never off by more than what may be left out and what 128 midpoints leave.
TEST_F(DrawnWeather, BeamsOfOthersAreSeenInTheFog) {
    const Scene scene = road(0.0);
    const View view = ahead_in_weather(16, 12);
    for (const Weather& fog : {Weather{0.03, 1.0, 0.85, 0.0}, Weather{0.005, 1.0, 0.5, 0.0}}) {
        Moment moment = in(fog);
        moment.lamps.clear();
        moment.other_lamps = others();
        const double least = min_airlight_cdm2(moment.min_traffic_lx);
        const Frame frame = draw(scene, moment, "photometric", 128, nullptr, view);
        const Twin twin(scene, false);
        double sum = 0.0, off = 0.0;
        int lit = 0;
        for (const auto& [x, y] : each_pixel(view)) {
            const TwinPixel truth = twin.pixel(moment, view, x + 0.5, y + 0.5);
            const double drawn_cdm2 = static_cast<double>(frame.luminance_cdm2.at(x, y));
            lit += drawn_cdm2 > 0.0 ? 1 : 0;
            sum += truth.luminance_cdm2;
            off += std::abs(drawn_cdm2 - truth.luminance_cdm2);
            EXPECT_NEAR(drawn_cdm2, truth.luminance_cdm2,
                        2.0 * least * static_cast<double>(moment.other_lamps.size()) +
                            0.1 * truth.luminance_cdm2) // a beam that ends within a part
                << x << ' ' << y << ' ' << fog.extinction_per_m;
        }
        EXPECT_GT(lit, 100);
        EXPECT_LT(off, 0.02 * sum + 16 * 12 * least);
        EXPECT_GT(sum, 16 * 12 * least);
    }
}

/// All of it, what a bound leaves out and what it cannot: the same bytes as by integrating every lamp in every pixel.
TEST_F(DrawnWeather, BeamsOfOthersPrunedAndUnprunedGiveTheSameBytes) {
    const Scene scene = road(0.1);
    for (const double extinction : {0.0, 1e-6, 0.03})
        for (const double min_lx : {0.05, 50.0}) {
            Moment moment = in({extinction, 1.0, 0.85, 0.0}, 0.2);
            moment.daylight.sun = {radians(80.0), radians(20.0), 1.0}; // so that all of it is compiled in where nothing is pruned
            moment.other_lamps = others();
            moment.min_traffic_lx = min_lx;
            expect_same_frames(draw(scene, moment), draw(scene, moment, "photometric-unpruned"),
                               std::to_string(extinction) + ' ' + std::to_string(min_lx));
        }
}

TEST_F(DrawnWeather, BeamsOfOthersCostNothingWithoutFogOrOutOfReach) {
    const Scene scene = road(0.1);
    const auto counted = [&](double extinction, const glm::dvec3& place_m, double min_lx) {
        Moment moment = in({extinction, 1.0, 0.85, 0.0});
        moment.min_traffic_lx = min_lx;
        moment.other_lamps = {beam(place_m)};
        moment.other_lamps[0].body = -2;
        Work work;
        draw(scene, moment, "photometric", 32, &work);
        return work.features;
    };
    const glm::dvec3 near(40.0, 3.0, 0.7), behind(-150.0, 30.0, 0.7);
    EXPECT_LT(counted(0.0, near, 0.05), counted(0.03, near, 0.05));
    EXPECT_LT(counted(0.03, behind, 0.05), counted(0.03, near, 0.05)); // exp(-4.5) of its light at most would come back
}

TEST(ReferenceWeather, AgreesWithTheTwin) {
    const Scene scene = road(0.1);
    Moment moment = in({0.03, 1.0, 0.85, 0.7}, 2.0);
    moment.daylight.sun = {radians(80.0), radians(20.0), 40.0};
    ReferenceSettings settings{.footprint = Footprint::centre};
    const View view = ahead_in_weather(16, 12);
    const ReferenceImage image = Reference(scene).render(moment, view, everything, settings);
    const Twin twin(scene, true);
    int differ = 0;
    for (const auto& [x, y] : each_pixel(view)) {
        const TwinPixel truth = twin.pixel(moment, view, x + 0.5, y + 0.5);
        differ +=
            std::abs(static_cast<double>(image.luminance_cdm2.mean.at(x, y)) - truth.luminance_cdm2) > 1e-5 * truth.luminance_cdm2 ? 1 : 0;
    }
    EXPECT_LE(differ, 3); // outlines
}

} // namespace
} // namespace fernlicht
