// Light that bounces, against closed forms: energy is conserved, each way that light takes is counted once.
#include "tests/renderer/reference/rooms.h"

#include "renderer/reference/sampling.h"
#include "renderer/reference/surface_response.h"

namespace fernlicht {
namespace {

double hypotenuse(double a, double b) { return std::hypot(a, b); }

ReferenceSettings paths(double target_error, Footprint footprint = Footprint::pixel) {
    return {.integrator = Integrator::path, .footprint = footprint, .target_error = target_error};
}

/// View factor from a small element, parallel, to a rectangle a x b at height c above it, one of whose corners is above the element
/// (Howell's catalogue, B-3).
double corner_factor(double a, double b, double c) {
    const double x = a / c, y = b / c, rx = std::sqrt(1.0 + x * x), ry = std::sqrt(1.0 + y * y);
    return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2.0 * pi);
}

TEST(ReferencePath, KeepsEnergyInAWhiteClosedRoom) {
    for (const double albedo : {0.0, 0.5, 0.9}) {
        Material wall = lambert(albedo, SurfaceKind::road, 3.0);
        const Scene scene = closed_room(wall);
        const double truth = 3.0 / (1.0 - static_cast<double>(wall.albedo.x)); // L = Le + rho L
        ReferenceSettings settings = paths(0.005);
        settings.max_samples = 1 << 16;
        const ReferenceImage image = Reference(scene).render({}, camera({0.2, 0.1, -0.3}, 20, 10, 60, 3), everything, settings);
        for (const auto& [x, y] : each_pixel(3, 3)) {
            expect_estimate(image.luminance_cdm2, truth, 1e-6, x, y);
            expect_estimate(image.illuminance_lx, pi * truth, 1e-6, x, y);
            EXPECT_LE(image.luminance_cdm2.standard_error.at(x, y), 0.005 * truth * 1.05);
        }
    }
}

TEST(ReferencePath, ColoursTheWhiteRoomChannelByChannel) {
    Material wall = lambert(0.0);
    wall.albedo = {0.8F, 0.5F, 0.2F};
    wall.emission_cdm2 = {1.0F, 2.0F, 4.0F};
    const Scene scene = closed_room(wall);
    const double truth = 0.2126 * 1.0 / (1.0 - 0.8) + 0.7152 * 2.0 / (1.0 - 0.5) + 0.0722 * 4.0 / (1.0 - 0.2);
    const ReferenceImage image = Reference(scene).render({}, camera({0, 0, 0}, 20, 10, 60, 1), everything, paths(0.002));
    expect_estimate(image.luminance_cdm2, truth, 1e-5);
}

TEST(ReferencePath, RetroreflectionMakesNoEnergyHoweverStrong) {
    // In a room of uniform luminance a lobe that returns at most sG adds at most what an albedo of sG would, and a narrow one nearly that.
    for (const auto& [rl, falloff] : {std::pair(20.0F, 0.02F), std::pair(200.0F, 0.1F)}) {
        Material wall = lambert(0.3, SurfaceKind::road, 1.0);
        wall.retro_rl = rl;
        wall.retro_reference_rad = 0.0F;
        wall.retro_falloff_rad = falloff;
        const Scene scene = closed_room(wall);
        const double k = 1.0 / static_cast<double>(falloff),
                     returned = std::min(0.7, 2.0 * pi * static_cast<double>(rl) * (1.0 + std::exp(-k * pi)) / (1.0 + k * k));
        const ReferenceImage image = Reference(scene).render({}, camera({0, 0, 0}, 0, 0, 20, 1), everything, paths(0.005));
        const double l = image.luminance_cdm2.mean.at(0, 0), error = image.luminance_cdm2.standard_error.at(0, 0);
        EXPECT_GT(l, 1.0 / 0.7 + 5.0 * error); // it does return something
        if (returned < 0.6) {                  // 1 % of grazing light is lost over a lobe of 0.02 rad: integral of 2 falloff / cos
            EXPECT_NEAR(l, 1.0 / (0.7 - returned), 5.0 * error + 0.02 * l);
            EXPECT_LE(l, 1.0 / (0.7 - returned) + 5.0 * error);
        } else { // s holds it at the albedo's complement: without loss the room would grow without bound
            EXPECT_TRUE(std::isfinite(l));
        }
    }
}

TEST(ReferencePath, RetroLobeIsReciprocalAndReturnsNoMoreThanItSays) {
    const reference::SurfaceResponse response{glm::dvec3(0.4), 900.0, 0.005, 1.0 / 0.05, glm::dvec3(0.0)};
    const reference::RetroLobe lobe = reference::retro_lobe(response, 0.4);
    EXPECT_NEAR(lobe.returned, 0.6, 1e-12); // G is far above
    const double ci = 0.3, co = 0.8, angle = 0.1;
    EXPECT_NEAR(reference::retro_times_cosine(lobe, angle, ci, co) / ci, reference::retro_times_cosine(lobe, angle, co, ci) / co, 1e-12);
    // The mean weight of samples is the share of light that returns: at most s G, from any side, also at grazing angles.
    for (const double tilt_deg : {0.0, 60.0, 85.0, 89.5}) {
        const glm::dvec3 normal{0.0, 0.0, 1.0}, out{std::sin(radians(tilt_deg)), 0.0, std::cos(radians(tilt_deg))};
        double sum = 0.0;
        const reference::PointNet net(7);
        for (std::uint32_t i = 0; i < 65536; ++i)
            sum += reference::sample_retro(lobe, out, normal, net.point(i, 0), net.point(i, 1).x).weight / 65536.0;
        EXPECT_LE(sum, lobe.returned * 1.001) << tilt_deg; // 1/256^2 samples
        if (tilt_deg == 0.0) {
            EXPECT_NEAR(sum, lobe.returned, 0.01 * lobe.returned); // the lobe's own width: cos is 1 - falloff^2 in the mean
        }
    }
}

TEST(ReferencePath, PlatesThatFaceEachOtherExchangeTheViewFactor) {
    const Scene scene = plates(0.0, 0.0, 100.0);
    const Reference reference(scene);
    EXPECT_NEAR(plates_factor, 0.19982, 1e-5); // the tabulated value
    const ReferenceImage whole = reference.render({}, map_about({0, 0}, 0.5, 1), lux, paths(0.002));
    expect_estimate(whole.illuminance_lx, pi * 100.0 * plates_factor);
    ReferenceSettings settings = paths(0.002, Footprint::centre);
    const ReferenceImage middle = reference.render({}, map_about({0, 0}, 0.5, 1), lux, settings);
    expect_estimate(middle.illuminance_lx, pi * 100.0 * 4.0 * corner_factor(0.5, 0.5, 1.0));
    const ReferenceImage edge = reference.render({}, map_about({0.2, 0.1}, 0.1, 1), lux, settings); // element at (0.2, 0.1)
    expect_estimate(edge.illuminance_lx, pi * 100.0 *
                                             (corner_factor(0.7, 0.6, 1.0) + corner_factor(0.7, 0.4, 1.0) + corner_factor(0.3, 0.6, 1.0) +
                                              corner_factor(0.3, 0.4, 1.0)));
}

TEST(ReferencePath, APlateHidesItsShareOfTheSky) {
    const Scene scene = hidden_sky(100.0);
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = 40.0;
    ReferenceSettings settings = paths(0.002, Footprint::centre);
    const ReferenceImage image = Reference(scene).render(moment, map_about({0, 0}, 0.5, 1), lux, settings);
    expect_estimate(image.illuminance_lx, 40.0 * (1.0 - 4.0 * corner_factor(1.0, 1.0, 2.0)));
    settings.integrator = Integrator::direct; // there nothing hides the sky
    EXPECT_FLOAT_EQ(Reference(scene).render(moment, map_about({0, 0}, 0.5, 1), lux, settings).illuminance_lx.mean.at(0, 0), 40.0F);
}

/// A sphere of `rows` x 2 `rows` flat cells, seen from within; its corners lie on the radius that gives it the area 4 pi.
Scene round_room(const Material& material, int rows) {
    std::vector<std::array<glm::dvec3, 4>> cells;
    const auto at = [&](int i, int k) {
        const double v = pi * i / rows, h = pi * k / rows;
        return glm::dvec3(std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), std::cos(v));
    };
    double area = 0.0;
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < 2 * rows; ++k) {
            const std::array<glm::dvec3, 4> c{at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)};
            area += 0.5 * glm::length(glm::cross(c[2] - c[0], c[3] - c[1]));
            cells.push_back(c);
        }
    const double radius = std::sqrt(4.0 * pi / area);
    Mesh room{"sphere", {}, {}, {}, {}};
    for (const auto& c : cells) {
        const glm::dvec3 middle = 0.25 * (c[0] + c[1] + c[2] + c[3]);
        const auto first = static_cast<std::uint32_t>(room.vertices.size());
        for (const glm::dvec3& p : c)
            room.vertices.push_back({glm::vec3(p * radius), glm::vec3(-glm::normalize(middle)), {0, 0}});
        for (const std::uint32_t j : {0U, 1U, 2U, 0U, 2U, 3U})
            room.indices.push_back(first + j);
    }
    return Scene{.materials = {material}, .meshes = {finished(room, 0)}};
}

TEST(ReferencePath, AnIntegratingSphereSpreadsALampsLightEvenly) {
    // Whatever the lamp's beam, light that has bounced is the same everywhere: E = rho flux / (4 pi r^2 (1 - rho)). The lamp's flux
    // is 2 pi I: a lamp shines into the half-space before it.
    const Scene scene = round_room(lambert(0.7), 64);
    Moment moment{.lamps = {even_lamp(10.0, looking({0.3, -0.2, 0.1}, 40, 30))}};
    const Reference reference(scene);
    const View view = camera({0, 0, 0}, 0, 0, 50, 3);
    ReferenceSettings settings = paths(0.005);
    const ReferenceImage all = reference.render(moment, view, lux, settings);
    settings.integrator = Integrator::direct;
    settings.target_error = 0.001;
    const ReferenceImage direct = reference.render(moment, view, lux, settings);
    const double rho = static_cast<double>(0.7F), truth = rho * 2.0 * pi * 10.0 / (4.0 * pi * (1.0 - rho));
    for (const auto& [x, y] : each_pixel(3, 3)) {
        const double bounced = all.illuminance_lx.mean.at(x, y) - direct.illuminance_lx.mean.at(x, y),
                     error = std::hypot(all.illuminance_lx.standard_error.at(x, y), direct.illuminance_lx.standard_error.at(x, y));
        EXPECT_NEAR(bounced, truth, 5.0 * error + 0.002 * truth); // flat cells of 2.8 degrees: (pi / 64)^2
    }
}

TEST(ReferencePath, LightThatABoardSendsBackIsCountedOnce) {
    // A black screen about the lamp, facing a retroreflecting board 4 m ahead. The screen gets no light from the lamp itself; what it gets
    // is the integral over the board of f cos cos I / (d^2 d'^2), here by the midpoint rule on 400 x 400 cells (error below 1e-4).
    Scene scene;
    Material board = lambert(0.1, SurfaceKind::board);
    board.retro_rl = 8.0F;
    board.retro_reference_rad = 0.0F;
    board.retro_falloff_rad = 0.05F;
    scene.materials = {lambert(0.0, SurfaceKind::object), board};
    scene.meshes = {quads("screen", 0, {}, {{{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}}}),
                    quads("board", 1, {4.0, 0.0, 0.0}, {{{0, 1, -1}, {0, -1, -1}, {0, -1, 1}, {0, 1, 1}}})};
    const glm::dvec3 lamp_m{0.1, 0.0, 0.0}, place{0.0, 0.25, 0.0};
    Moment moment{.lamps = {even_lamp(1000.0, looking(lamp_m, 0, 0))}};
    View view = camera({1.0, 0.25, 0.0}, 180, 0, 1, 1);
    ReferenceSettings settings = paths(0.005, Footprint::centre);
    settings.max_samples = 1 << 16;
    const ReferenceImage image = Reference(scene).render(moment, view, lux, settings);
    const double rho = static_cast<double>(0.1F), k = 1.0 / static_cast<double>(0.05F);
    double truth = 0.0;
    for (int i = 0; i < 400; ++i)
        for (int j = 0; j < 400; ++j) {
            const glm::dvec3 p{4.0, (i + 0.5) / 200.0 - 1.0, (j + 0.5) / 200.0 - 1.0}, to_lamp = lamp_m - p, to_place = place - p;
            const double d = glm::length(to_lamp), e = glm::length(to_place), ci = -to_lamp.x / d, co = -to_place.x / e,
                         angle = std::acos(std::min(1.0, glm::dot(to_lamp, to_place) / (d * e)));
            const double f = rho / pi + 8.0 * std::exp(-k * angle) / std::max(ci, co); // 2 pi 8 / (1 + k^2) = 0.125: s is 1
            truth += f * ci * co * co * 1000.0 / (d * d * e * e) * (4.0 / 160000.0);
        }
    expect_estimate(image.illuminance_lx, truth);
    EXPECT_LE(image.illuminance_lx.standard_error.at(0, 0), 0.0051 * truth);
    EXPECT_EQ(image.ids.at(0, 0), 1U);
}

TEST(ReferencePath, IsDirectLightWhereNothingReflects) {
    Scene scene = level_ground(20.0, lambert(0.0));
    Moment moment{.lamps = {even_lamp(1000.0, looking({0, 0, 1}, 0, -20))}};
    const Reference reference(scene);
    ReferenceSettings settings = paths(0.01);
    const ReferenceImage path = reference.render(moment, map_about({3, 0}, 2.0, 8), lux, settings);
    settings.integrator = Integrator::direct;
    const ReferenceImage direct = reference.render(moment, map_about({3, 0}, 2.0, 8), lux, settings);
    for (const auto& [x, y] : each_pixel(8, 8))
        EXPECT_NEAR(path.illuminance_lx.mean.at(x, y), direct.illuminance_lx.mean.at(x, y),
                    5.0 * hypotenuse(path.illuminance_lx.standard_error.at(x, y), direct.illuminance_lx.standard_error.at(x, y)) + 1e-6);
}

} // namespace
} // namespace fernlicht
