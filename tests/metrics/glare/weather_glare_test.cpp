// Light of lamps through fog and by way of a wet road, against the laws worked out by hand.
#include "metrics/glare/wet_road.h"
#include "metrics/seeing/visibility.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "tests/lamps.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

LitLamp lamp_at(const glm::dvec3& position_m, CandelaTable table) {
    return {"lamp", tests::file_of(std::move(table)), {position_m, axes_from_angles(0.0, 0.0, 0.0)}, 1.0, {}, 0.0};
}

Moment with_weather(const Weather& weather, CandelaTable table = tests::even_table(1000.0)) {
    Moment moment;
    moment.lamps = {lamp_at({0.0, 0.0, 0.65}, std::move(table))};
    moment.weather = weather;
    return moment;
}

const glm::dvec3 eye(50.0, 3.5, 1.1);
const RoadPlane level{};

/// Of unpolarised light on water, n = 1.333, by Snell's angle.
double fresnel(double incidence_rad) {
    const double refracted = std::asin(std::sin(incidence_rad) / 1.333), c = std::cos(incidence_rad), t = std::cos(refracted);
    return 0.5 * (std::pow((c - 1.333 * t) / (c + 1.333 * t), 2) + std::pow((1.333 * c - t) / (1.333 * c + t), 2));
}

double sum_lx(const std::vector<SeenLamp>& patches) { return facing_lx(patches); }

TEST(WeatherGlare, AnEyeLosesWhatTheFogTakesOnTheWay) {
    const double square = 2500.0 + 3.5 * 3.5 + 0.45 * 0.45, sigma = 2.996 / 100.0;
    const double left = std::exp(-sigma * std::sqrt(square)); // 22 %
    EXPECT_NEAR(facing_lx(seen_lamps(with_weather({sigma}), eye)), left * 1000.0 / square, 1e-12);
    EXPECT_EQ(facing_lx(seen_lamps(with_weather({}), eye)), 1000.0 / square);
    Moment oncoming = with_weather({sigma});
    oncoming.other_lamps = std::move(oncoming.lamps);
    oncoming.lamps.clear();
    const glm::dvec3 gaze(-1.0, 0.0, 0.0);
    const double cosine = 50.0 / std::sqrt(square);
    EXPECT_NEAR(traffic_glare(oncoming, eye, gaze, {}).at(0).eye_lx, left * 1000.0 / square * cosine, 1e-12);
}

// Image 0.65 m below the road: the light's way is sqrt(50^2 + 3.5^2 + 1.75^2) long and meets the road 2 degrees off the level.
TEST(WeatherGlare, ASmoothFilmShowsTheMirrorImageTimesFresnel) {
    const double horizontal = std::hypot(50.0, 3.5), way = std::hypot(horizontal, 1.75), incidence = std::atan(horizontal / 1.75);
    const double share = fresnel(incidence);
    EXPECT_NEAR(share, 0.80, 0.01);
    const auto patches = [&](const Weather& weather, double roughness, CandelaTable table = tests::even_table(1000.0)) {
        return lamps_in_road(with_weather(weather, std::move(table)).lamps, weather, level, eye, Pavement::standard, roughness);
    };
    const Weather wet{.wetness = 1.0};
    EXPECT_NEAR(sum_lx(patches(wet, 1e-4)), share * 1000.0 / (way * way), 2e-3 * share * 1000.0 / (way * way));
    EXPECT_NEAR(sum_lx(patches({.wetness = 0.4}, 1e-4)), 0.4 * sum_lx(patches(wet, 1e-4)), 1e-12);
    const double fog = std::exp(-0.03 * way);
    EXPECT_NEAR(sum_lx(patches({.extinction_per_m = 0.03, .wetness = 1.0}, 1e-4)), fog * sum_lx(patches(wet, 1e-4)), 1e-4 * fog);
    // By the intensity towards where the image shows: V = -atan(1.75 / horizontal).
    const CandelaTable steep = tests::table_of({-180.0, 180.0}, {-90.0, 90.0}, [](double, double v) { return 1000.0 - 10.0 * v; });
    const double cd = 1000.0 + 10.0 * degrees(std::atan(1.75 / horizontal));
    EXPECT_NEAR(sum_lx(patches(wet, 1e-4, steep)), share * cd / (way * way), 2e-3 * share * cd / (way * way));
    for (const SeenLamp& patch : patches(wet, 1e-4))
        if (patch.facing_lx > 0.02 * share * 1000.0 / (way * way)) {
            EXPECT_NEAR(patch.position_m.x, 50.0 * 0.65 / 1.75, 0.2);
            EXPECT_NEAR(patch.position_m.z, 0.0, 1e-12);
        }
    EXPECT_TRUE(patches({}, 0.15).empty()) << "a dry road";
}

/// The film of pictures: the road's luminance towards the eye, patch by patch of 2 cm, times the solid angle of each.
TEST(WeatherGlare, ARoughFilmGivesWhatTheRoadsLuminanceAddsUpTo) {
    const Weather wet{.wetness = 1.0};
    for (const double cut_off : {0.0, 1.0}) {
        const CandelaTable beam = tests::table_of({-90.0, 90.0}, tests::steps(-60.0, 30.0, 0.1), [&](double, double v) {
            return 500.0 + cut_off * 20000.0 / (1.0 + std::exp((v + 0.6) / 0.1)) * std::exp(-std::pow((v + 1.5) / 2.0, 2));
        });
        const std::vector<LitLamp> lamps = with_weather(wet, beam).lamps;
        double truth = 0.0;
        constexpr double step = 0.02;
        for (double x = 0.5 * step; x < 50.0; x += step)
            for (double y = -4.0; y < 8.0; y += step) {
                const glm::dvec3 at(x, y, 0.0), to_lamp = lamps[0].pose.position_m - at, to_eye = eye - at;
                const double e_perp = intensity_towards_cd(lamps[0], at) / glm::dot(to_lamp, to_lamp), r2 = glm::dot(to_eye, to_eye);
                const glm::dvec3 film =
                    wet_light(glm::dvec3(0.0), {0.0, 0.0, 1.0}, glm::normalize(to_lamp), glm::normalize(to_eye), e_perp);
                truth += film.x * to_eye.z / std::sqrt(r2) / r2 * step * step;
            }
        const double by_road = sum_lx(lamps_in_road(lamps, wet, level, eye)),
                     smooth = sum_lx(lamps_in_road(lamps, wet, level, eye, Pavement::standard, 1e-3));
        EXPECT_NEAR(by_road, truth, 0.03 * truth) << cut_off;
        EXPECT_GT(smooth, 5.0 * by_road) << "standing water glares far more";
        RecordProperty(cut_off > 0.0 ? "beam_smooth_times_rough" : "even_smooth_times_rough", static_cast<int>(smooth / by_road));
    }
}

/// The facets of a dry pavement, in the same way; none under water.
TEST(WeatherGlare, AGlossyPavementMirrorsWhileItIsDry) {
    const Facets facets = facets_of(pavement_material(Pavement::asphalt_worn));
    const std::vector<LitLamp> lamps = with_weather({}).lamps;
    double truth = 0.0;
    constexpr double step = 0.05;
    for (double x = 0.5 * step; x < 50.0; x += step)
        for (double y = -12.0; y < 16.0; y += step) {
            const glm::dvec3 at(x, y, 0.0), to_lamp = lamps[0].pose.position_m - at, to_eye = eye - at;
            const double r2 = glm::dot(to_eye, to_eye);
            truth +=
                gloss_light(facets, {0.0, 0.0, 1.0}, glm::normalize(to_lamp), glm::normalize(to_eye), 1000.0 / glm::dot(to_lamp, to_lamp)) *
                to_eye.z / std::sqrt(r2) / r2 * step * step;
        }
    const double by_road = sum_lx(lamps_in_road(lamps, {}, level, eye, Pavement::asphalt_worn));
    EXPECT_NEAR(by_road, truth, 0.1 * truth);
    EXPECT_GT(by_road, 0.01 * facing_lx(seen_lamps(with_weather({}), eye)));
    EXPECT_TRUE(lamps_in_road(lamps, {}, level, eye, Pavement::standard).empty());
    const Weather wet{.wetness = 1.0};
    EXPECT_EQ(sum_lx(lamps_in_road(lamps, wet, level, eye, Pavement::asphalt_worn)), sum_lx(lamps_in_road(lamps, wet, level, eye)));
    EXPECT_TRUE(mirrors({}, Pavement::concrete) && mirrors(wet, Pavement::standard) && !mirrors({}, Pavement::standard));
}

TEST(WeatherGlare, ARoadThatBendsOrLiesAboveMirrorsNothingThatIsKnown) {
    const Weather wet{.wetness = 1.0};
    const Pose here, there{{50.0, 0.0, 0.0}, axes_from_angles(0.0, radians(0.6), 0.0)};
    EXPECT_NEAR(road_plane(here, there).bend_rad, radians(0.6), 1e-12);
    EXPECT_THAT(why_no_mirror(wet, road_plane(here, there)), HasSubstr("bends up or down by more than 0.5 degrees"));
    EXPECT_EQ(why_no_mirror({}, road_plane(here, there)), "") << "a dry road mirrors nothing anyway";
    // A hill of one slope does not bend, nor does one that is banked.
    const Pose up{{0.0, 0.0, 0.0}, axes_from_angles(0.0, 0.05, 0.0)}, higher{up.position_m + 50.0 * up.forward(), up.axes};
    EXPECT_NEAR(road_plane(up, higher).bend_rad, 0.0, 1e-12);
    EXPECT_NEAR(glm::dot(road_plane(up, higher).up, up.up()), 1.0, 1e-12);
    EXPECT_NEAR(road_plane(here, {{50.0, 0.0, 0.0}, axes_from_angles(0.0, 0.0, 0.05)}).bend_rad, 0.0, 1e-9);
    const RoadPlane above{{0.0, 0.0, 0.8}, {0.0, 0.0, 1.0}, 0.0};
    EXPECT_EQ(sum_lx(lamps_in_road(with_weather(wet).lamps, wet, above, eye)), 0.0);
}

TEST(WeatherGlare, OthersShineByWayOfTheRoadUnlessABodyStandsThere) {
    Moment moment;
    moment.weather.wetness = 1.0;
    moment.bodies = {{"oncoming", {{60.0, 3.5, 0.0}, axes_from_angles(pi, 0.0, 0.0)}},
                     {"between", {{30.0, 1.75, 0.0}, glm::dmat3(1.0)}, false}};
    LitLamp& lamp = moment.other_lamps.emplace_back(lamp_at({57.0, 3.5, 0.65}, tests::even_table(1000.0)));
    lamp.pose.axes = axes_from_angles(pi, 0.0, 0.0);
    lamp.body = 0;
    const glm::dvec3 driver(1.3, 0.35, 1.2), gaze(1.0, 0.0, 0.0);
    const std::vector<BodyBox> boxes{{{4.0, 1.8, 1.4}, -1.0}, {{6.0, 1.8, 1.4}, -3.0}};
    const auto eye_lx = [&] {
        double lx = 0.0;
        for (const GlareSource& source : traffic_by_road(moment, driver, gaze, boxes).sources)
            lx += source.eye_lx;
        return lx;
    };
    double by_hand = 0.0;
    for (const SeenLamp& patch : lamps_in_road({lamp}, moment.weather, level, driver))
        by_hand += patch.facing_lx * glm::dot(glm::normalize(patch.position_m - driver), gaze);
    EXPECT_GT(by_hand, 0.0);
    EXPECT_NEAR(eye_lx(), by_hand, 1e-12);
    moment.bodies[1].visible = true;
    double before = 0.0; // of the car that stands from 27 to 33 m
    for (const SeenLamp& patch : lamps_in_road({lamp}, moment.weather, level, driver))
        if (patch.position_m.x < 27.0)
            before += patch.facing_lx * glm::dot(glm::normalize(patch.position_m - driver), gaze);
    EXPECT_NEAR(eye_lx(), before, 1e-12);
    EXPECT_LT(before, by_hand);
    moment.bodies[0].pose.axes = axes_from_angles(pi, radians(1.0), 0.0);
    EXPECT_THAT(traffic_by_road(moment, driver, gaze, boxes).unknown, HasSubstr("bends"));
    moment.weather.wetness = 0.0;
    EXPECT_EQ(traffic_by_road(moment, driver, gaze, boxes).sources.size(), 0U);
}

/// Asphalt of 0.08 with R_L of 15 mcd: what is wet returns no R_L, the rest stays dry.
TEST(WeatherSeeing, AWetRoadLosesItsRetroreflection) {
    Material road{.name = "asphalt", .kind = SurfaceKind::road, .albedo = glm::vec3(0.08F), .retro_rl = 0.015F};
    const glm::dvec3 point(30.0, 0.0, 0.0), up(0.0, 0.0, 1.0), driver(-2.1, 0.35, 1.2);
    const auto seen = [&](double wetness) {
        return surface_luminance(with_weather({.wetness = wetness}), point, up, road, driver).photopic_cdm2;
    };
    const glm::dvec3 to_lamp = glm::dvec3(0.0, 0.0, 0.65) - point;
    const double e_perp = 1000.0 / glm::dot(to_lamp, to_lamp), albedo = reflectance_of(road.albedo);
    const double wet = wet_light(glm::dvec3(albedo), up, glm::normalize(to_lamp), glm::normalize(driver - point), e_perp).x;
    EXPECT_NEAR(seen(1.0), wet, 1e-12);
    EXPECT_LT(seen(1.0), 0.03 * seen(0.0)) << "R_L is 26 times what asphalt scatters";
    EXPECT_NEAR(seen(0.3), 0.3 * wet + 0.7 * seen(0.0), 1e-12);
    road.kind = SurfaceKind::board;
    EXPECT_EQ(seen(1.0), seen(0.0)) << "upright things stay as they are";
}

/// What the driver of the lamp sees is little changed by gloss; what comes towards him sees the road before the lamp, 0.4 cd/m2 a lux.
TEST(WeatherSeeing, AGlossyRoadIsBrightForTheOncomingEye) {
    const Material &worn = pavement_material(Pavement::asphalt_worn), &standard = pavement_material(Pavement::standard);
    const glm::dvec3 point(20.0, 0.0, 0.0), up(0.0, 0.0, 1.0), driver(-2.1, 0.35, 1.2), oncoming(60.0, 0.0, 1.2);
    const double e_perp = 1000.0 / (400.0 + 0.65 * 0.65);
    const auto seen = [&](const Material& road, const glm::dvec3& from) {
        return surface_luminance(with_weather({}), point, up, road, from).photopic_cdm2;
    };
    EXPECT_NEAR(seen(worn, driver) / seen(standard, driver), 1.0, 0.05);
    EXPECT_NEAR(seen(standard, oncoming) / e_perp, 0.08 / pi * 0.65 / std::hypot(20.0, 0.65), 1e-6); // 0.83 mcd, R_L being behind
    EXPECT_NEAR(seen(worn, oncoming) / e_perp, 0.413, 0.005);
}

/// Beads that shine through the film: type II keeps its class, at half wetness the half of it.
TEST(WeatherSeeing, WetMarkingsKeepWhatTheirBeadsReturn) {
    const Material paint = road_materials({.markings = {MarkingType::type_2, 4, 3, 3}})[index_of(RoadMaterial::marking_white)];
    const glm::dvec3 point(30.0, 0.0, 0.0), up(0.0, 0.0, 1.0), driver(0.0, 0.0, 1.2);
    const auto rl_mcd = [&](double wetness) {
        return 1000.0 * surface_luminance(with_weather({.wetness = wetness}), point, up, paint, driver).photopic_cdm2 /
               (1000.0 / (900.0 + 0.65 * 0.65));
    };
    EXPECT_NEAR(rl_mcd(0.0), 200.0, 1.0);
    EXPECT_NEAR(rl_mcd(0.5), 125.0, 1.0);
    EXPECT_NEAR(rl_mcd(1.0), 50.0, 0.5);
}

/// A surface in fog: exp(-sigma d) from the lamp, exp(-sigma d') to the eye, and the light in the air before it, of lamp and sky.
TEST(WeatherSeeing, FogTakesBothWaysAndAddsItsLight) {
    const Material grey{.name = "grey", .kind = SurfaceKind::target, .albedo = glm::vec3(0.5F)};
    const Weather fog{.extinction_per_m = 0.03};
    Moment moment = with_weather(fog);
    moment.daylight.horizontal_illuminance_lx = 2.0;
    moment.lamps[0].colour.sp_ratio = 1.6;
    const glm::dvec3 point(40.0, 0.0, 0.65), face(-1.0, 0.0, 0.0), driver(-2.0, 0.5, 0.65);
    const SurfaceLuminance seen = seen_luminance(moment, point, face, grey, driver);
    const double air = airlight_cdm2(moment.lamps[0], fog, driver, point, 32), sky = 2.0 / pi;
    const double of_lamp = 0.5 / pi * 1000.0 / 1600.0 * std::exp(-0.03 * 40.0), of_sky = 0.5 / pi * 0.5 * 2.0;
    const double left = std::exp(-0.03 * std::hypot(42.0, 0.5));
    EXPECT_NEAR(seen.photopic_cdm2, left * (of_lamp + of_sky) + air + sky * (1.0 - left), 1e-9);
    EXPECT_NEAR(seen.scotopic_cdm2, 1.6 * (left * of_lamp + air), 1e-9);
    EXPECT_NEAR(air, airlight_cdm2(moment.lamps[0], fog, driver, point), 0.1 * air);
}

} // namespace
} // namespace fernlicht
