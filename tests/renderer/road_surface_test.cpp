// Glossy pavements and wet beads, rendered: every way to light a road gives what the equations say. Dry and wet, in lamps, sky and sun.
#include "tests/renderer/reference/rooms.h"

#include "renderer/reference/sampling.h"
#include "renderer/reference/scattering.h"
#include "renderer/twin.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "tests/renderer/device_test.h"

#include <algorithm>

namespace fernlicht {
namespace {

ReferenceSettings by(Integrator integrator, double target_error = 0.005) {
    return {.integrator = integrator, .footprint = Footprint::centre, .target_error = target_error, .max_samples = 1 << 14};
}

std::shared_ptr<const LampFile> beam() {
    return tests::file_of(tests::table_of(tests::steps(-40.0, 40.0, 0.5), tests::steps(-20.0, 20.0, 0.25),
                                          [](double h, double v) { return 500.0 + 12000.0 * std::exp(-h * h / 300.0 - v * v / 20.0); }));
}

LitLamp lamp_towards(const glm::dvec3& at_m, double yaw_rad) {
    return {"lamp", beam(), {at_m, axes_from_angles(yaw_rad, -0.02, 0.0)}, 1.0, {}, 0.0};
}

/// Own lamps light the road away from the eye, and one comes towards it: its light reaches the eye over the road's facets.
Moment night(double wetness, double sky_lx, bool sun = false) {
    Moment moment;
    moment.weather.wetness = wetness;
    moment.daylight.horizontal_illuminance_lx = sky_lx;
    if (sun)
        moment.daylight.sun = {radians(85.0), radians(8.0), 30.0};
    moment.lamps = {lamp_towards({3.4, 0.6, 0.65}, 0.0), lamp_towards({60.0, 3.0, 0.7}, pi)};
    moment.lamps[1].colour.linear_srgb = {1.3, 0.93, 0.8};
    return moment;
}

/// Worn asphalt with a marking of type II beside it.
Scene paved() {
    Scene scene = level_ground(300.0, pavement_material(Pavement::asphalt_worn));
    scene.materials.push_back(road_materials({.markings = {MarkingType::type_2, 4, 3, 3}})[index_of(RoadMaterial::marking_white)]);
    scene.meshes.push_back(quads("paint", 1, {20.0, 0.0, 0.002}, {{{0, 1, 0}, {0, -1, 0}, {40, -1, 0}, {40, 1, 0}}}));
    return scene;
}

View ahead() { return camera({1.3, 0.35, 1.2}, 0, -2, 12, 40, 30); }

class RoadSurfaceDrawn : public DeviceTest {
  protected:
    Frame draw(const Moment& moment, const char* technique = "photometric", LightPass light_pass = LightPass::shader,
               Work* work = nullptr) {
        Renderer renderer(device_, scene_, RendererSettings{.technique = technique, .light_pass = light_pass});
        if (work != nullptr)
            *work = renderer.count(moment, ahead(), all_results);
        return renderer.draw(moment, ahead(), all_results);
    }
    void expect_twin(const Frame& frame, const Moment& moment, const std::string& what, double share = 1e-3) {
        const Twin twin(scene_, false);
        int seen = 0;
        double worst_lx = 0.0;
        for (const auto& [x, y] : each_pixel(ahead())) {
            const TwinPixel truth = twin.pixel(moment, ahead(), x + 0.5, y + 0.5);
            if (truth.id == 0 || truth.id != frame.ids.at(x, y))
                continue;
            ++seen;
            worst_lx = std::max(worst_lx, std::abs(static_cast<double>(frame.illuminance_lx.at(x, y)) / truth.illuminance_lx - 1.0));
            EXPECT_NEAR(static_cast<double>(frame.luminance_cdm2.at(x, y)), truth.luminance_cdm2, share * truth.luminance_cdm2 + 1e-9)
                << what << ' ' << x << ' ' << y;
        }
        EXPECT_GT(seen, 400) << what;
        EXPECT_LT(worst_lx, share) << what << ": no more than the light itself is off";
    }
    Scene scene_ = paved();
};

TEST_F(RoadSurfaceDrawn, IsTheTwinsByShaderCpuAndPlainShader) {
    for (const double sky_lx : {0.0, 3.0}) {
        const Moment dry = night(0.0, sky_lx);
        expect_twin(draw(dry), dry, "shader");
        expect_twin(draw(dry, "photometric-naive"), dry, "plain shader");
        expect_twin(draw(dry, "photometric", LightPass::cpu), dry, "CPU");
    }
}

TEST_F(RoadSurfaceDrawn, IsTheTwinsWetAndInTheSun) {
    for (const double wetness : {0.0, 0.4, 1.0}) {
        const Moment moment = night(wetness, 2.0, true);
        expect_twin(draw(moment), moment, std::to_string(wetness));
        if (wetness > 0.0)
            continue;
        // Beams of other vehicles are rendered from coarser tables (docs/traffic.md); a film's narrow lobe shows more of that.
        Moment others = moment;
        others.other_lamps = {moment.lamps[1]};
        others.lamps.pop_back();
        expect_twin(draw(others), others, "others'", 0.05);
    }
}

TEST_F(RoadSurfaceDrawn, PrunedAndUnprunedGiveTheSameBytesAndWithoutGlossNothingIsCompiled) {
    for (const double wetness : {0.0, 0.5, 1.0})
        for (const bool sun : {false, true}) {
            const Moment moment = night(wetness, sun ? 1.0 : 0.0, sun);
            expect_same_frames(draw(moment), draw(moment, "photometric-unpruned"), std::to_string(wetness));
        }
    Work glossy, plain;
    draw(night(0.0, 0.0), "photometric", LightPass::shader, &glossy);
    scene_.materials[0].gloss = 0.0F;
    draw(night(0.0, 0.0), "photometric", LightPass::shader, &plain);
    EXPECT_GT(glossy.features, plain.features);
}

TEST_F(RoadSurfaceDrawn, AnOncomingEyeSeesTheBandThatADiffuseRoadLacks) {
    const Moment moment = night(0.0, 0.0);
    const auto brightest = [](const Frame& frame) { return *std::ranges::max_element(frame.luminance_cdm2.pixels()); };
    const float glossy = brightest(draw(moment));
    scene_.materials[0] = pavement_material(Pavement::standard);
    scene_.meshes.pop_back();
    EXPECT_GT(glossy, 5.0F * brightest(draw(moment)));
}

/// R_L where EN 1436 measures it, in a picture of 33 x 33 pixels: lamp 0.65 m and eye 1.2 m up, 30 m before the point.
TEST_F(RoadSurfaceDrawn, RlOfEachSurfaceIsMeasuredInTheImage) {
    View view = camera({0, 0, 1.2}, 0, -degrees(std::atan(1.2 / 30.0)), 2, 33, 33);
    Moment moment;
    moment.lamps = {lamp_towards({0, 0, 0.65}, 0.0)};
    const auto rl_mcd = [&](const Material& material, double wetness) {
        moment.weather.wetness = wetness;
        const Frame frame = Renderer(device_, level_ground(300.0, material), {}).draw(moment, view, all_results);
        const double cosine = 0.65 / std::hypot(30.0, 0.65);
        return 1000.0 * static_cast<double>(frame.luminance_cdm2.at(16, 16)) * cosine /
               static_cast<double>(frame.illuminance_lx.at(16, 16));
    };
    // Paint and asphalt fall off alike with the observation angle; the picture's is EN 1436's within 0.01 degrees.
    for (const auto& [pavement, mcd] : {std::pair(Pavement::standard, 15.0), std::pair(Pavement::asphalt_worn, 15.0),
                                        std::pair(Pavement::asphalt_new, 10.0), std::pair(Pavement::concrete, 20.0)})
        EXPECT_NEAR(rl_mcd(pavement_material(pavement), 0.0), mcd, 0.01 * mcd);
    const auto marking = [](MarkingType type) {
        return road_materials({.markings = {type, 4, 3, 3}})[index_of(RoadMaterial::marking_white)];
    };
    EXPECT_NEAR(rl_mcd(marking(MarkingType::type_1), 0.0), 200.0, 2.0);
    EXPECT_NEAR(rl_mcd(marking(MarkingType::type_2), 0.0), 200.0, 2.0);
    EXPECT_NEAR(rl_mcd(marking(MarkingType::type_2), 1.0), 50.0, 0.5);
    EXPECT_LT(rl_mcd(marking(MarkingType::type_1), 1.0), 3.0);
}

TEST(RoadSurfaceReference, DirectLightIsTheTwins) {
    const Scene scene = paved();
    const View view = camera({1.3, 0.35, 1.2}, 0, -2, 12, 10, 8);
    for (const double wetness : {0.0, 0.4, 1.0}) {
        const Moment moment = night(wetness, 2.0, true);
        ReferenceSettings settings = by(Integrator::direct);
        settings.shadows = false;
        const ReferenceImage image = Reference(scene).render(moment, view, everything, settings);
        const Twin twin(scene, false);
        for (const auto& [x, y] : each_pixel(view)) {
            const TwinPixel truth = twin.pixel(moment, view, x + 0.5, y + 0.5);
            if (truth.id != 0) {
                EXPECT_NEAR(static_cast<double>(image.luminance_cdm2.mean.at(x, y)), truth.luminance_cdm2, 1e-5 * truth.luminance_cdm2)
                    << wetness << ' ' << x << ' ' << y;
            }
        }
    }
}

TEST(RoadSurfaceReference, FacetsAreSampledAsTheyMirror) {
    const glm::dvec3 n(0, 0, 1);
    for (const double elevation_deg : {60.0, 20.0, 5.0}) {
        const glm::dvec3 out(std::cos(radians(elevation_deg)), 0.0, std::sin(radians(elevation_deg)));
        double mean = 0.0, integral = 0.0;
        const int count = 1 << 16, rings = 800;
        const reference::PointNet net(7);
        for (int i = 0; i < count; ++i)
            mean +=
                reference::sample_facets(n, out, net.point(static_cast<std::uint32_t>(i), 0), 0.44, photometry::facet_index).weight / count;
        for (int k = 0; k < rings; ++k)
            for (int j = 0; j < rings; ++j) {
                const double z = (k + 0.5) / rings, turn = 2.0 * pi * (j + 0.5) / rings, across = std::sqrt(1.0 - z * z);
                integral += photometry::facet_mirrored(n, {across * std::cos(turn), across * std::sin(turn), z}, out, 0.44,
                                                       photometry::facet_index) *
                            2.0 * pi / (static_cast<double>(rings) * rings);
            }
        EXPECT_NEAR(mean, integral, 0.003 * integral) << elevation_deg;
    }
}

/// Light of a wall by way of the road, by paths: diffuse and mirrored, against the sum over the wall.
TEST(RoadSurfaceReference, PathsSeeAShiningWallInADryGlossyRoad) {
    Scene scene = level_ground(40.0, pavement_material(Pavement::asphalt_new));
    scene.materials[0].retro_rl = 0.0F;
    scene.materials.push_back(lambert(0.0, SurfaceKind::object, 100.0));
    scene.meshes.push_back(quads("panel", 1, {}, {{{14, 2, 0.5}, {14, -2, 0.5}, {14, -2, 3.5}, {14, 2, 3.5}}})); // faces -x
    const glm::dvec3 eye(0, 0.3, 1.2), at(7, 0.1, 0), n(0, 0, 1), to_eye = glm::normalize(eye - at);
    double truth = 0.0;
    const int steps = 400;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const glm::dvec3 from(14.0, -2.0 + 4.0 * (i + 0.5) / steps, 0.5 + 3.0 * (j + 0.5) / steps), way = from - at;
            const double d = glm::length(way), e = 100.0 * (12.0 / (steps * steps)) * (way.x / d) / (d * d);
            truth += static_cast<double>(scene.materials[0].albedo.g) * e * way.z / d / pi +
                     gloss_light(facets_of(scene.materials[0]), n, way / d, to_eye, e);
        }
    const glm::dvec3 towards = at - eye;
    const View view =
        camera(eye, degrees(std::atan2(towards.y, towards.x)), degrees(std::atan2(towards.z, std::hypot(towards.x, towards.y))), 1, 1);
    const ReferenceImage image = Reference(scene).render({}, view, everything, by(Integrator::path, 0.003));
    EXPECT_LT(image.luminance_cdm2.standard_error.at(0, 0), 0.01 * truth);
    expect_estimate(image.luminance_cdm2, truth, 1e-5);
}

TEST(RoadSurfaceReference, AGlossyRoomMakesNoEnergy) {
    // Walls that shine with 1 cd/m2 and reflect at most all: facets over a black ground leave the room between its own light and L / (1 -
    // 1).
    Material black = lambert(0.0, SurfaceKind::road, 1.0), glossy = black;
    glossy.gloss = 1.0F;
    const auto inside = [](const Material& wall) {
        return Reference(closed_room(wall))
            .render({}, camera({0, 0, 0}, 30, 10, 40, 1), everything, by(Integrator::path))
            .luminance_cdm2.mean.at(0, 0);
    };
    EXPECT_GT(inside(glossy), 1.0F);
    EXPECT_LT(inside(glossy), 1.2F) << "some 5 % at steep angles, more at grazing ones";
}

} // namespace
} // namespace fernlicht
