// Direct light of the reference against closed forms and against the double-precision twin.
#include "renderer/reference/embree_scene.h"
#include "renderer/reference/sampling.h"
#include "renderer/reference/scattering.h"
#include "renderer/twin.h"
#include "tests/renderer/reference/rooms.h"

namespace fernlicht {
namespace {

using reference::fresnel_reflectance;

/// Floats store the results: half a unit in the last place.
constexpr double stored = 6e-8;

ReferenceSettings centre_rays() { return {.footprint = Footprint::centre}; }

TEST(ReferenceDirect, LightsAWallAt25MetresAsTheInverseSquareAndTheCubeOfTheCosineSay) {
    Scene scene{.materials = {lambert(0.5, SurfaceKind::object)},
                .meshes = {quads("wall", 0, {25.0, 0.0, 0.0}, {{{0, 20, -20}, {0, -20, -20}, {0, -20, 20}, {0, 20, 20}}})}};
    Moment moment{.lamps = {even_lamp(10000.0, looking({0, 0, 0}, 0, 0))}};
    const View view = camera({0, 0, 0}, 0, 0, 60, 33); // an odd number: one pixel on the axis
    const ReferenceImage image = Reference(scene).render(moment, view, everything, centre_rays());
    for (const auto& [x, y] : each_pixel(33, 33)) {
        const double t = std::tan(radians(30)), u = ((x + 0.5) / 16.5 - 1.0) * t, v = ((y + 0.5) / 16.5 - 1.0) * t;
        const double cosine = 1.0 / std::sqrt(1.0 + u * u + v * v), e = 10000.0 / 625.0 * std::pow(cosine, 3);
        EXPECT_NEAR(image.illuminance_lx.mean.at(x, y), e, 1e-6 * e) << x << " " << y;
        EXPECT_NEAR(image.luminance_cdm2.mean.at(x, y), 0.5 * e / pi, 1e-6 * e);
        EXPECT_EQ(image.ids.at(x, y), 1U);
    }
    EXPECT_NEAR(image.illuminance_lx.mean.at(16, 16), 16.0, 16.0 * stored);
}

TEST(ReferenceDirect, AveragesAPixelOfThePlaneUnderALampAsTheIntegralDoes) {
    // E = I h / (h^2 + x^2 + y^2)^(3/2), whose integral over a rectangle is I sum of +- atan(x y / (h r)) over its corners.
    const Scene scene = level_ground(50.0, lambert(0.2));
    Moment moment;
    const double h = 0.65, cd = 1000.0;
    moment.lamps = {even_lamp(cd, looking({0, 0, h}, 0, -90))};
    const View view = map_about({1.0, 0.5}, 2.0, 4);
    const ReferenceImage image = Reference(scene).render(moment, view, lux, ReferenceSettings{.target_error = 0.001});
    ASSERT_TRUE(image.complete);
    for (const auto& [column, row] : each_pixel(4, 4)) {
        const double x1 = 1.0 + 2.0 - row, x0 = x1 - 1.0, y1 = 0.5 + 2.0 - column, y0 = y1 - 1.0;
        const auto corner = [&](double x, double y) { return std::atan2(x * y, h * std::sqrt(h * h + x * x + y * y)); };
        const double truth = cd * (corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0));
        const double error = image.illuminance_lx.standard_error.at(column, row);
        // Five standard errors: 1 in 10 000 of Student's t with 15 degrees of freedom, for one of 16 fixed pixels.
        EXPECT_NEAR(image.illuminance_lx.mean.at(column, row), truth, 5.0 * error + stored * truth) << column << " " << row;
        EXPECT_LE(error, 0.001 * truth * 1.05);
        EXPECT_EQ(image.mixed.at(column, row), 0);
    }
}

TEST(ReferenceDirect, DrawsOnlyTheTilesAskedForWithWhatTheyHaveInAWholePicture) {
    const Scene scene = level_ground(50.0, lambert(0.2));
    Moment moment{.lamps = {even_lamp(1000.0, looking({0, 0, 0.65}, 0, -90))}};
    const View view = map_about({1.0, 0.5}, 4.0, 10); // tiles of 4, 4 and 2
    const Reference reference(scene);
    const auto drawn = [&](const std::vector<int>& only, ReferenceImage from = {}) {
        return reference.render(moment, view, lux, {}, {}, std::move(from), {}, {4, only});
    };
    const ReferenceImage whole = drawn({}), some = drawn({0, 5, 7}), more = drawn({1, 5}, some);
    EXPECT_TRUE(some.complete && more.complete);
    for (const auto& [x, y] : each_pixel(10, 10)) {
        const int tile = y / 4 * 3 + x / 4;
        const bool is_drawn = tile == 0 || tile == 5 || tile == 7;
        EXPECT_EQ(some.samples.at(x, y), is_drawn ? whole.samples.at(x, y) : 0U) << x << " " << y;
        EXPECT_EQ(some.illuminance_lx.mean.at(x, y), is_drawn ? whole.illuminance_lx.mean.at(x, y) : 0.0F) << x << " " << y;
        EXPECT_EQ(more.samples.at(x, y) > 0, is_drawn || tile == 1) << x << " " << y;
    }
    EXPECT_THROW(drawn({9}), std::invalid_argument);
    EXPECT_THROW(reference.render(moment, view, lux, {}, {}, {}, {}, {17, {}}), std::invalid_argument);
}

/// A lamp 2 m up at x = 0, a thin wall 1 m high at x = 4 across: its shadow ends at x = 8.
struct Wall {
    Scene scene = level_ground(30.0, lambert(0.2));
    Moment moment;

    Wall() {
        scene.materials.push_back(lambert(0.2, SurfaceKind::object));
        scene.meshes.push_back(quads("wall", 1, {4.0, 0.0, 0.0}, {{{0, 20, 0}, {0, -20, 0}, {0, -20, 1}, {0, 20, 1}}}));
        moment.lamps = {even_lamp(1000.0, looking({0, 0, 2}, 0, 0))};
    }
};

TEST(ReferenceDirect, EndsTheShadowWhereTheStraightLineOverTheEdgeMeetsTheGround) {
    const Wall wall;
    const View view = map_about({6.0, 0.0}, 4.0, 800); // 1 cm a pixel; x = 10 at the top
    const ReferenceImage image = Reference(wall.scene).render(wall.moment, view, lux, centre_rays());
    int last_dark = -1;
    for (int row = 799; row >= 0; --row) // from x = 2 ahead
        if (image.illuminance_lx.mean.at(400, row) == 0.0F)
            last_dark = row;
    EXPECT_NEAR(10.0 - (last_dark + 0.5) * 0.01, 8.0, 0.0051); // half a pixel
    EXPECT_GT(image.illuminance_lx.mean.at(400, 790), 0.0F);
    EXPECT_GT(image.illuminance_lx.mean.at(400, 650), 0.0F); // 3.5 m: before the wall
}

TEST(ReferenceDirect, WeighsAPixelThatAShadowsEdgeCrossesByItsLitPart) {
    const Wall wall;
    // One pixel from x = 7 to 8.5, y = -0.75 to 0.75: lit beyond 8. The same integral as under the lamp, over the lit rectangle.
    const View view = map_about({7.75, 0.0}, 0.75, 1);
    const auto corner = [](double x, double y) { return std::atan2(x * y, 2.0 * std::sqrt(4.0 + x * x + y * y)); };
    const double truth = 1000.0 * 2.0 * (corner(8.5, 0.75) - corner(8.0, 0.75)) / 2.25;
    const ReferenceImage image = Reference(wall.scene).render(wall.moment, view, lux, ReferenceSettings{});
    const double error = image.illuminance_lx.standard_error.at(0, 0);
    EXPECT_NEAR(image.illuminance_lx.mean.at(0, 0), truth, 5.0 * error);
    EXPECT_LE(error, 0.0051 * truth);
    EXPECT_GT(image.samples.at(0, 0), 16U);
    EXPECT_EQ(image.mixed.at(0, 0), shadow_edge);
}

TEST(ReferenceDirect, SpreadsTheShadowOfADiscLampOverItsPenumbra) {
    // From x on the ground the wall's upper edge cuts the disc (which stands upright, facing ahead) at the height 1 + (1/(x-4)) 4 above the
    // ground. A disc of radius 0.1 about 2 m: fully lit where the line is below 1.9, dark where above 2.1.
    const Wall wall;
    ReferenceSettings settings{.footprint = Footprint::centre, .lamp_radius_m = 0.1};
    View view = map_about({8.0, 0.0}, 1.0, 200);
    view.width_px = 1;
    view.map_left_m = view.map_right_m = 0.005;
    const ReferenceImage image = Reference(wall.scene).render(wall.moment, view, lux, settings);
    for (const double x : {7.55, 7.8, 8.0, 8.2, 8.6}) {
        const int row = static_cast<int>((9.0 - x) / 0.01 - 0.5);
        const double place = 9.0 - (row + 0.5) * 0.01, cut = std::clamp((1.0 + 4.0 / (place - 4.0) - 2.0) / 0.1, -1.0, 1.0);
        const double lit = (std::acos(cut) - cut * std::sqrt(1.0 - cut * cut)) / pi; // part of the disc above the cut
        const double e = 1000.0 * 2.0 / std::pow(4.0 + place * place, 1.5);
        // A disc of 0.1 m at 8 m: its points' distances and heights vary E by (0.1/2)^2 about the mean of what is seen, and linearly by up
        // to 5 %.
        EXPECT_NEAR(image.illuminance_lx.mean.at(0, row), lit * e, 0.055 * e) << place;
        if (lit > 0.0 && lit < 1.0) {
            EXPECT_GT(image.illuminance_lx.standard_error.at(0, row), 0.0F);
        }
    }
}

/// A rough road with a crest, a board, a box; textured, retroreflecting; two lamps and a sky.
Scene mixed_scene(glm::dvec3 origin) {
    Scene scene;
    Material road = lambert(0.08);
    road.retro_rl = 0.0145F;
    Material board = lambert(0.5, SurfaceKind::board);
    board.albedo = {0.6F, 0.1F, 0.1F};
    board.retro_rl = 180.0F;
    board.retro_reference_rad = 0.00576F;
    board.retro_falloff_rad = 0.0079F;
    board.emission_cdm2 = glm::vec3(0.5F);
    scene.materials = {road, board};
    Mesh ground{"ground", origin + glm::dvec3(40.0, 0.0, 0.0), {}, {}, {}};
    for (int i = -60; i < 110; i += 10) {
        const auto z = [](double x) { return 0.5 * std::sin(x / 20.0); };
        const double a = i, b = i + 10.0;
        add_quad(ground, {a, -30, z(a)}, {b, -30, z(b)}, {b, 30, z(b)}, {a, 30, z(a)});
    }
    scene.meshes = {
        finished(ground, 0), quads("board", 1, origin + glm::dvec3(35.0, -4.0, 2.0), {{{0, 1, -1}, {0, -1, -1}, {0, -1, 1}, {0, 1, 1}}}),
        quads("box", 1, origin + glm::dvec3(22.0, 1.5, -1.0),
              {{{0, 0.5, 0}, {0, -0.5, 0}, {0, -0.5, 2.2}, {0, 0.5, 2.2}}, {{1, 0.5, 0}, {0, 0.5, 0}, {0, 0.5, 2.2}, {1, 0.5, 2.2}}})};
    return scene;
}

class ReferenceAndTwin : public testing::TestWithParam<double> {};

TEST_P(ReferenceAndTwin, AgreeWhereNoLightBounces) {
    const glm::dvec3 origin(GetParam(), -GetParam() / 3.0, 300.0);
    const Scene scene = mixed_scene(origin);
    Moment moment{.ego = {origin, glm::dmat3(1.0)}};
    moment.daylight.horizontal_illuminance_lx = 0.3;
    for (const double side : {0.6, -0.6})
        moment.lamps.push_back(even_lamp(8000.0, looking(origin + glm::dvec3(3.5, side, 0.65), side, 0.5)));
    moment.lamps[0].colour.linear_srgb = {1.2, 0.95, 0.5};
    const View view = driver_view(96, 64);
    const ReferenceImage image = Reference(scene).render(moment, view, everything, centre_rays());
    const Twin twin(scene, true);
    int shadow_differs = 0, ids_differ = 0, dark = 0, lit = 0;
    for (const auto& [x, y] : each_pixel(view)) {
        const TwinPixel truth = twin.pixel(moment, view, x + 0.5, y + 0.5);
        if (truth.id != image.ids.at(x, y)) { // a float's rounding at the outline of a body
            ++ids_differ;
            continue;
        }
        // The twin's rays start 1 mm above the surface, these 0.05 mm: at a shadow's edge either may be right.
        const double e = image.illuminance_lx.mean.at(x, y), difference = std::abs(e - truth.illuminance_lx);
        if (difference > 1e-6 * truth.illuminance_lx) {
            ++shadow_differs;
            continue;
        }
        truth.illuminance_lx > 1.0 ? ++lit : ++dark;
        EXPECT_NEAR(image.luminance_cdm2.mean.at(x, y), truth.luminance_cdm2, 1e-6 * truth.luminance_cdm2) << x << " " << y;
    }
    EXPECT_LE(ids_differ, 3);
    EXPECT_LE(shadow_differs, 12); // 0.2 % of the picture
    EXPECT_GT(lit, 1000);
    EXPECT_GT(dark, 100);
}

INSTANTIATE_TEST_SUITE_P(FromTheMapsOrigin, ReferenceAndTwin, testing::Values(0.0, 4.5e6, 3e7));

TEST(ReferenceDirect, DoesNotLeakThroughTheSeamsOfAFineMesh) {
    // A ceiling of 200 x 200 slanted cells between a lamp and the ground: no sample may be lit.
    Scene scene = level_ground(20.0, lambert(0.2));
    scene.materials.push_back(lambert(0.2, SurfaceKind::object));
    Mesh ceiling{"ceiling", {0.013, 0.007, 2.0}, {}, {}, {}};
    const auto corner = [](int i, int k) { return glm::vec3(0.1 * i, 0.1 * k, 0.03 * std::sin(1.7 * i) * std::cos(2.3 * k)); };
    for (int k = -100; k <= 100; ++k)
        for (int i = -100; i <= 100; ++i)
            ceiling.vertices.push_back({corner(i, k), {0, 0, 1}, {0, 0}});
    for (std::uint32_t k = 0; k < 200; ++k)
        for (std::uint32_t i = 0; i < 200; ++i) {
            const std::uint32_t a = k * 201 + i, b = a + 1, c = a + 201, d = c + 1;
            for (const std::uint32_t v : {a, b, d, a, d, c})
                ceiling.indices.push_back(v);
        }
    scene.meshes.push_back(finished(ceiling, 1));
    Moment moment{.lamps = {even_lamp(1e6, looking({0, 0, 4}, 0, -90))}};
    const ReferenceImage image = Reference(scene).render(moment, map_about({0, 0}, 8.0, 100), lux, ReferenceSettings{.min_samples = 64});
    for (const float e : image.illuminance_lx.mean.pixels())
        ASSERT_EQ(e, 0.0F);
}

TEST(ReferenceDirect, LeavesOutWhatIsNotWantedAndRefusesNonsense) {
    const Wall wall;
    const Reference reference(wall.scene);
    const ReferenceImage image = reference.render(wall.moment, map_about({2, 0}, 1.0, 4), {.target = true}, centre_rays());
    EXPECT_TRUE(image.illuminance_lx.mean.empty() && image.luminance_cdm2.standard_error.empty());
    ASSERT_FALSE(image.target_lx.mean.empty());
    const double x = 2.25, y = 0.25, d2 = x * x + y * y + 1.75 * 1.75; // pixel (1, 1): lamp at 2 m, target at 0.25 m
    EXPECT_NEAR(image.target_lx.mean.at(1, 1), 1000.0 / d2, 1e-6 * 1000.0 / d2);
    ReferenceSettings settings{.target_error = 0.0};
    EXPECT_THROW(reference.render(wall.moment, map_about({2, 0}, 1.0, 4), lux, settings), std::invalid_argument);
}

// Smooth surfaces, by Whitted's recursion and by paths, against closed forms.

ReferenceSettings one_ray(Integrator integrator) {
    return {.integrator = integrator, .footprint = Footprint::centre, .target_error = 0.005};
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
    return {.materials = {lambert(0.5, SurfaceKind::object), mirror},
            .meshes = {
                quads("wall", 0, {4.0, 0.0, 0.0}, {{{0, 1, -1}, {0, -1, -1}, {0, -1, 1}, {0, 1, 1}}}),
                quads("mirror", 1, {0.0, 0.0, 0.0}, {{{-1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, -1, 1}}}) // faces +x -y
            }};
}

TEST(Whitted, AMirrorShowsTheWall) {
    for (const float share : {1.0F, 0.6F}) {
        const Scene scene = mirror_and_wall(smooth(share, 0.0F));
        Moment moment{.lamps = {even_lamp(900.0, looking({1.0, 0.0, 0.5}, 0, 0))}}; // shines on the wall, away from the mirror
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
    Material shining = lambert(0.0, SurfaceKind::object, 100.0);
    scene.materials = {smooth(0.0F, glass_index), shining};
    scene.meshes = {
        quads("slab", 0, {},
              {{{1.0, 2, -2}, {1.0, -2, -2}, {1.0, -2, 2}, {1.0, 2, 2}}, {{1.2, -2, -2}, {1.2, 2, -2}, {1.2, 2, 2}, {1.2, -2, 2}}}),
        quads("wall", 1, {3.0, 0.0, 0.0}, {{{0, 2, -2}, {0, -2, -2}, {0, -2, 2}, {0, 2, 2}}})};
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
        settings.max_smooth = 32;
        EXPECT_NEAR(reference.render({}, view, everything, settings).luminance_cdm2.mean.at(0, 0), truth, 1e-6 * truth);
        settings.max_smooth = 2; // straight through alone
        EXPECT_NEAR(reference.render({}, view, everything, settings).luminance_cdm2.mean.at(0, 0), 100.0 * (1.0 - f) * (1.0 - f), 1e-4);
        settings.max_smooth = 1;
        EXPECT_EQ(reference.render({}, view, everything, settings).luminance_cdm2.mean.at(0, 0), 0.0F);
        const ReferenceImage path = reference.render({}, view, everything, one_ray(Integrator::path));
        expect_estimate(path.luminance_cdm2, truth);
    }
}

TEST(Whitted, GlassInAnEvenRoomCannotBeSeen) {
    // Wherever light goes in a black room whose walls shine evenly, it comes from a wall: mirror and refraction keep energy.
    Material wall = lambert(0.0, SurfaceKind::object, 3.0);
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
    settings.max_smooth = 40;
    const ReferenceImage whitted = reference.render({}, view, everything, settings),
                         path = reference.render({}, view, everything, one_ray(Integrator::path));
    int through_glass = 0;
    for (const auto& [x, y] : each_pixel(8, 8)) {
        through_glass += whitted.ids.at(x, y) == 2;
        EXPECT_NEAR(whitted.luminance_cdm2.mean.at(x, y), 3.0, 3e-4); // 40 surfaces in a row keep less than 1e-4 within
        expect_estimate(path.luminance_cdm2, 3.0, 1e-4, x, y);
    }
    EXPECT_GT(through_glass, 8);
}

TEST(Whitted, IsDirectLightToTheBitWhereNothingIsSmooth) {
    const Scene scene = level_ground(20.0, lambert(0.3));
    Moment moment{.lamps = {even_lamp(1000.0, looking({0, 0, 1}, 0, -20))}};
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
