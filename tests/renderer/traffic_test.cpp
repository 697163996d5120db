// Other vehicles' lamps and bodies, drawn: against double precision, against finer levels, over time, and as sources that are seen.
#include "tests/renderer/traffic_street.h"

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
        const Twin twin(street.scene, false);
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

} // namespace
} // namespace fernlicht
