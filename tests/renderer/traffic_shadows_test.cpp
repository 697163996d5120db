// Shadows of other vehicles and of street lamps, against the twin's and the reference's rays.
#include "tests/renderer/traffic_street.h"

namespace fernlicht {
namespace {

/// Least and most of what is hidden up to so many pixels around one.
template <class Hidden> std::pair<double, double> range_around(int x, int y, int pixels, const Hidden& hidden) {
    double least = 2.0, most = -2.0;
    for (int v = y - pixels; v <= y + pixels; ++v)
        for (int u = x - pixels; u <= x + pixels; ++u) {
            least = std::min(least, hidden(u, v));
            most = std::max(most, hidden(u, v));
        }
    return {least, most};
}

/// Two cars behind each other, the second's lamps behind the first's body: drawn against the twin's rays, away from edges (where all twin
/// pixels around see as much of the lamps), within what levels and the ramp of shadows may be off. What the twin lights is not darkened: no
/// surface shades itself.
TEST_F(Traffic, CastsShadowsAsTheTwinsRays) {
    const Street street(oncoming(30.0, 2, 14.0));
    Moment moment = street.at(0.5);
    moment.lamps.clear();
    std::erase_if(moment.other_lamps, [](const LitLamp& lamp) { return lamp.body == 0; });
    moment.min_traffic_lx = 0.005;
    const View view = driver(96, 64, 24.0);
    const Frame frame = draw(street, moment, view, settings());
    const Frame bright = draw(street, moment, view, without_shadows());
    const Twin shaded(street.scene, true), unshaded(street.scene, false);
    Image<double> hidden(view.width_px, view.height_px), lx(view.width_px, view.height_px), bound(view.width_px, view.height_px);
    for (const auto& [x, y] : each_pixel(view)) {
        const TwinPixel with = shaded.pixel(moment, view, x + 0.5, y + 0.5), without = unshaded.pixel(moment, view, x + 0.5, y + 0.5);
        const bool same = with.id != 0 && with.id == frame.ids.at(x, y);
        hidden.at(x, y) = !same ? -1.0 : without.illuminance_lx > 0.0 ? 1.0 - with.illuminance_lx / without.illuminance_lx : 0.0;
        lx.at(x, y) = with.illuminance_lx;
        bound.at(x, y) = with.bound_lx;
    }
    int compared = 0, in_shadow = 0, wrong = 0, wrong_before = 0;
    const double allowed = (worst_traffic_error + 2.0) * moment.min_traffic_lx;
    for (const auto& [x, y] : each_pixel(view, 2)) {
        const auto [least, most] = range_around(x, y, 2, [&](int u, int v) { return hidden.at(u, v); });
        if (least < 0.0 || most - least > 0.1)
            continue;
        ++compared;
        const auto is_off = [&, u = x, v = y](const Frame& f) {
            return std::abs(static_cast<double>(f.illuminance_lx.at(u, v)) - lx.at(u, v)) >
                   allowed + 4.0 * bound.at(u, v) + 0.02 * lx.at(u, v);
        };
        in_shadow += least > 0.1 ? 1 : 0;
        wrong += is_off(frame) ? 1 : 0;
        wrong_before += is_off(bright) ? 1 : 0;
    }
    EXPECT_GT(compared, 1000);
    EXPECT_GT(in_shadow, 100);
    EXPECT_GT(wrong_before, 100) << "without maps";
    EXPECT_LE(wrong, in_shadow / 100);
}

/// The village's lamps, which hang over cars that are parked, against the reference by the ray through each pixel's centre.
TEST_F(Traffic, CastsShadowsOfStreetLampsAsTheReferencesRays) {
    Drive drive = read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/village-lit.yaml");
    const RoadNetwork network = read_opendrive(drive.road_file);
    const Route route(network, drive.start, drive.via);
    const Scene scene = staged_scene(drive, network, route);
    Moment moment = moment_at({0, 2.0, distance_m(drive.speed, 2.0), 13.9}, drive, route, drive.lamp_sets[0]);
    moment.lamps.clear();
    const View view = driver(240, 160, 40.0);
    Renderer renderer(device_, scene, settings());
    const Frame frame = renderer.draw(moment, view, all_results);
    Renderer without(device_, scene, without_shadows());
    const Frame lit = without.draw(moment, view, all_results);
    ReferenceSettings rays, through;
    rays.footprint = through.footprint = Footprint::centre;
    through.shadows = false;
    const Reference reference(scene);
    const ReferenceImage dark = reference.render(moment, view, all_results, rays),
                         bright = reference.render(moment, view, all_results, through);
    const auto hidden = [&](int x, int y) {
        const double with = static_cast<double>(dark.illuminance_lx.mean.at(x, y)),
                     all = static_cast<double>(bright.illuminance_lx.mean.at(x, y));
        return dark.ids.at(x, y) == 0 || dark.ids.at(x, y) != frame.ids.at(x, y) ? -1.0 : all > 0.0 ? 1.0 - with / all : 0.0;
    };
    int compared = 0, in_shadow = 0, off = 0, off_before = 0;
    for (const auto& [x, y] : each_pixel(view, 1)) {
        const auto [least, most] = range_around(x, y, 1, hidden);
        const double truth = static_cast<double>(dark.illuminance_lx.mean.at(x, y));
        if (least < 0.0 || most - least > 0.1 || truth < 0.02)
            continue;
        ++compared;
        in_shadow += least > 0.05 ? 1 : 0;
        const auto is_off = [&, u = x, v = y](const Frame& f) {
            return std::abs(static_cast<double>(f.illuminance_lx.at(u, v)) - truth) > 0.05 * truth + 0.1;
        };
        off += is_off(frame) ? 1 : 0;
        off_before += is_off(lit) ? 1 : 0;
    }
    EXPECT_GT(compared, 3000);
    EXPECT_GT(in_shadow, 100);
    EXPECT_GT(off_before, 100) << "without maps";
    EXPECT_LE(off, off_before / 20);
}

/// Lamps in bodies, on and below the road, in one place, far away and far too bright: numbers everywhere, and pruning changes no byte.
TEST_F(Traffic, ShadowsStandHardPlaces) {
    const Street street(oncoming(30.0, 3, 14.0));
    Renderer pruned(device_, street.scene, settings()), unpruned(device_, street.scene, settings("photometric-unpruned"));
    const Moment before = street.at(0.5);
    const glm::dvec3 ahead = before.other_lamps[0].pose.forward();
    const View view = driver(60, 40);
    for (const auto& [forward_m, up_m, factor] : {std::tuple(-2.0, 0.0, 1.0), std::tuple(-14.0, 0.3, 1e8), std::tuple(0.0, -0.65, 1.0),
                                                  std::tuple(0.0, -3.0, 1e8), std::tuple(-1e9, 0.0, 1e8), std::tuple(8.0, 0.0, 1e-38)})
        for (const double min_lx : {1e-9, 0.05, 100.0}) {
            Moment moment = before;
            moment.min_traffic_lx = min_lx;
            for (LitLamp& lamp : moment.other_lamps) {
                lamp.pose.position_m += forward_m * ahead + glm::dvec3(0.0, 0.0, up_m);
                lamp.intensity_factor *= factor;
            }
            const Frame a = pruned.draw(moment, view, all_results), b = unpruned.draw(moment, view, all_results);
            EXPECT_EQ(a.illuminance_lx, b.illuminance_lx) << forward_m << " " << up_m << " " << min_lx;
            EXPECT_TRUE(std::ranges::all_of(a.illuminance_lx.pixels(), [](float lx) { return std::isfinite(lx) && lx >= 0.0F; }))
                << forward_m << " " << up_m << " " << min_lx;
        }
}

/// Without lamps of others, and in a drive without shadows, no byte and no program more.
TEST_F(Traffic, ShadowsOfOthersCostNothingWhereThereAreNone) {
    const Street street(oncoming(30.0, 2, 14.0));
    for (const bool dark : {true, false}) {
        Moment moment = street.at(0.5);
        RendererSettings with = settings();
        if (dark)
            moment.other_lamps.clear();
        else
            with.shadows.method = ShadowMethod::none;
        RendererSettings without = with;
        without.traffic_shadows = false;
        const auto drawn = [&](const RendererSettings& by) {
            Renderer renderer(device_, street.scene, by);
            renderer.prepare({moment}, driver(), all_results);
            Frame frame = renderer.draw(moment, driver(), all_results);
            return std::tuple(std::move(frame), renderer.compiled_programs(), renderer.count(moment, driver(), all_results));
        };
        const auto [one, programs, work] = drawn(with);
        const auto [other, other_programs, other_work] = drawn(without);
        EXPECT_EQ(std::tuple(one.colour, one.illuminance_lx), std::tuple(other.colour, other.illuminance_lx));
        EXPECT_EQ(programs, other_programs);
        EXPECT_EQ(work, other_work);
    }
}

/// Maps go to the pairs with most light on what may be in shadow; what is faint has none.
TEST_F(Traffic, TheStrongestLampsHaveMaps) {
    const Street street(oncoming(30.0, 12, 14.0, ", tail_cd: 0, brake_cd: 0"));
    Renderer renderer(device_, street.scene, settings()), without(device_, street.scene, without_shadows());
    const auto maps = [&](const Moment& moment) { return renderer.count(moment, driver(), {.illuminance = true}).shadow_maps; };
    const auto shadow_lx = [&](const Moment& moment) { // most that is taken away anywhere
        return max_difference(renderer.draw(moment, driver(), {.illuminance = true}).illuminance_lx,
                              without.draw(moment, driver(), {.illuminance = true}).illuminance_lx);
    };
    Moment moment = street.at(0.0);
    moment.lamps.clear();
    ASSERT_EQ(moment.other_lamps.size(), 24U);
    EXPECT_EQ(maps(moment), 16) << "as many as there are";
    const std::vector<PrunedFeature> pruned = renderer.pruned();
    EXPECT_TRUE(std::ranges::any_of(pruned, [](const PrunedFeature& l) { return l.what.starts_with("shadow maps of other lamps"); }));
    const double all_lx = shadow_lx(moment);
    EXPECT_GT(all_lx, 1.0);
    for (std::size_t i = 6; i < moment.other_lamps.size(); ++i) // of the cars behind the third
        moment.other_lamps[i].intensity_factor *= 1e-5;
    EXPECT_EQ(maps(moment), 4) << "nothing stands before the first car";
    EXPECT_NEAR(shadow_lx(moment), all_lx, 0.5 * all_lx);
    for (LitLamp& lamp : moment.other_lamps)
        lamp.intensity_factor = 1e-5;
    EXPECT_EQ(maps(moment), 0);
    EXPECT_EQ(shadow_lx(moment), 0.0);
}

/// Eleven pairs and maps for eight: as the car, not the camera, moves on, they gain and lose them. All light that shadows take away from
/// the picture changes steadily.
TEST_F(Traffic, ShadowsDoNotPop) {
    const Street street(oncoming(25.0, 11, 14.0, ", tail_cd: 0, brake_cd: 0"));
    Renderer renderer(device_, street.scene, settings()), without(device_, street.scene, without_shadows());
    double before = 0.0, most = 0.0;
    for (int i = 0; i < 16; ++i) {
        Moment moment = street.at(0.0);
        moment.lamps.clear();
        moment.ego.position_m += 0.25 * i * moment.ego.forward();
        View view = driver(120, 80);
        view.position_m.x -= 0.25 * i; // the camera stands
        const Frame dark = renderer.draw(moment, view, {.illuminance = true}), bright = without.draw(moment, view, {.illuminance = true});
        double taken = 0.0;
        for (std::size_t k = 0; k < dark.illuminance_lx.size(); ++k)
            taken += static_cast<double>(bright.illuminance_lx.pixels()[k]) - static_cast<double>(dark.illuminance_lx.pixels()[k]);
        if (i > 0)
            most = std::max(most, std::abs(taken - before) / before);
        before = taken;
    }
    EXPECT_GT(before, 0.0);
    EXPECT_LE(most, 0.05);
}

/// Twelve pairs and maps for eight. The bound on the light whose shadows may be missing stands in the report where it says something:
/// bodies that stand 60 m from each other's lamps get little, those next to another's lamps may get any light.
TEST_F(Traffic, ReportsTheBoundOfMissingShadowsWhereItIsOfUse) {
    const auto reason = [&](double every_m) {
        const Street street(oncoming(25.0, 12, every_m));
        Renderer renderer(device_, street.scene, settings());
        renderer.draw(street.at(0.0), driver(120, 80), {.illuminance = true});
        for (const PrunedFeature& one : renderer.pruned())
            if (one.what.starts_with("shadow maps of other lamps: those of up to"))
                return one.why;
        return std::string("none");
    };
    const std::string apart = reason(60.0), close = reason(6.0);
    const std::string before = "by bounds the rest bring at most ";
    ASSERT_NE(apart.find(before), std::string::npos) << apart;
    const double lx = std::stod(apart.substr(apart.find(before) + before.size()));
    EXPECT_GT(lx, 0.0);
    EXPECT_LT(lx, 1000.0);
    EXPECT_NE(close.find("no useful bound is known of other lamps' light whose shadows may be missing: one of them stands"),
              std::string::npos)
        << close;
}

} // namespace
} // namespace fernlicht
