// Fog, water, sun and moon in the integrators: energy, closed forms, agreement with direct light, refusals.
#include "tests/renderer/reference/rooms.h"

#include "renderer/reference/scattering.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <stdexcept>

namespace fernlicht {
namespace {

ReferenceSettings by(Integrator integrator, double target_error = 0.005, Footprint footprint = Footprint::pixel) {
    return {.integrator = integrator, .footprint = footprint, .target_error = target_error, .max_samples = 1 << 14};
}

Moment in_fog(double extinction_per_m, double albedo = 1.0, double asymmetry = 0.85) {
    return {.weather = {extinction_per_m, albedo, asymmetry, 0.0}};
}

TEST(ReferenceFog, WhiteFogChangesNothingInAnEvenRoom) {
    // Where light is the same from all sides, what fog takes it gives back: L = Le / (1 - rho) whatever the fog.
    Material wall = lambert(0.5, SurfaceKind::road, 3.0);
    const Scene scene = closed_room(wall);
    for (const double asymmetry : {0.0, 0.85}) {
        const ReferenceImage image =
            Reference(scene).render(in_fog(0.7, 1.0, asymmetry), camera({0.2, 0.1, -0.3}, 20, 10, 60, 2), everything, by(Integrator::path));
        expect_estimate(image.luminance_cdm2, 6.0, 1e-5, 0, 0);
        expect_estimate(image.luminance_cdm2, 6.0, 1e-5, 1, 1);
        expect_estimate(image.illuminance_lx, 6.0 * pi, 1e-5, 1, 0);
    }
    ReferenceSettings once = by(Integrator::path);
    once.max_scatterings = 1;
    const ReferenceImage lost = Reference(scene).render(in_fog(0.7), camera({0, 0, 0}, 20, 10, 60, 1), everything, once);
    EXPECT_LT(lost.luminance_cdm2.mean.at(0, 0), 5.0F); // of walls' own light nothing is scattered then
}

TEST(ReferenceFog, AllLightOfALampReachesTheWallsOfABlackRoomHoweverOftenItIsScattered) {
    const Scene scene = closed_room(lambert(0.0));
    const double cd = 100.0;
    for (const double extinction : {0.0, 0.4, 1.2}) {
        Moment moment = in_fog(extinction, 1.0, 0.6);
        moment.lamps = {even_lamp(cd, looking({-0.3, 0.1, 0.2}, 15, -10))};
        ReferenceSettings settings = by(Integrator::path, 0.02);
        settings.max_samples = 1024;
        double flux_lm = 0.0, variance = 0.0, once_lm = 0.0;
        for (const auto& [yaw, pitch] : {std::pair(0.0, 0.0), {90.0, 0.0}, {180.0, 0.0}, {-90.0, 0.0}, {0.0, 90.0}, {0.0, -90.0}}) {
            const int px = 4; // 90 degrees before a wall 1 m away: all of it, each pixel the same area
            const View view = camera({0, 0, 0}, yaw, pitch, 90, px);
            const Estimate e = Reference(scene).render(moment, view, lux, settings).illuminance_lx;
            const double area = 4.0 / (px * px);
            for (std::size_t i = 0; i < e.mean.size(); ++i) {
                flux_lm += area * static_cast<double>(e.mean.pixels()[i]);
                variance += std::pow(area * static_cast<double>(e.standard_error.pixels()[i]), 2);
            }
            ReferenceSettings once = settings;
            once.max_scatterings = 1;
            const Estimate single = Reference(scene).render(moment, view, lux, once).illuminance_lx;
            for (const float each : single.mean.pixels())
                once_lm += area * static_cast<double>(each);
        }
        EXPECT_NEAR(flux_lm, 2.0 * pi * cd, 5.0 * std::sqrt(variance)) << extinction;
        EXPECT_LT(std::sqrt(variance), (extinction > 1.0 ? 0.05 : 0.01) * flux_lm); // ways close by the lamp are rare and bright
        if (extinction > 1.0) {
            EXPECT_LT(once_lm, 0.9 * 2.0 * pi * cd); // and would not by single scattering
        }
    }
}

TEST(ReferenceFog, SingleScatteringByPathsIsThatOfDirectLight) {
    const Scene scene = level_ground(200.0, lambert(0.0));
    Moment moment = in_fog(0.03);
    moment.lamps = {even_lamp(800.0, looking({0.0, 0.6, 0.65}, 0, -2)), even_lamp(500.0, looking({60.0, 3.0, 0.7}, 170, -3))};
    moment.lamps[1].colour.linear_srgb = {1.2, 0.95, 0.9};
    moment.daylight.horizontal_illuminance_lx = 2.0;
    const View view = camera({-1.0, 0.2, 1.3}, 3, -2, 24, 4);
    const auto drawn = [&](Integrator integrator, int max_scatterings, double target_error) {
        ReferenceSettings settings = by(integrator, target_error, Footprint::centre);
        settings.max_scatterings = max_scatterings;
        return Reference(scene).render(moment, view, everything, settings);
    };
    const ReferenceImage direct = drawn(Integrator::direct, 1, 0.01), path = drawn(Integrator::path, 1, 0.01),
                         whitted = drawn(Integrator::whitted, 1, 0.01), more = drawn(Integrator::path, 1000, 0.04);
    double single = 0.0, all = 0.0;
    for (const auto& [x, y] : each_pixel(4, 4)) {
        const double error = std::hypot(path.luminance_cdm2.standard_error.at(x, y), direct.luminance_cdm2.standard_error.at(x, y));
        EXPECT_NEAR(path.luminance_cdm2.mean.at(x, y), direct.luminance_cdm2.mean.at(x, y),
                    5.0 * error + 1e-4 * static_cast<double>(direct.luminance_cdm2.mean.at(x, y)))
            << x << " " << y;
        EXPECT_EQ(whitted.luminance_cdm2.mean.at(x, y), direct.luminance_cdm2.mean.at(x, y));
        single += static_cast<double>(path.luminance_cdm2.mean.at(x, y)), all += static_cast<double>(more.luminance_cdm2.mean.at(x, y));
    }
    EXPECT_GT(all, 1.02 * single); // further scatterings add
}

TEST(ReferenceFog, AirHidesAWallAndWhatAMirrorShowsOfIt) {
    Material shining = lambert(0.0, SurfaceKind::road, 50.0), mirror = lambert(0.0);
    mirror.mirror = 0.8F;
    Scene scene{.materials = {shining, mirror}};
    // faces +x, behind the eye
    // faces -x
    scene.meshes = {quads("wall", 0, {}, {{{-12, -30, -30}, {-12, 30, -30}, {-12, 30, 30}, {-12, -30, 30}}}),
                    quads("mirror", 1, {}, {{{8, 30, -30}, {8, -30, -30}, {8, -30, 30}, {8, 30, 30}}})};
    const Moment moment = in_fog(0.05, 0.0); // takes and scatters nothing
    for (const Integrator integrator : {Integrator::whitted, Integrator::path}) {
        ReferenceSettings settings = by(integrator, 0.001, Footprint::centre);
        const ReferenceImage seen = Reference(scene).render(moment, camera({0, 0, 0}, 180, 0, 2, 1), everything, settings),
                             mirrored = Reference(scene).render(moment, camera({0, 0, 0}, 0, 0, 2, 1), everything, settings);
        expect_estimate(seen.luminance_cdm2, 50.0 * std::exp(-0.05 * 12.0), 1e-5);
        expect_estimate(mirrored.luminance_cdm2, static_cast<double>(mirror.mirror) * 50.0 * std::exp(-0.05 * (8.0 + 20.0)), 1e-5);
    }
}

TEST(ReferenceFog, BouncedLightIsTakenOnBothOfItsWays) {
    // Lamp to a board of 1 m x 1 m, board to a black post beside the lamp; nothing scatters: E = rho / pi E_board A cos cos / d^2 nearly.
    Scene scene{.materials = {lambert(0.9), lambert(0.0)}};
    scene.meshes = {
        quads("board", 0, {}, {{{8, 0.5, -0.5}, {8, -0.5, -0.5}, {8, -0.5, 0.5}, {8, 0.5, 0.5}}}),
        quads("post", 1, {}, {{{0, -1.5, -0.5}, {0, -0.5, -0.5}, {0, -0.5, 0.5}, {0, -1.5, 0.5}}}) // faces +x
    };
    Moment clear, fog = in_fog(0.06, 0.0);
    clear.lamps = fog.lamps = {even_lamp(1.0e6, looking({0, 0, 0}, 0, 0))};
    ReferenceSettings settings = by(Integrator::path, 0.02);
    settings.min_samples = settings.max_samples = 1 << 17; // one in 200 meets the board
    settings.footprint = Footprint::centre;
    const View at_post = camera({1.0, -1.0, 0.0}, 180, 0, 1, 1);
    const ReferenceImage without = Reference(scene).render(clear, at_post, lux, settings),
                         with = Reference(scene).render(fog, at_post, lux, settings);
    const auto value = [](const Image<float>& image) { return static_cast<double>(image.at(0, 0)); };
    const double e = value(without.illuminance_lx.mean), foggy = value(with.illuminance_lx.mean), ways = 8.0 + std::hypot(8.0, 1.0);
    EXPECT_NEAR(e, 0.9 / pi * (1.0e6 / 64.0) * 64.0 / (65.0 * 65.0), 0.05 * e); // and not by anything else
    const double error = std::hypot(value(with.illuminance_lx.standard_error) / foggy, value(without.illuminance_lx.standard_error) / e);
    EXPECT_NEAR(foggy / e, std::exp(-0.06 * ways), std::exp(-0.06 * ways) * (5.0 * error + 0.002));
}

TEST(ReferenceWet, FilmIsSampledAsItMirrors) {
    // Mean weight = integral of reflectance times cosine; by midpoints over the hemisphere of directions about the mirrored one.
    const glm::dvec3 n(0, 0, 1);
    for (const double elevation_deg : {60.0, 20.0, 5.0}) {
        const glm::dvec3 out(std::cos(radians(elevation_deg)), 0.0, std::sin(radians(elevation_deg)));
        double mean = 0.0, integral = 0.0;
        const int count = 1 << 16, rings = 1500;
        const reference::PointNet net(7);
        for (int i = 0; i < count; ++i) {
            const reference::FacetSample sample = reference::sample_film(n, out, net.point(static_cast<std::uint32_t>(i), 0));
            EXPECT_LE(sample.weight, 1.0);
            mean += sample.weight / count;
        }
        for (int k = 0; k < rings; ++k)
            for (int j = 0; j < rings; ++j) {
                const double z = (k + 0.5) / rings, turn = 2.0 * pi * (j + 0.5) / rings, across = std::sqrt(1.0 - z * z);
                integral += photometry::wet_mirrored(n, {across * std::cos(turn), across * std::sin(turn), z}, out, wet_roughness) * 2.0 *
                            pi / (static_cast<double>(rings) * rings);
            }
        EXPECT_NEAR(mean, integral, 0.003 * integral) << elevation_deg;
    }
}

TEST(ReferenceWet, PathsSeeAShiningWallInAWetRoad) {
    Material road = lambert(0.2), wall = lambert(0.0, SurfaceKind::object, 100.0);
    Scene scene = level_ground(40.0, road);
    scene.materials.push_back(wall);
    scene.meshes.push_back(quads("panel", 1, {}, {{{14, 2, 0.5}, {14, -2, 0.5}, {14, -2, 3.5}, {14, 2, 3.5}}})); // faces -x
    for (const double wetness : {0.4, 1.0}) {
        Moment moment;
        moment.weather.wetness = wetness;
        const glm::dvec3 eye(0, 0.3, 1.2), at(7, 0.1, 0), n(0, 0, 1), to_eye = glm::normalize(eye - at), albedo(road.albedo);
        double truth = 0.0;
        const int steps = 400;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const glm::dvec3 from(14.0, -2.0 + 4.0 * (i + 0.5) / steps, 0.5 + 3.0 * (j + 0.5) / steps), way = from - at;
                const double d = glm::length(way), e = 100.0 * (12.0 / (steps * steps)) * (way.x / d) / (d * d);
                truth += partly_wet(albedo * (e * way.z / d / pi), wet_light(albedo, n, way / d, to_eye, e), wetness).x;
            }
        const glm::dvec3 direction = at - eye;
        View view = camera(eye, degrees(std::atan2(direction.y, direction.x)),
                           degrees(std::atan2(direction.z, std::hypot(direction.x, direction.y))), 1, 1);
        ReferenceSettings settings = by(Integrator::path, 0.003, Footprint::centre);
        const ReferenceImage image = Reference(scene).render(moment, view, everything, settings);
        EXPECT_LT(image.luminance_cdm2.standard_error.at(0, 0), 0.01 * truth);
        expect_estimate(image.luminance_cdm2, truth, 1e-5);
    }
}

TEST(ReferenceWet, PathsSeeALampInAGlossyRoadDryAndWet) {
    Material road = lambert(0.2);
    road.gloss = 0.5F;
    const Scene scene = level_ground(40.0, road);
    const glm::dvec3 lamp_m(14.0, 0.0, 1.0), eye(0.0, 0.3, 1.2), at(7.0, 0.1, 0.0), n(0.0, 0.0, 1.0),
        to_eye = glm::normalize(eye - at), to_lamp = lamp_m - at, albedo(road.albedo), direction = at - eye;
    const double d = glm::length(to_lamp), e = 10000.0 / (d * d);
    const View view = camera(eye, degrees(std::atan2(direction.y, direction.x)),
                             degrees(std::atan2(direction.z, std::hypot(direction.x, direction.y))), 1, 1);
    for (const double wetness : {0.0, 0.4, 1.0}) {
        Moment moment;
        moment.lamps = {even_lamp(10000.0, looking(lamp_m, 180.0, -4.0))};
        moment.weather.wetness = wetness;
        const double truth = partly_wet(albedo * (e * to_lamp.z / d / pi) + gloss_light(facets_of(road), n, to_lamp / d, to_eye, e),
                                        wet_light(albedo, n, to_lamp / d, to_eye, e), wetness)
                                 .x;
        for (const Integrator integrator : {Integrator::direct, Integrator::path}) {
            const ReferenceImage image = Reference(scene).render(moment, view, everything, by(integrator, 0.003, Footprint::centre));
            expect_estimate(image.luminance_cdm2, truth, 1e-5);
        }
    }
}

TEST(ReferenceWet, AWetRoomMakesNoEnergy) {
    // Below the sum of the two: light sent on by film and ground is at most all of it.
    Material wall = lambert(0.8, SurfaceKind::road, 1.0);
    const Scene scene = closed_room(wall);
    Moment moment;
    moment.weather.wetness = 1.0;
    const ReferenceImage wet = Reference(scene).render(moment, camera({0, 0, 0}, 30, 10, 40, 1), everything, by(Integrator::path)),
                         dry = Reference(scene).render({}, camera({0, 0, 0}, 30, 10, 40, 1), everything, by(Integrator::path));
    EXPECT_GT(wet.luminance_cdm2.mean.at(0, 0), 1.0F);
    EXPECT_LT(wet.luminance_cdm2.mean.at(0, 0), dry.luminance_cdm2.mean.at(0, 0)); // darker all round
}

TEST(ReferenceSun, LightThatTheGroundThrowsUpIsTheSameByAllMethods) {
    // A plate that looks down on the corner of a sunlit square from 1 m up: E = rho E_sun F, view factor of Howell's catalogue B-3.
    Scene scene{.materials = {lambert(0.5), lambert(0.0, SurfaceKind::object)}};
    scene.meshes = {
        quads("ground", 0, {}, {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}),
        quads("plate", 1, {}, {{{-0.01, -0.01, 1}, {-0.01, 0.01, 1}, {0.01, 0.01, 1}, {0.01, -0.01, 1}}}) // faces down
    };
    Moment moment;
    moment.daylight.sun = {radians(45.0), radians(30.0), 1000.0}; // the plate's shadow falls beside the square
    const double x = 1.0 / std::sqrt(2.0), factor = 2.0 * x * std::atan(x) / (2.0 * pi), truth = 0.5 * 1000.0 * 0.5 * factor;
    const View view = camera({0.3, 0.3, 0.2}, -135, degrees(std::atan2(0.8, std::hypot(0.3, 0.3))), 0.2, 1);
    for (const Integrator integrator : {Integrator::path, Integrator::radiosity, Integrator::photon_map}) {
        ReferenceSettings settings = by(integrator, 0.005);
        settings.solver.patch_m = 0.1;
        settings.solver.reach_m = 3.0;
        settings.solver.radius_m = 0.05;
        const ReferenceImage image = Reference(scene).render(moment, view, lux, settings);
        const double e = image.illuminance_lx.mean.at(0, 0), error = image.illuminance_lx.standard_error.at(0, 0);
        // Photons are missing within the disc of the square's edge: half of those there, 2 % of the area each side.
        EXPECT_NEAR(e, truth, 5.0 * error + (integrator == Integrator::photon_map ? 0.06 : 0.002) * truth) << static_cast<int>(integrator);
    }
}

TEST(ReferenceWeather, SolversRefuseFogAndWater) {
    const Scene scene = closed_room(lambert(0.5));
    Moment wet;
    wet.weather.wetness = 0.5;
    for (const Integrator integrator : {Integrator::radiosity, Integrator::photon_map})
        for (const Moment& moment : {in_fog(0.01), wet})
            EXPECT_THROW(Reference(scene).render(moment, camera({0, 0, 0}, 0, 0, 20, 1), lux, by(integrator)), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
