// Photons against closed forms and against paths; flux is kept.
#include "renderer/reference/patches.h"
#include "renderer/reference/photon_map.h"
#include "renderer/reference/pixel_estimate.h"
#include "scenarios/values/errors.h"
#include "tests/renderer/reference/rooms.h"

#include <tbb/global_control.h>

namespace fernlicht {
namespace {

ReferenceSettings photons(std::int64_t count, double radius_m, bool final_gather) {
    ReferenceSettings settings{.integrator = Integrator::photon_map, .target_error = 0.005};
    settings.solver.photons = count;
    settings.solver.radius_m = radius_m;
    settings.solver.final_gather = final_gather;
    return settings;
}

struct Solved {
    Solved(const Scene& scene, const Moment& moment, const ReferenceSettings& settings)
        : embree(scene, {0, 0, 0}), shot(embree, moment, view, everything, settings), map(shot, preparation) {}
    View view = camera({0, 0, 0}, 0, 0, 10, 1);
    reference::EmbreeScene embree;
    reference::Shot shot;
    Preparation preparation;
    reference::PhotonMap map;

    /// Of all replicates where a ray from the origin meets a surface.
    reference::MeanAndError irradiance(const glm::dvec3& direction, reference::Part part) const {
        std::array<double, reference::replicate_count> values{};
        for (std::size_t r = 0; r < values.size(); ++r)
            values[r] = reference::luminance(map.irradiance(*embree.cast({glm::dvec3(0.0), direction}), part, r));
        return reference::mean_of(values);
    }
};

Moment with(LitLamp lamp) { return {.lamps = {std::move(lamp)}}; }

LitLamp library_lamp(const char* name, const Pose& pose) {
    return {name,         std::make_shared<LampFile>(read_lamp(std::string(FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/") + name)),
            pose,         0.8,
            LampColour{}, 0.0};
}

TEST(PhotonMap, FluxIsKept) {
    // What arrives on the walls of a closed room is the lamp's flux, and with every bounce rho of it: flux / (1 - rho).
    for (const double albedo : {0.0, 0.6})
        for (const char* name : {"halogen-low.ies", "xenon-high.ies"}) {
            const Scene scene = closed_room(lambert(albedo));
            const Moment moment = with(library_lamp(name, looking({0.1, 0.2, -0.1}, 30, 5)));
            const Solved solved(scene, moment, photons(1 << 16, 0.1, false));
            const double flux = 0.8 * flux_lm(moment.lamps[0].file->table);
            EXPECT_NEAR(reference::luminance(solved.map.flux_lm(reference::Part::all)), flux / (1.0 - albedo),
                        0.005 * flux / (1.0 - albedo)) // 65536 photons; where nothing bounces they are stratified
                << name << albedo;
            EXPECT_NEAR(reference::luminance(solved.map.flux_lm(reference::Part::without_lamps)), flux * albedo / (1.0 - albedo),
                        0.01 * flux);
        }
}

TEST(PhotonMap, AWallAt25mHasItsIlluminance) {
    // I / 625 on the axis, cos^3 beside it, by photons alone: a lamp of 10 000 cd within 6 degrees.
    LitLamp lamp = even_lamp(10'000.0, looking({0, 0, 0}, 0, 0));
    auto file = std::make_shared<LampFile>(*lamp.file);
    file->table.h_deg = {-6.0, 1.0, 6.0}, file->table.v_deg = {-6.0, 6.0};
    file->table.cd.assign(6, 10'000.0);
    lamp.file = file;
    Scene scene{.materials = {lambert(0.5, SurfaceKind::object)}};
    scene.meshes = {quads("wall", 0, {25.0, 0.0, 0.0}, {{{0, 4, -4}, {0, -4, -4}, {0, -4, 4}, {0, 4, 4}}})};
    const Solved solved(scene, with(lamp), photons(1 << 18, 0.3, false));
    for (const double angle_deg : {0.0, 4.0}) {
        const double c = std::cos(radians(angle_deg)), truth = 16.0 * c * c * c;
        const auto [e, error] = solved.irradiance({c, std::sin(radians(angle_deg)), 0.0}, reference::Part::all);
        EXPECT_NEAR(e, truth, 5.0 * error + 1e-4 * truth); // smoothing over 0.3 m at 25 m: (0.3 / 25)^2
        EXPECT_LT(error, 0.02 * truth);                    // 2700 photons on the disc
        EXPECT_EQ(solved.irradiance({c, std::sin(radians(angle_deg)), 0.0}, reference::Part::without_lamps).mean, 0.0);
    }
}

TEST(PhotonMap, KeepsEnergyInAWhiteClosedRoom) {
    Material wall = lambert(0.6, SurfaceKind::road, 3.0);
    const Scene scene = closed_room(wall);
    const double truth = 3.0 / (1.0 - static_cast<double>(wall.albedo.x));
    const View view = camera({0, 0, 0}, 0, 0, 20, 2); // the middle of a wall, more than a radius away from its ends
    for (const bool gather : {false, true}) {
        const ReferenceImage image = Reference(scene).render({}, view, everything, photons(1 << 17, 0.1, gather));
        for (const auto& [x, y] : each_pixel(2, 2)) // gathered from everywhere: a strip of 0.1 m along the walls' ends has less light
            expect_estimate(image.luminance_cdm2, truth, gather ? 0.03 : 1e-6, x, y);
    }
}

TEST(PhotonMap, AMirrorThrowsTheLampsLightOnTheWall) {
    // The lamp looks away from the wall into a mirror at d1; it is as if it stood behind: E = R I / (d1 + d2)^2. Paths cannot find it.
    Scene scene;
    Material mirror = lambert(0.0, SurfaceKind::object);
    mirror.mirror = 0.8F;
    scene.materials = {lambert(0.0, SurfaceKind::object), mirror};
    scene.meshes = {quads("wall", 0, {-3.0, 0.0, 0.0}, {{{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}}}),
                    quads("mirror", 1, {2.0, 0.0, 0.0}, {{{0, 1, -1}, {0, -1, -1}, {0, -1, 1}, {0, 1, 1}}})};
    const double truth = static_cast<double>(0.8F) * 500.0 / 49.0; // 2 m there, 5 m back
    const Moment moment = with(even_lamp(500.0, looking({0, 0, 0}, 0, 0)));
    const Solved solved(scene, moment, photons(1 << 20, 0.2, true));
    const auto [e, error] = solved.irradiance({-1, 0, 0}, reference::Part::caustic);
    EXPECT_NEAR(e, truth, 5.0 * error + 2e-3 * truth); // (0.2 / 7)^2 of smoothing
    EXPECT_LT(error, 0.03 * truth);
    const View view = camera({-1, 0, 0}, 180, 0, 1, 1);
    const ReferenceImage image = Reference(scene).render(moment, view, everything, photons(1 << 20, 0.2, true));
    expect_estimate(image.illuminance_lx, truth, 2e-3);
}

TEST(PhotonMap, TheSkyLightsALevelSurface) {
    const Scene scene = level_ground(50.0, lambert(0.0));
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = 40.0;
    ReferenceSettings settings = photons(1 << 18, 0.5, false);
    settings.solver.reach_m = 4.0;
    const ReferenceImage image = Reference(scene).render(moment, map_about({0, 0}, 0.5, 1), lux, settings);
    expect_estimate(image.illuminance_lx, 40.0, 1e-4);
    EXPECT_LT(image.illuminance_lx.standard_error.at(0, 0), 1.0F);
}

TEST(PhotonMap, MeetsPathsInARoomWithALamp) {
    const Scene scene = closed_room(lambert(0.5));
    const Moment moment = with(even_lamp(100.0, looking({-0.6, 0.1, 0.3}, 0, -10)));
    const View view = camera({-0.8, 0.0, 0.0}, 0, 0, 60, 4);
    const Reference reference(scene);
    ReferenceSettings paths{.integrator = Integrator::path, .target_error = 0.005};
    const ReferenceImage truth = reference.render(moment, view, everything, paths),
                         gathered = reference.render(moment, view, everything, photons(1 << 18, 0.05, true)),
                         seen = reference.render(moment, view, everything, photons(1 << 18, 0.1, false));
    for (const auto& [x, y] : each_pixel(4, 4)) {
        const double e = truth.illuminance_lx.mean.at(x, y);
        const auto error = [&, u = x, v = y](const ReferenceImage& image) -> double {
            return std::hypot(truth.illuminance_lx.standard_error.at(u, v), image.illuminance_lx.standard_error.at(u, v));
        };
        // Strips of 0.05 m along the walls' ends are a tenth of the room and lack a fifth of their light, which is a third of the
        // whole.
        EXPECT_NEAR(gathered.illuminance_lx.mean.at(x, y), e, 5.0 * error(gathered) + 0.01 * e) << x << " " << y;
        EXPECT_NEAR(seen.illuminance_lx.mean.at(x, y), e, 5.0 * error(seen) + 0.01 * e) << x << " " << y;
    }
}

TEST(SolvedLight, HasTheSameBytesForAnyNumberOfThreads) {
    const Scene scene = closed_room(lambert(0.5));
    const Moment moment = with(even_lamp(100.0, looking({-0.6, 0.1, 0.3}, 0, -10)));
    for (const Integrator integrator : {Integrator::radiosity, Integrator::photon_map}) {
        ReferenceSettings settings = photons(1 << 14, 0.2, true);
        settings.integrator = integrator;
        settings.target_error = 0.1;
        settings.solver.patch_m = 0.25;
        const auto drawn = [&](std::size_t threads) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            return Reference(scene).render(moment, camera({-0.8, 0, 0}, 0, 0, 60, 20), everything, settings);
        };
        const ReferenceImage one = drawn(1), five = drawn(5);
        EXPECT_EQ(one.luminance_cdm2.mean, five.luminance_cdm2.mean);
        EXPECT_EQ(one.illuminance_lx.standard_error, five.illuminance_lx.standard_error);
        EXPECT_EQ(one.rays, five.rays);
        settings.seed = 2;
        EXPECT_NE(drawn(1).illuminance_lx.mean, one.illuminance_lx.mean);
    }
}

TEST(SolvedLight, RefusesSettingsThatMakeNoSense) {
    const Scene scene = level_ground(1.0, lambert(0.3));
    const auto refused = [&](auto change) {
        ReferenceSettings settings = photons(16, 0.1, true);
        change(settings);
        EXPECT_THROW(Reference(scene).render({}, map_about({0, 0}, 1.0, 1), lux, settings), std::invalid_argument);
    };
    refused([](ReferenceSettings& s) { s.shadows = false; });
    refused([](ReferenceSettings& s) { s.solver.reach_m = 0.0; });
    refused([](ReferenceSettings& s) { s.solver.patch_m = std::nan(""); });
    refused([](ReferenceSettings& s) { s.solver.radius_m = 0.0; });
    refused([](ReferenceSettings& s) { s.solver.photons = 0; });
    refused([](ReferenceSettings& s) { s.solver.form_factor_rays = 0; });
    refused([](ReferenceSettings& s) { s.max_smooth = -1; });
    // In the dark, and with nothing in reach, there is no light and no failure.
    ReferenceSettings settings = photons(16, 0.1, true);
    EXPECT_EQ(Reference(scene).render({}, map_about({0, 0}, 1.0, 1), lux, settings).illuminance_lx.mean.at(0, 0), 0.0F);
    settings.integrator = Integrator::radiosity;
    EXPECT_EQ(Reference(scene).render({}, map_about({0, 0}, 1.0, 1), lux, settings).illuminance_lx.mean.at(0, 0), 0.0F);
}

// Radiosity against closed forms and against paths.

ReferenceSettings radiosity(double patch_m, int rays, bool final_gather) {
    ReferenceSettings settings{.integrator = Integrator::radiosity, .target_error = 0.005};
    settings.solver.patch_m = patch_m;
    settings.solver.form_factor_rays = rays;
    settings.solver.final_gather = final_gather;
    return settings;
}

TEST(Patches, CoverTheirTrianglesAndFindTheirOwnPlaces) {
    Scene scene{.materials = {lambert(0.5)}};
    scene.meshes = {quads("triangles", 0, {3.0, -2.0, 0.5}, // long and thin; any; smaller than a patch
                          {{{0, 0, 0}, {20, 0, 0}, {20, 0.1, 0}, {0, 0.1, 0}},
                           {{0, 1, 0}, {2, 1, 0}, {2.5, 4, 1}, {0.2, 3, 0.3}},
                           {{30, 0, 0}, {30.01, 0, 0}, {30.01, 0.01, 0}, {30, 0.01, 0}}})};
    const reference::EmbreeScene embree(scene, {0, 0, 0});
    const reference::Patches patches(embree, reference::facets_within(embree, {0, 0, 0}, 100.0), 0.5, 100000);
    EXPECT_GT(patches.size(), 40U + 40U + 20U + 2U); // 20 m of two thin triangles, the slanted ones, one for each of the small
    EXPECT_LT(patches.size(), 200U);                 // thin ones are not cut across
    for (std::uint32_t p = 0; p < patches.size(); ++p)
        for (const glm::dvec2 square : {glm::dvec2(0.1, 0.1), glm::dvec2(0.9, 0.5), glm::dvec2(0.47, 0.9)}) // not 0.5: a corner of some
            EXPECT_EQ(patches.at(patches.place(p, square)), p);
    // No patch is larger than asked for, in any direction: a fan of slivers would pass for light from the triangle's other end.
    for (std::uint32_t p = 0; p < patches.size(); ++p)
        for (const glm::dvec2 a : {glm::dvec2(0.01, 0.01), glm::dvec2(0.99, 0.01), glm::dvec2(0.99, 0.99)})
            for (const glm::dvec2 b : {glm::dvec2(0.5, 0.99), glm::dvec2(0.99, 0.99)})
                EXPECT_LT(glm::length(patches.place(p, a).point_m - patches.place(p, b).point_m), 0.5 * std::sqrt(2.0));
    // A ray finds the patch of the place that it is aimed at.
    const reference::SurfaceHit place = patches.place(7, {0.3, 0.6});
    const auto hit = embree.cast({place.point_m + glm::dvec3(0.01, 0.02, 3.0), glm::dvec3(-0.01, -0.02, -3.0)});
    ASSERT_TRUE(hit);
    EXPECT_EQ(patches.at(*hit), 7U);
    EXPECT_LT(reference::facets_within(embree, {0, 0, 0}, 10.0).size(), 6U); // what is out of reach is left out
    EXPECT_THROW(reference::Patches(embree, reference::facets_within(embree, {0, 0, 0}, 100.0), 0.5, 100), InputError);
}

TEST(Radiosity, IsExactInAClosedRoomOfOneMaterial) {
    // Rows of form factors add up to 1 in a closed room whatever the rays: L = Le / (1 - rho) without noise.
    for (const double albedo : {0.0, 0.5, 0.9}) {
        Material wall = lambert(albedo, SurfaceKind::road, 3.0);
        const Scene scene = closed_room(wall);
        const double truth = 3.0 / (1.0 - static_cast<double>(wall.albedo.x));
        for (const bool gather : {false, true}) {
            ReferenceSettings settings = radiosity(0.5, 16, gather);
            settings.solver.residual = 1e-9;
            const ReferenceImage image = Reference(scene).render({}, camera({0.2, 0.1, -0.3}, 20, 10, 60, 2), everything, settings);
            for (const auto& [x, y] : each_pixel(2, 2)) {
                EXPECT_NEAR(image.luminance_cdm2.mean.at(x, y), truth, 1e-6 * truth); // a float; the residual over 1 - rho is 1e-8
                EXPECT_NEAR(image.illuminance_lx.mean.at(x, y), pi * truth, 1e-6 * pi * truth);
                EXPECT_LT(image.luminance_cdm2.standard_error.at(x, y), 1e-6 * truth);
            }
            EXPECT_LE(image.preparation.residual, 1e-9);
            EXPECT_GT(image.preparation.patches, 6U * 16U);
            EXPECT_EQ(image.preparation.sweeps > 3, albedo > 0.0);
        }
    }
}

TEST(Radiosity, PlatesExchangeTheViewFactor) {
    // With each plate one patch (two triangles whose factors are nearly the same)
    // the two equations E1 = F (pi L + rho2 E2), E2 = F rho1 E1 have a solution by hand; patches of 0.25 m differ from it by 0.3 %.
    const double f12 = plates_factor;
    ReferenceSettings settings = radiosity(0.25, 4096, false);
    settings.min_samples = 4096; // light differs from patch to patch within the one pixel
    const ReferenceImage black = Reference(plates(0.0, 0.0, 100.0)).render({}, map_about({0, 0}, 0.5, 1), lux, settings);
    expect_estimate(black.illuminance_lx, pi * 100.0 * f12, 1e-4);
    EXPECT_LT(black.illuminance_lx.standard_error.at(0, 0), 0.01 * pi * 100.0 * f12);
    const ReferenceImage gathered =
        Reference(plates(0.0, 0.0, 100.0)).render({}, map_about({0, 0}, 0.5, 1), lux, radiosity(0.25, 256, true));
    expect_estimate(gathered.illuminance_lx, pi * 100.0 * f12, 1e-4);
    const ReferenceImage white = Reference(plates(0.8, 0.6, 100.0)).render({}, map_about({0, 0}, 0.5, 1), lux, radiosity(5.0, 4096, false));
    const double rho = static_cast<double>(0.8F) * static_cast<double>(0.6F);
    expect_estimate(white.illuminance_lx, pi * 100.0 * f12 / (1.0 - rho * f12 * f12), 1e-3); // (rho F^2)^2, of the halves' difference
}

TEST(Radiosity, MeetsPathsInARoomWithALampAndALedge) {
    Scene scene = closed_room(lambert(0.6));
    scene.materials.push_back(lambert(0.2, SurfaceKind::object));
    scene.meshes.push_back(quads("ledge", 1, {},
                                 {{{0.2, -0.5, -0.2}, {0.8, -0.5, -0.2}, {0.8, 0.5, -0.2}, {0.2, 0.5, -0.2}},
                                  {{0.2, -0.5, -0.25}, {0.2, 0.5, -0.25}, {0.8, 0.5, -0.25}, {0.8, -0.5, -0.25}}}));
    Moment moment{.lamps = {even_lamp(100.0, looking({-0.6, 0.1, 0.3}, 0, -10))}};
    const View view = camera({-0.8, 0.0, 0.0}, 0, -15, 60, 4);
    const Reference reference(scene);
    ReferenceSettings paths{.integrator = Integrator::path, .target_error = 0.01}, solver = radiosity(0.1, 64, true);
    solver.target_error = 0.01;
    const ReferenceImage truth = reference.render(moment, view, everything, paths),
                         solved = reference.render(moment, view, everything, solver);
    for (const auto& [x, y] : each_pixel(4, 4)) {
        const double e = truth.illuminance_lx.mean.at(x, y),
                     error = std::hypot(truth.illuminance_lx.standard_error.at(x, y), solved.illuminance_lx.standard_error.at(x, y));
        EXPECT_NEAR(solved.illuminance_lx.mean.at(x, y), e, 5.0 * error + 0.005 * e) // patches of 0.1 m in a room of 2 m: 0.3 % here
            << x << " " << y;
    }
    // What would be missed: light that bounced is most of what some pixels have.
    ReferenceSettings direct;
    double least = 1.0;
    const ReferenceImage once = reference.render(moment, view, everything, direct);
    for (std::size_t i = 0; i < once.illuminance_lx.mean.size(); ++i)
        least = std::min(least, static_cast<double>(once.illuminance_lx.mean.pixels()[i] / truth.illuminance_lx.mean.pixels()[i]));
    EXPECT_LT(least, 0.25);
}

TEST(Radiosity, TheSkyIsThatWhichThingsLetThrough) {
    // A plate 2 m above hides its share; on the plate's own lower side nothing shines and the ground is black.
    const Scene scene = hidden_sky(1.0);
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = 40.0;
    const double x = 0.5, r = std::sqrt(1.0 + x * x), hidden = 4.0 * 2.0 * (x / r * std::atan(x / r)) / (2.0 * pi); // Howell B-3
    for (const bool gather : {false, true}) {
        ReferenceSettings settings = radiosity(0.5, 1024, gather);
        settings.solver.reach_m = 2.0;
        const ReferenceImage image = Reference(scene).render(moment, map_about({0, 0}, 0.1, 1), lux, settings);
        expect_estimate(image.illuminance_lx, 40.0 * (1.0 - hidden), 0.003); // the mean over patches of half a metre
    }
}

} // namespace
} // namespace fernlicht
