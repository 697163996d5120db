// Smooth surfaces, by Whitted's recursion and by paths, against closed forms.
#include "tests/renderer/reference/rooms.h"

#include "renderer/reference/sampling.h"
#include "renderer/reference/scattering.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using reference::fresnel_reflectance;

ReferenceSettings one_ray(Integrator integrator) {
    ReferenceSettings settings;
    settings.integrator = integrator;
    settings.footprint = Footprint::centre;
    settings.target_error = 0.005;
    return settings;
}

Material smooth(float mirror, float glass_index) {
    Material material = lambert(0.0, SurfaceKind::object);
    material.mirror = mirror;
    material.glass_index = glass_index;
    return material;
}

TEST(Fresnel, HasTheValuesOfTheTextbook) {
    EXPECT_NEAR(fresnel_reflectance(1.0, 1.5), 0.04, 1e-15); // ((n - 1) / (n + 1))^2
    EXPECT_NEAR(fresnel_reflectance(0.0, 1.5), 1.0, 1e-15);
    // At Brewster's angle, tan = n, one polarisation is not reflected, the other by ((n^2 - 1) / (n^2 + 1))^2.
    EXPECT_NEAR(fresnel_reflectance(std::cos(std::atan(1.5)), 1.5), 0.5 * std::pow(1.25 / 3.25, 2.0), 1e-14);
    // Out of the glass: total beyond asin(1 / n) = 41.81 degrees.
    EXPECT_EQ(fresnel_reflectance(std::cos(radians(41.82)), 1.0 / 1.5), 1.0);
    EXPECT_LT(fresnel_reflectance(std::cos(radians(41.80)), 1.0 / 1.5), 0.96);
    EXPECT_EQ(fresnel_reflectance(0.3, 1.0), 0.0);
    for (const double sine : {0.1, 0.5, 0.9, 0.999}) // the same from both sides
        EXPECT_NEAR(fresnel_reflectance(std::sqrt(1.0 - sine * sine), 1.5),
                    fresnel_reflectance(std::sqrt(1.0 - sine * sine / 2.25), 1.0 / 1.5), 1e-12);
}

TEST(Fresnel, RefractionFollowsSnell) {
    reference::Surface surface;
    surface.glass_index = 1.5;
    surface.out = {std::sin(radians(60.0)), 0.0, std::cos(radians(60.0))};
    for (const bool from_behind : {false, true}) {
        surface.hit.from_behind = from_behind;
        surface.out = {std::sin(radians(30.0)), 0.0, (from_behind ? -1.0 : 1.0) * std::cos(radians(30.0))};
        const reference::SpecularSplit split = reference::specular_split(surface);
        const double ratio = from_behind ? 1.5 : 1.0 / 1.5;
        EXPECT_NEAR(split.refracted.x, -std::sin(radians(30.0)) * ratio, 1e-12); // n1 sin = n2 sin
        EXPECT_EQ(split.refracted.z > 0.0, from_behind);
        EXPECT_NEAR(split.mirrored.x, -surface.out.x, 1e-12);
        EXPECT_NEAR(split.mirrored.z, surface.out.z, 1e-12);
        EXPECT_NEAR(split.mirrored_share + split.refracted_share, 1.0, 1e-15);
    }
}

/// A wall at x = 4 that faces the car, a mirror in the plane x = y that shows it to an eye that looks along +y, and a lamp before the wall.
Scene mirror_and_wall(const Material& mirror) {
    Scene scene;
    scene.materials = {lambert(0.5, SurfaceKind::object), mirror};
    Mesh wall{"wall", {4.0, 0.0, 0.0}, {}, {}, {}}, looking_glass{"mirror", {0.0, 0.0, 0.0}, {}, {}, {}};
    add_quad(wall, {0, 1, -1}, {0, -1, -1}, {0, -1, 1}, {0, 1, 1});
    add_quad(looking_glass, {-1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, -1, 1}); // faces +x -y
    scene.meshes = {finished(wall, 0), finished(looking_glass, 1)};
    return scene;
}

TEST(Whitted, AMirrorShowsTheWall) {
    for (const float share : {1.0F, 0.6F}) {
        const Scene scene = mirror_and_wall(smooth(share, 0.0F));
        Moment moment;
        moment.lamps = {even_lamp(900.0, looking({1.0, 0.0, 0.5}, 0, 0))}; // shines on the wall, away from the mirror
        const double d2 = 9.0 + 0.25, e = 900.0 / d2 * 3.0 / std::sqrt(d2), truth = static_cast<double>(share) * 0.5 * e / pi;
        const View view = camera({0.0, -3.0, 0.0}, 90, 0, 1, 1);
        const Reference reference(scene);
        EXPECT_NEAR(reference.render(moment, view, everything, one_ray(Integrator::whitted)).luminance_cdm2.mean.at(0, 0), truth,
                    1e-6 * truth); // a float
        EXPECT_NEAR(reference.render(moment, view, everything, one_ray(Integrator::path)).luminance_cdm2.mean.at(0, 0), truth,
                    1e-6 * truth); // mirrors share the light out without dice where the eye looks; nothing else sends any to the wall
        EXPECT_EQ(reference.render(moment, view, everything, one_ray(Integrator::direct)).luminance_cdm2.mean.at(0, 0), 0.0F);
    }
}

/// Two plates of glass, 4 m x 4 m, at x = 1 and x = 1.2, one body; a shining wall at x = 3.
Scene slab_before_shining_wall(float glass_index) {
    Scene scene;
    Material shining = lambert(0.0, SurfaceKind::object);
    shining.emission_cdm2 = glm::vec3(100.0F);
    scene.materials = {smooth(0.0F, glass_index), shining};
    Mesh slab{"slab", {}, {}, {}, {}}, wall{"wall", {3.0, 0.0, 0.0}, {}, {}, {}};
    add_quad(slab, {1.0, 2, -2}, {1.0, -2, -2}, {1.0, -2, 2}, {1.0, 2, 2});
    add_quad(slab, {1.2, -2, -2}, {1.2, 2, -2}, {1.2, 2, 2}, {1.2, -2, 2});
    add_quad(wall, {0, 2, -2}, {0, -2, -2}, {0, -2, 2}, {0, 2, 2});
    scene.meshes = {finished(slab, 0), finished(wall, 1)};
    return scene;
}

TEST(Whitted, ASlabOfGlassLetsThroughWhatStokesSays) {
    // Sum over the reflections within: (1 - F)^2 (1 + F^2 + F^4 ...) = (1 - F)^2 / (1 - F^2).
    for (const double index : {1.5, 2.5}) {
        const Scene scene = slab_before_shining_wall(static_cast<float>(index));
        const double f = std::pow((index - 1.0) / (index + 1.0), 2.0), truth = 100.0 * (1.0 - f) * (1.0 - f) / (1.0 - f * f);
        const View view = camera({0, 0, 0}, 0, 0, 1, 1);
        const Reference reference(scene);
        ReferenceSettings settings = one_ray(Integrator::whitted);
        settings.most_smooth = 32;
        EXPECT_NEAR(reference.render({}, view, everything, settings).luminance_cdm2.mean.at(0, 0), truth, 1e-6 * truth);
        settings.most_smooth = 2; // straight through alone
        EXPECT_NEAR(reference.render({}, view, everything, settings).luminance_cdm2.mean.at(0, 0), 100.0 * (1.0 - f) * (1.0 - f), 1e-4);
        settings.most_smooth = 1;
        EXPECT_EQ(reference.render({}, view, everything, settings).luminance_cdm2.mean.at(0, 0), 0.0F);
        const ReferenceImage path = reference.render({}, view, everything, one_ray(Integrator::path));
        EXPECT_NEAR(path.luminance_cdm2.mean.at(0, 0), truth,
                    5.0 * static_cast<double>(path.luminance_cdm2.standard_error.at(0, 0)) + 1e-6 * truth);
    }
}

TEST(Whitted, GlassInAnEvenRoomCannotBeSeen) {
    // Wherever light goes in a black room whose walls shine evenly, it comes from a wall: mirror and refraction keep energy.
    Material wall = lambert(0.0, SurfaceKind::object);
    wall.emission_cdm2 = glm::vec3(3.0F);
    Scene scene = closed_room(wall);
    scene.materials.push_back(smooth(0.0F, 1.5F));
    Mesh prism{"prism", {}, {}, {}, {}};
    const glm::dvec3 a{0.3, -0.3, -0.2}, b{0.3, 0.4, -0.3}, c{0.8, 0.1, -0.2}, d{0.5, 0.0, 0.5};
    for (const auto& [p, q, r] : {std::tuple(a, c, b), std::tuple(a, b, d), std::tuple(b, c, d), std::tuple(c, a, d)}) {
        glm::dvec3 n = glm::normalize(glm::cross(q - p, r - p));
        if (glm::dot(n, 0.25 * (a + b + c + d) - p) > 0.0)
            n = -n;
        const auto first = static_cast<std::uint32_t>(prism.vertices.size());
        for (const glm::dvec3& v : {p, q, r})
            prism.vertices.push_back({glm::vec3(v), glm::vec3(n), {0, 0}});
        for (const std::uint32_t i : {0U, 1U, 2U})
            prism.indices.push_back(first + i);
    }
    scene.meshes.push_back(finished(prism, 1));
    const Reference reference(scene);
    const View view = camera({-0.5, 0.0, 0.0}, 0, 0, 50, 8);
    ReferenceSettings settings = one_ray(Integrator::whitted);
    settings.most_smooth = 40;
    const ReferenceImage whitted = reference.render({}, view, everything, settings),
                         path = reference.render({}, view, everything, one_ray(Integrator::path));
    int through_glass = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            through_glass += whitted.ids.at(x, y) == 2;
            EXPECT_NEAR(whitted.luminance_cdm2.mean.at(x, y), 3.0, 3e-4); // 40 surfaces in a row keep less than 1e-4 within
            EXPECT_NEAR(path.luminance_cdm2.mean.at(x, y), 3.0,
                        5.0 * static_cast<double>(path.luminance_cdm2.standard_error.at(x, y)) + 3e-4);
        }
    EXPECT_GT(through_glass, 8);
}

TEST(Whitted, IsDirectLightToTheBitWhereNothingIsSmooth) {
    const Scene scene = level_ground(20.0, lambert(0.3));
    Moment moment;
    moment.lamps = {even_lamp(1000.0, looking({0, 0, 1}, 0, -20))};
    moment.daylight.horizontal_illuminance_lx = 2.0;
    ReferenceSettings settings;
    const View view = camera({0, 0, 1.2}, 0, -5, 30, 8);
    const Reference reference(scene);
    const ReferenceImage direct = reference.render(moment, view, everything, settings);
    settings.integrator = Integrator::whitted;
    const ReferenceImage whitted = reference.render(moment, view, everything, settings);
    EXPECT_EQ(direct.luminance_cdm2.mean, whitted.luminance_cdm2.mean);
    EXPECT_EQ(direct.illuminance_lx.mean, whitted.illuminance_lx.mean);
    EXPECT_EQ(direct.rays, whitted.rays);
}

TEST(Whitted, RefusesMaterialsThatMakeEnergy) {
    Material both = smooth(0.7F, 0.0F);
    both.albedo = glm::vec3(0.4F);
    for (const Material& bad : {both, smooth(-0.1F, 0.0F), smooth(0.0F, 0.7F), smooth(0.5F, 1.5F)}) {
        const Scene scene = level_ground(1.0, bad);
        EXPECT_THROW(Reference(scene).render({}, map_about({0, 0}, 1.0, 1), lux, {}), std::invalid_argument);
    }
}

} // namespace
} // namespace fernlicht
