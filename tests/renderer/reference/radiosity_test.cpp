// Radiosity against closed forms and against paths.
#include "tests/renderer/reference/rooms.h"

#include "renderer/reference/patches.h"
#include "scenarios/values/errors.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

ReferenceSettings radiosity(double patch_m, int rays, bool final_gather) {
    ReferenceSettings settings;
    settings.integrator = Integrator::radiosity;
    settings.target_error = 0.005;
    settings.solver.patch_m = patch_m;
    settings.solver.form_factor_rays = rays;
    settings.solver.final_gather = final_gather;
    return settings;
}

/// Five standard errors: 1 in 10 000 of Student's t with 15 degrees of freedom; seeds are fixed.
void expect_radiosity(const Estimate& estimate, double truth, double bias, int x = 0, int y = 0) {
    EXPECT_NEAR(estimate.mean.at(x, y), truth, 5.0 * static_cast<double>(estimate.standard_error.at(x, y)) + bias * truth);
}

TEST(Patches, CoverTheirTrianglesAndFindTheirOwnPlaces) {
    Scene scene;
    scene.materials = {lambert(0.5)};
    Mesh mesh{"triangles", {3.0, -2.0, 0.5}, {}, {}, {}};
    add_quad(mesh, {0, 0, 0}, {20, 0, 0}, {20, 0.1, 0}, {0, 0.1, 0}); // long and thin
    add_quad(mesh, {0, 1, 0}, {2, 1, 0}, {2.5, 4, 1}, {0.2, 3, 0.3});
    add_quad(mesh, {30, 0, 0}, {30.01, 0, 0}, {30.01, 0.01, 0}, {30, 0.01, 0}); // smaller than a patch
    scene.meshes = {finished(mesh, 0)};
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
        Material wall = lambert(albedo);
        wall.emission_cdm2 = glm::vec3(3.0F);
        const Scene scene = closed_room(wall);
        const double truth = 3.0 / (1.0 - static_cast<double>(wall.albedo.x));
        for (const bool gather : {false, true}) {
            ReferenceSettings settings = radiosity(0.5, 16, gather);
            settings.solver.residual = 1e-9;
            const ReferenceImage image = Reference(scene).render({}, camera({0.2, 0.1, -0.3}, 20, 10, 60, 2), everything, settings);
            for (int y = 0; y < 2; ++y)
                for (int x = 0; x < 2; ++x) {
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

/// A ground of 1 m x 1 m and a plate of the same size 1 m above that faces it.
Scene plates(double ground_albedo, double plate_albedo, double plate_cdm2) {
    Scene scene = level_ground(0.5, lambert(ground_albedo));
    Material shining = lambert(plate_albedo, SurfaceKind::object);
    shining.emission_cdm2 = glm::vec3(static_cast<float>(plate_cdm2));
    scene.materials.push_back(shining);
    Mesh plate{"plate", {0.0, 0.0, 1.0}, {}, {}, {}};
    add_quad(plate, {-0.5, -0.5, 0}, {-0.5, 0.5, 0}, {0.5, 0.5, 0}, {0.5, -0.5, 0});
    scene.meshes.push_back(finished(plate, 1));
    return scene;
}

TEST(Radiosity, PlatesExchangeTheViewFactor) {
    // F12 = 0.19982 (Howell's catalogue, C-11, X = Y = 1). With each plate one patch (two triangles whose factors are nearly the same)
    // the two equations E1 = F (pi L + rho2 E2), E2 = F rho1 E1 have a solution by hand; patches of 0.25 m differ from it by 0.3 %.
    const double f12 = 0.19982;
    ReferenceSettings settings = radiosity(0.25, 4096, false);
    settings.least_samples = 4096; // light differs from patch to patch within the one pixel
    const ReferenceImage black = Reference(plates(0.0, 0.0, 100.0)).render({}, map_about({0, 0}, 0.5, 1), lux, settings);
    expect_radiosity(black.illuminance_lx, pi * 100.0 * f12, 1e-4); // the factor has five digits
    EXPECT_LT(black.illuminance_lx.standard_error.at(0, 0), 0.01 * pi * 100.0 * f12);
    const ReferenceImage gathered =
        Reference(plates(0.0, 0.0, 100.0)).render({}, map_about({0, 0}, 0.5, 1), lux, radiosity(0.25, 256, true));
    expect_radiosity(gathered.illuminance_lx, pi * 100.0 * f12, 1e-4);
    const ReferenceImage white = Reference(plates(0.8, 0.6, 100.0)).render({}, map_about({0, 0}, 0.5, 1), lux, radiosity(5.0, 4096, false));
    const double rho = static_cast<double>(0.8F) * static_cast<double>(0.6F);
    expect_radiosity(white.illuminance_lx, pi * 100.0 * f12 / (1.0 - rho * f12 * f12), 1e-3); // (rho F^2)^2, of the halves' difference
}

TEST(Radiosity, MeetsPathsInARoomWithALampAndALedge) {
    Scene scene = closed_room(lambert(0.6));
    scene.materials.push_back(lambert(0.2, SurfaceKind::object));
    Mesh ledge{"ledge", {}, {}, {}, {}};
    add_quad(ledge, {0.2, -0.5, -0.2}, {0.8, -0.5, -0.2}, {0.8, 0.5, -0.2}, {0.2, 0.5, -0.2});
    add_quad(ledge, {0.2, -0.5, -0.25}, {0.2, 0.5, -0.25}, {0.8, 0.5, -0.25}, {0.8, -0.5, -0.25});
    scene.meshes.push_back(finished(ledge, 1));
    Moment moment;
    moment.lamps = {even_lamp(100.0, looking({-0.6, 0.1, 0.3}, 0, -10))};
    const View view = camera({-0.8, 0.0, 0.0}, 0, -15, 60, 4);
    const Reference reference(scene);
    ReferenceSettings paths;
    paths.integrator = Integrator::path;
    paths.target_error = 0.01;
    ReferenceSettings solver = radiosity(0.1, 64, true);
    solver.target_error = 0.01;
    const ReferenceImage truth = reference.render(moment, view, everything, paths),
                         solved = reference.render(moment, view, everything, solver);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
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
    Scene scene = level_ground(1.0, lambert(0.0));
    scene.materials.push_back(lambert(0.0, SurfaceKind::object));
    Mesh plate{"plate", {0.0, 0.0, 2.0}, {}, {}, {}};
    add_quad(plate, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0});
    scene.meshes.push_back(finished(plate, 1));
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = 40.0;
    const double x = 0.5, r = std::sqrt(1.0 + x * x), hidden = 4.0 * 2.0 * (x / r * std::atan(x / r)) / (2.0 * pi); // Howell B-3
    for (const bool gather : {false, true}) {
        ReferenceSettings settings = radiosity(0.5, 1024, gather);
        settings.solver.reach_m = 2.0;
        const ReferenceImage image = Reference(scene).render(moment, map_about({0, 0}, 0.1, 1), lux, settings);
        expect_radiosity(image.illuminance_lx, 40.0 * (1.0 - hidden), 0.003); // the mean over patches of half a metre
    }
}

} // namespace
} // namespace fernlicht
