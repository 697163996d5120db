// Other vehicles' lamps and bodies, drawn: against double precision, against finer levels, over time, and as sources that are seen.
#include "renderer/traffic_levels.h"
#include "scenarios/lamps/lamp_file.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"
#include "tests/renderer/traffic_street.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace fernlicht {
namespace {

/// Off by rounding and by what the levels may be off, for each of two units; 25 m away and 8 m, where far more of them are at their ends.
TEST_F(Traffic, LightsTheSceneAsInDoublePrecision) {
    struct Row {
        double gap_m, every_m, min_lx, relative;
        const char* more;
    };
    constexpr const char* no_tails = ", tail_cd: 0, brake_cd: 0";
    for (const auto& [gap_m, every_m, least, relative, more] :
         {Row{40.0, 30.0, 0.05, 1e-5, ""}, Row{40.0, 30.0, 1e-6, 1e-5, ""}, Row{40.0, 30.0, 1.0, 1e-4, no_tails},
          Row{23.0, 8.0, 1e-4, 1e-4, no_tails}, Row{23.0, 8.0, 0.05, 1e-4, no_tails}, Row{23.0, 8.0, 1.0, 1e-4, no_tails}}) {
        SCOPED_TRACE(fmt::format("gap {} m, least {} lx", gap_m, least));
        const Street street(oncoming(gap_m, 2, every_m, more));
        Moment moment = street.at(0.5);
        moment.lamps.clear();
        moment.min_traffic_lx = least;
        RendererSettings s = settings();
        s.shadows.method = ShadowMethod::none;
        const View view = driver(48, 32);
        const Twin twin(street.scene, false, place_px_);
        const Frame frame = draw(street, moment, view, s);
        double brightest = 0.0;
        int others = 0;
        for (const auto& [x, y] : each_pixel(view)) {
            const TwinPixel pixel = twin.pixel(moment, view, x + 0.5, y + 0.5);
            if (pixel.id != frame.ids.at(x, y)) {
                ++others;
                continue;
            }
            const double off = std::abs(static_cast<double>(frame.illuminance_lx.at(x, y)) - pixel.illuminance_lx);
            EXPECT_LE(off, 2.0 * worst_traffic_error * least + 4.0 * pixel.bound_lx + relative * pixel.illuminance_lx + 1e-9)
                << x << " " << y;
            brightest = std::max(brightest, pixel.illuminance_lx);
        }
        EXPECT_GT(brightest, 5.0);
        EXPECT_LT(others, 4) << "edges";
    }
}

/// Against the reference's rays: the same where the twin finds no shadow, within what the levels may be off; and there are pixels in
/// shadow.
TEST_F(Traffic, AgreesWithTheReferenceWhereNoBodyShadows) {
    const Street street(oncoming(40.0, 3, 25.0));
    Moment moment = street.at(0.5);
    moment.lamps.clear();
    moment.min_traffic_lx = 0.01;
    const View view = driver(48, 32);
    ReferenceSettings rays{.footprint = Footprint::centre};
    const ReferenceImage truth = Reference(street.scene).render(moment, view, all_results, rays);
    const Frame frame = draw(street, moment, view, settings());
    const Twin shaded(street.scene, true), unshaded(street.scene, false);
    int compared = 0, in_shadow = 0;
    for (const auto& [x, y] : each_pixel(view)) {
        const TwinPixel with = shaded.pixel(moment, view, x + 0.5, y + 0.5), without = unshaded.pixel(moment, view, x + 0.5, y + 0.5);
        if (with.id == 0 || with.id != frame.ids.at(x, y) || with.id != truth.ids.at(x, y))
            continue;
        const double rays_lx = static_cast<double>(truth.illuminance_lx.mean.at(x, y));
        if (with.illuminance_lx != without.illuminance_lx) {
            in_shadow += without.illuminance_lx - rays_lx > moment.min_traffic_lx ? 1 : 0;
            continue;
        }
        ++compared;
        const double off = std::abs(static_cast<double>(frame.illuminance_lx.at(x, y)) - rays_lx);
        EXPECT_LE(off, 3.0 * worst_traffic_error * moment.min_traffic_lx + 4.0 * with.bound_lx + 1e-5 * rays_lx) << x << " " << y;
    }
    EXPECT_GT(compared, 100);
    EXPECT_GT(in_shadow, 0);
}

/// What levels cost in lux against every lamp with its own beam, and that they save lamps.
TEST_F(Traffic, LevelsStayWithinTheirBound) {
    const Street street(oncoming(30.0, 8, 40.0));
    Moment moment = street.at(0.3);
    moment.min_traffic_lx = 0.3;
    Renderer coarse(device_, street.scene, settings()), fine(device_, street.scene, without_levels());
    const Frame a = coarse.draw(moment, driver(), all_results), b = fine.draw(moment, driver(), all_results);
    const double worst = max_difference(a.illuminance_lx, b.illuminance_lx);
    EXPECT_GT(worst, 0.0) << "levels are in use";
    EXPECT_LE(worst, worst_traffic_error * moment.min_traffic_lx * 3.0) << "of at most three units that are drawn coarsely at one place";
    const Work coarsely = coarse.count(moment, driver(), all_results), finely = fine.count(moment, driver(), all_results);
    EXPECT_LT(coarsely.traffic_full, finely.traffic_full);
    EXPECT_GT(coarsely.traffic_merged, 0);
    EXPECT_GT(coarsely.traffic_by_vertex + coarsely.traffic_point, 0);
}

/// A car that comes nearer by 1 cm a frame changes no pixel by more than its light does and what the levels may be off.
TEST_F(Traffic, NothingPops) {
    const Street street(oncoming(90.0));
    Renderer renderer(device_, street.scene, settings()), fine(device_, street.scene, without_levels());
    Image<float> before, fine_before;
    double most = 0.0;
    for (int i = 0; i < 12; ++i) {
        Moment moment = street.at(0.0);
        for (LitLamp& lamp : moment.other_lamps)
            lamp.pose.position_m += 0.01 * i * lamp.pose.forward();
        const Frame frame = renderer.draw(moment, driver(), {.illuminance = true}),
                    exact = fine.draw(moment, driver(), {.illuminance = true});
        for (std::size_t k = 0; i > 0 && k < before.size(); ++k) {
            const auto change = [&](const Image<float>& now, const Image<float>& then) {
                return static_cast<double>(now.pixels()[k]) - static_cast<double>(then.pixels()[k]);
            };
            most = std::max(most, std::abs(change(frame.illuminance_lx, before) - change(exact.illuminance_lx, fine_before)));
        }
        before = frame.illuminance_lx;
        fine_before = exact.illuminance_lx;
    }
    EXPECT_LE(most, 0.05) << "the least lux";
}

/// The shipped drive at 5 ms a frame, 17 cm nearer: levels change no pixel by more than each pair's own least lux beside what its light
/// does.
TEST_F(Traffic, NothingPopsOnTheShippedDrive) {
    Drive drive = read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/oncoming.yaml");
    const RoadNetwork network = read_opendrive(drive.road_file);
    const Route route(network, drive.start, drive.via);
    place_traffic(drive, network, route);
    Scene scene = build_scene(network, {.textures = false});
    add_road_users(scene, drive.traffic, drive.opened);
    RendererSettings all = without_shadows(); // their edges move
    all.traffic_levels = false;
    Renderer renderer(device_, scene, without_shadows()), fine(device_, scene, all);
    double most = 0.0;
    int in_use = 0;
    for (const double from_s : {0.5, 2.0, 3.5}) {
        std::vector<double> before; // levels less each lamp by itself, per pixel
        Image<std::uint32_t> ids;
        for (int i = 0; i < 4; ++i) {
            const double time_s = from_s + 0.005 * i;
            Moment moment =
                moment_at({0, time_s, distance_m(drive.speed, 0.0), 0.0}, drive, route, drive.lamp_sets[0]); // the camera stands
            const Frame coarse = renderer.draw(moment, driver(), {.illuminance = true, .ids = true}),
                        exact = fine.draw(moment, driver(), {.illuminance = true});
            std::vector<double> apart;
            for (std::size_t k = 0; k < coarse.illuminance_lx.size(); ++k)
                apart.push_back(static_cast<double>(coarse.illuminance_lx.pixels()[k]) -
                                static_cast<double>(exact.illuminance_lx.pixels()[k]));
            for (std::size_t k = 0; k < before.size(); ++k)
                if (coarse.ids.pixels()[k] == ids.pixels()[k]) // nothing moved across it
                    most = std::max(most, std::abs(apart[k] - before[k]));
            in_use += std::ranges::any_of(apart, [](double d) { return d != 0.0; }) ? 1 : 0;
            before = std::move(apart);
            ids = coarse.ids;
        }
    }
    EXPECT_GT(in_use, 0);
    EXPECT_LE(most, drive.min_traffic_lx);
}

/// Integral of luminance over solid angle = I / d^2, from many pixels to a hundredth of one.
TEST_F(Traffic, ALampThatIsSeenBringsItsLightToTheEye) {
    for (const double gap_m : {18.0, 120.0, 600.0}) {
        const Street street(oncoming(gap_m, 1, 25.0, ", tail_cd: 0, brake_cd: 0"));
        Moment moment = street.at(0.0);
        moment.lamps.clear();
        moment.other_lamps.resize(1);
        const View view = driver(480, 320);
        Renderer renderer(device_, street.scene, settings());
        const Frame with = renderer.draw(moment, view, {.luminance = true});
        double expected = 0.0;
        const Camera camera = camera_of(moment, view);
        const glm::dvec3 eye_m = moment.ego.position_m + camera.eye_m, to = moment.other_lamps[0].pose.position_m - eye_m;
        expected = intensity_towards_cd(moment.other_lamps[0], eye_m) / glm::dot(to, to);
        moment.other_lamps[0].face_m = glm::dvec2(0.0);
        const Frame without = renderer.draw(moment, view, {.luminance = true});
        double seen = 0.0;
        const glm::dvec2 px = 2.0 * camera.half_extent / glm::dvec2(view.width_px, view.height_px);
        for (const auto& [x, y] : each_pixel(view)) {
            const double cosine = glm::dot(pixel_ray(camera, view, x + 0.5, y + 0.5).direction, camera.axis);
            seen += (static_cast<double>(with.luminance_cdm2.at(x, y)) - static_cast<double>(without.luminance_cdm2.at(x, y))) * px.x *
                    px.y * cosine * cosine * cosine;
        }
        EXPECT_GT(expected, 0.0) << gap_m;
        EXPECT_NEAR(seen / expected, 1.0, 2e-3) << gap_m << " m";
    }
}

TEST_F(Traffic, BodiesStandWhereTheyWouldStandAsPartOfTheWorld) {
    const Street street(oncoming(25.0, 2, 10.0));
    const Moment moment = street.at(0.4);
    const Frame moving = draw(street, moment, driver(), settings());
    const Scene posed = posed_scene(street.scene, moment.bodies);
    Renderer renderer(device_, posed, settings());
    const Frame fixed = renderer.draw(moment, driver(), all_results);
    std::size_t cars = 0, differ = 0;
    for (std::size_t i = 0; i < moving.ids.size(); ++i) {
        cars += moving.ids.pixels()[i] > street.scene.meshes.size() - 2 ? 1U : 0U;
        differ += moving.ids.pixels()[i] != fixed.ids.pixels()[i] ? 1U : 0U;
    }
    EXPECT_GT(cars, 200U);
    EXPECT_LE(differ, 3U);
    EXPECT_LT(max_difference(moving.depth_m, fixed.depth_m), 200.0) << "edges apart";
}

TEST_F(Traffic, NothingCompilesOnceItIsPrepared) {
    const Street street(oncoming(60.0, 5, 20.0));
    Renderer renderer(device_, street.scene, settings());
    renderer.prepare({street.at(0.0)}, driver(), all_results);
    const int compiled = renderer.compiled_programs();
    for (const double t : {0.0, 1.0, 2.0, 3.0})
        renderer.draw(street.at(t), driver(), all_results);
    EXPECT_EQ(renderer.compiled_programs(), compiled);
}

// How coarsely pairs of lamps are drawn: the error is bounded, by shares of levels and by what merging two beams does.

TEST(TrafficLevels, SharesAddUpToOneAndRunWithoutSteps) {
    for (const bool pair : {false, true})
        for (const bool interpolated : {false, true})
            for (double b = 0.0; b < 6.0; b += 0.01)
                for (double m = 0.0; m <= 6.0; m += 0.5) {
                    const TrafficShare s = traffic_share(b, m, 1.0, pair, interpolated),
                                       next = traffic_share(b + 0.01, m + 0.01, 1.0, pair, interpolated);
                    EXPECT_NEAR(s.each + s.merged + s.by_vertex + s.point, 1.0, 1e-12);
                    for (const double change :
                         {next.each - s.each, next.merged - s.merged, next.by_vertex - s.by_vertex, next.point - s.point})
                        EXPECT_LT(std::abs(change), 0.031) << b << " " << m;
                }
}

TEST(TrafficLevels, NoShareIsOffByMoreThanTheWorst) {
    double worst = 0.0;
    for (const bool pair : {false, true})
        for (const bool interpolated : {false, true})
            for (double b = 0.0; b < 20.0; b += 0.01)
                for (double m = 0.0; m <= (pair ? std::min(2.0 * b, 6.0) : 0.0); m += 0.02)
                    worst = std::max(worst, traffic_error_lx(traffic_share(b, m, 1.0, pair, interpolated), b, m, 1.0));
    EXPECT_LE(worst, worst_traffic_error + 1e-9);
    EXPECT_GT(worst, worst_traffic_error - 0.01) << "the bound is met";
}

double looked_up_cd(const BeamTexture& t, const glm::dvec3& w) {
    const glm::dvec2 angles(std::atan2(w.x, w.z), std::atan2(w.y, std::hypot(w.x, w.z)));
    const glm::dvec2 at = photometry::beam_position(angles, {t.h_first_rad, t.v_first_rad, 1.0 / t.h_step_rad, 1.0 / t.v_step_rad});
    if (photometry::beam_known(at, {t.width, t.height}) == 0.0)
        return 0.0;
    const glm::ivec2 base(std::min(static_cast<int>(at.x), t.width - 2), std::min(static_cast<int>(at.y), t.height - 2));
    const auto cd = [&](int x, int y) {
        return static_cast<double>(t.cd[static_cast<std::size_t>(y) * static_cast<std::size_t>(t.width) + static_cast<std::size_t>(x)]);
    };
    return photometry::bilinear(cd(base.x, base.y), cd(base.x + 1, base.y), cd(base.x, base.y + 1), cd(base.x + 1, base.y + 1),
                                at - glm::dvec2(base));
}

/// Random receivers before random pairs, in double: the bound holds for each, and is not far off for some.
TEST(TrafficLevels, MergingIsOffByNoMoreThanItsBound) {
    for (const char* name : {"halogen-low", "xenon-low"}) {
        const LampFile file = read_lamp(std::string(FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/") + name + ".ies");
        const BeamTexture texture = make_beam_texture(file.table);
        const TrafficBeam beam(texture);
        std::mt19937_64 random(7);
        const auto between = [&](double a, double b) { return a + (b - a) * std::uniform_real_distribution<double>()(random); };
        double worst = 0.0, min_share = 1.0;
        for (int i = 0; i < 200'000; ++i) {
            const double d = std::exp(between(std::log(4.0), std::log(400.0)));
            const double h = radians(between(-30.0, 30.0)), v = radians(i % 3 == 0 ? between(-12.0, 6.0) : between(-2.0, 0.5));
            const glm::dvec3 at = d * glm::dvec3(std::sin(h) * std::cos(v), std::sin(v), std::cos(h) * std::cos(v));
            const glm::dvec3 half(between(0.05, 0.9), between(-0.05, 0.05), between(-0.05, 0.05));
            glm::dvec3 n = glm::normalize(glm::dvec3(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)));
            if (glm::dot(n, at) > 0.0)
                n = -n;
            const auto lx = [&](const glm::dvec3& from, double factor) {
                const glm::dvec3 to = at - from;
                const double r = glm::length(to);
                return factor * looked_up_cd(texture, to) * std::max(0.0, -glm::dot(n, to) / r) / (r * r);
            };
            const double off = std::abs(lx(half, 0.5) + lx(-half, 0.5) - lx({}, 1.0));
            const double near = d - glm::length(half), lx_a_cd = 1.0 / (near * near);
            const BeamWindow window{h, h, v, v};
            // E_midway <= max_lx must hold, and does for the brightest direction between the lamps.
            const double a = glm::length(half) / near, most = lx_a_cd * beam.max_cd({h - 1.5 * a, h + 1.5 * a, v - a, v + a});
            const double bound = beam.merging_lx(glm::length(half) / near, std::abs(half.y) / near, window, lx_a_cd, most);
            EXPECT_LE(off, bound * (1.0 + 1e-9) + 1e-12) << name << " " << d << " m, " << h << " " << v;
            worst = std::max(worst, off > 0.0 ? off / bound : 0.0);
            min_share = std::min(min_share, most > 0.0 ? bound / most : 1.0);
        }
        EXPECT_GT(worst, 0.2) << "the bound is of the error's size";
        EXPECT_LT(min_share, 0.05) << "and far lamps merge";
    }
}

TEST(TrafficLevels, NothingIsBrighterThanTheMostOfItsWindow) {
    const LampFile file = read_lamp(FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/halogen-low.ies");
    const BeamTexture texture = make_beam_texture(file.table);
    const TrafficBeam beam(texture);
    EXPECT_NEAR(beam.max_cd() / static_cast<double>(*std::ranges::max_element(texture.cd)), 1.0, 1e-7);
    std::mt19937_64 random(3);
    const auto between = [&](double a, double b) { return a + (b - a) * std::uniform_real_distribution<double>()(random); };
    for (int i = 0; i < 20'000; ++i) {
        const double h = radians(between(-60.0, 60.0)), v = radians(between(-20.0, 20.0)), size = radians(between(0.0, 3.0));
        const double inside_h = h + between(0.0, size), inside_v = v + between(0.0, size);
        const glm::dvec3 w(std::sin(inside_h) * std::cos(inside_v), std::sin(inside_v), std::cos(inside_h) * std::cos(inside_v));
        EXPECT_LE(looked_up_cd(texture, w), beam.max_cd({h, h + size, v, v + size}) * (1.0 + 1e-9));
    }
}

} // namespace

} // namespace fernlicht
