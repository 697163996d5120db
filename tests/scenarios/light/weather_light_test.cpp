// Light in fog and on a wet road against closed forms, integrals worked out another way, and what physics allows.
#include "scenarios/lamps/mounted_lamp.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/light/light_bounds.h"
#include "scenarios/photometry.h"
#include "scenarios/values/scene.h"
#include "tests/lamps.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace fernlicht {
namespace {

LitLamp lamp_of(CandelaTable table, const Pose& pose) { return {"lamp", tests::file_of(std::move(table)), pose, 1.0, {}, 0.0}; }

LitLamp even(double cd) { return lamp_of(tests::even_table(cd), {glm::dvec3(0.0), axes_from_angles(0.0, 0.0, 0.0)}); }

TEST(HenyeyGreenstein, ScattersAllOfItAndHasItsMeanCosine) {
    for (const double g : {0.0, 0.3, 0.85, 0.9}) {
        constexpr int n = 200'000;
        double all = 0.0, mean = 0.0;
        for (int i = 0; i < n; ++i) {
            const double angle = pi * (i + 0.5) / n, ring = 2.0 * pi * std::sin(angle) * pi / n;
            all += photometry::henyey_greenstein(std::cos(angle), g) * ring;
            mean += photometry::henyey_greenstein(std::cos(angle), g) * ring * std::cos(angle);
        }
        EXPECT_NEAR(all, 1.0, 1e-7) << g;
        EXPECT_NEAR(mean, g, 1e-7) << g;
    }
}

/// An even lamp, even scattering, and air so thin that nothing is lost: L = sigma I (angle at the lamp) / (4 pi distance of the ray).
TEST(Airlight, IsTheClosedFormForAnEvenLampInThinAir) {
    const Weather thin{1e-9, 1.0, 0.0, 0.0};
    for (const double h : {0.1, 1.0, 7.0})
        for (const auto& [from, to] : {std::pair(2.0, 9.0), std::pair(1.0, 1000.0), std::pair(50.0, 51.0)}) {
            const double angle = std::atan(to / h) - std::atan(from / h); // all before the lamp, whose forward is x
            const double l = airlight_cdm2(even(500.0), thin, {from, h, 0.0}, {to, h, 0.0});
            EXPECT_NEAR(l, 1e-9 * 500.0 * angle / (4.0 * pi * h), 2e-4 * l) << h << ' ' << to;
        }
    // From 1 mm to 1 km past the lamp, in steps that halve until the sum moves by 1e-7 twice.
    for (const double h : {1e-3, 0.1, 10.0, 1000.0})
        for (const double way : {1e-3, 1.0, 1000.0}) {
            const double from = 2.0 * h, angle = std::atan((from + way) / h) - std::atan(from / h);
            const double l = airlight_cdm2(even(1000.0), {1e-12, 1.0, 0.0, 0.0}, {from, h, 0.0}, {from + way, h, 0.0}, 1e-7);
            EXPECT_NEAR(l / (1e-12 * 1000.0 * angle / (4.0 * pi * h)), 1.0, 1e-5) << h << ' ' << way;
        }
    // A ray from behind the lamp: only the half before it counts.
    const double l = airlight_cdm2(even(500.0), thin, {-3.0, 1.0, 0.0}, {1e6, 1.0, 0.0});
    EXPECT_NEAR(l, 1e-9 * 500.0 * (pi / 2.0) / (4.0 * pi), 2e-4 * l);
}

/// Another way to the same integral: a million equal steps along the ray, by intensity and distance themselves.
TEST(Airlight, IsTheIntegralAlongTheRay) {
    const CandelaTable beam = tests::table_of(tests::steps(-40.0, 40.0, 1.0), tests::steps(-15.0, 10.0, 0.25), [](double h, double v) {
        return 300.0 + 20000.0 / (1.0 + std::exp((v + 0.6) / 0.2)) * std::exp(-h * h / 200.0);
    });
    const LitLamp lamp = lamp_of(beam, {glm::dvec3(3.4, 0.6, 0.65), axes_from_angles(0.0, 0.0, 0.0)});
    const glm::dvec3 eye(1.3, 0.35, 1.2);
    for (const Weather& fog : {Weather{0.003, 1.0, 0.85, 0.0}, Weather{0.1, 0.7, 0.5, 0.0}, Weather{10.0, 1.0, 0.9, 0.0}})
        for (const glm::dvec3& end : {glm::dvec3(30.0, -1.5, 0.0), glm::dvec3(200.0, 10.0, 6.0), glm::dvec3(9.0, 0.5, 0.0)}) {
            constexpr int n = 1'000'000;
            const double way = glm::length(end - eye), step = way / n;
            const glm::dvec3 along = (end - eye) / way;
            double truth = 0.0;
            for (int i = 0; i < n; ++i) {
                const double t = (i + 0.5) * step;
                const glm::dvec3 d = eye + t * along - lamp.pose.position_m;
                const double r = glm::length(d);
                if (d.x <= 0.0)
                    continue;
                const double cd = intensity_cd(lamp.file->table, degrees(std::atan2(-d.y, d.x)), degrees(std::asin(d.z / r)));
                if (cd <= 0.0)
                    continue;
                const double b = 1.0 + fog.asymmetry * fog.asymmetry - 2.0 * fog.asymmetry * -glm::dot(d, along) / r;
                truth += cd / (r * r) * (1.0 - fog.asymmetry * fog.asymmetry) / (4.0 * pi * std::pow(b, 1.5)) *
                         std::exp(-fog.extinction_per_m * (r + t)) * step;
            }
            truth *= fog.extinction_per_m * fog.scattering_albedo;
            EXPECT_NEAR(airlight_cdm2(lamp, fog, eye, end), truth, 1e-3 * truth + 1e-12) << fog.extinction_per_m << ' ' << end.x;
        }
}

/// What drawing takes: 32 midpoints are within a tenth of the integral where a driver looks at the road, 128 within a hundredth.
TEST(Airlight, ComesCloserWithMoreMidpointsAndIsNothingInClearAir) {
    const LitLamp lamp = even(1000.0);
    const Weather fog{0.03, 1.0, 0.85, 0.0};
    for (const double y : {0.3, 1.0, 3.0}) {
        const glm::dvec3 eye(-2.0, y, 0.5), end(60.0, 0.5 * y, -0.6);
        const double truth = airlight_cdm2(lamp, fog, eye, end, 1e-6);
        EXPECT_NEAR(airlight_cdm2(lamp, fog, eye, end, 32), truth, 0.1 * truth);
        EXPECT_NEAR(airlight_cdm2(lamp, fog, eye, end, 128), truth, 0.01 * truth);
    }
    LitLamp other_lamp = even(1000.0);
    EXPECT_EQ(airlight_cdm2(other_lamp, Weather{}, {1.0, 1.0, 0.0}, {9.0, 1.0, 0.0}), 0.0);
    EXPECT_EQ(air_transmittance(Weather{}, 1e9), 1.0);
    EXPECT_EQ(airlight_cdm2(other_lamp, Weather{0.1, 1.0, 0.85, 0.0}, {-9.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}), 0.0) << "behind the lamp";
    other_lamp.intensity_factor = 0.0;
    EXPECT_EQ(airlight_cdm2(other_lamp, Weather{0.1, 1.0, 0.85, 0.0}, {1.0, 1.0, 0.0}, {9.0, 1.0, 0.0}), 0.0);
}

glm::dvec3 at_elevation(double deg, double azimuth_deg = 0.0) {
    return {std::cos(radians(deg)) * std::cos(radians(azimuth_deg)), std::cos(radians(deg)) * std::sin(radians(azimuth_deg)),
            std::sin(radians(deg))};
}
const glm::dvec3 up(0.0, 0.0, 1.0);

/// n = 1.333: 2.04 % at normal incidence, all at grazing; at Brewster's angle, 53.1 degrees, one polarisation alone.
TEST(Water, ReflectsAsFresnelSaysAndReturnsByReciprocity) {
    EXPECT_NEAR(photometry::water_reflectance(1.0), std::pow(0.333 / 2.333, 2), 1e-12);
    EXPECT_NEAR(photometry::water_reflectance(0.0), 1.0, 1e-12);
    const double n2 = 1.333 * 1.333, brewster = 1.0 / std::sqrt(1.0 + n2);
    EXPECT_NEAR(photometry::water_reflectance(brewster), 0.5 * std::pow((1.0 - n2) / (1.0 + n2), 2), 1e-12);
    /// Twice the integral of F cosine gives 6.6 % for diffuse light from outside; from within, 1 - (1 - 0.066) / n^2 = 47.4 %.
    double outside = 0.0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i) {
        const double c = (i + 0.5) / n;
        outside += 2.0 * c * photometry::water_reflectance(c) / n;
    }
    EXPECT_NEAR(outside, 0.066, 0.001);
    EXPECT_NEAR(photometry::water_inner_reflectance, 1.0 - (1.0 - outside) / (1.333 * 1.333), 5e-4);
}

/// A road gets darker when wet; seen and lit from above, asphalt of 0.08 has 0.045 left (0.08 * 0.98^2 / (1.777 (1 - 0.4745 * 0.08))).
TEST(WetRoad, IsDarkerFromAboveAndReturnsNoMoreThanItGets) {
    const double dry = 0.08 / pi * 100.0;
    const double wet = wet_light(glm::dvec3(0.08), up, at_elevation(60.0), at_elevation(60.0, 90.0), 100.0 / std::sin(radians(60.0))).x;
    EXPECT_LT(wet, 0.7 * dry);
    EXPECT_NEAR(photometry::wet_albedo(0.08, 1.0, 1.0), 0.0449, 0.0002);
    /// Seen and lit at grazing angles: no more than a mirror of its slope gives, the largest density of facets, 1 / (pi alpha^2), over
    /// 2 alpha, where light grazes and the eye more so: 47.16 at alpha 0.15.
    for (const double in : {1.0, 0.01, 1e-6, 1e-12, 0.0})
        for (const double out : {1.0, 0.01, 1e-6, 1e-12, 0.0}) {
            const glm::dvec3 to_light(std::sqrt(1.0 - in * in), 0.0, in), to_eye(-std::sqrt(1.0 - out * out), 0.0, out);
            const double l = wet_light(glm::dvec3(0.5), up, to_light, to_eye, 1.0).x;
            EXPECT_TRUE(l >= 0.0 && l <= 47.2) << in << ' ' << out << ": " << l;
        }
    /// No more light comes back than came, whatever the direction: diffuse and mirrored, over the hemisphere.
    for (const double elevation : {5.0, 30.0, 90.0}) {
        const glm::dvec3 to_light = at_elevation(elevation);
        const double got = std::sin(radians(elevation));
        double returned = 0.0;
        constexpr int n = 600;
        for (int i = 0; i < n; ++i)
            for (int k = 0; k < n; ++k) {
                const double out = 90.0 * (i + 0.5) / n, azimuth = 360.0 * (k + 0.5) / n;
                const double solid = std::cos(radians(out)) * radians(90.0 / n) * radians(360.0 / n);
                returned += wet_light(glm::dvec3(1.0), up, to_light, at_elevation(out, azimuth), 1.0).x * std::sin(radians(out)) * solid;
            }
        EXPECT_LE(returned, 1.02 * got) << elevation;
        EXPECT_GE(returned, 0.3 * got) << elevation;
    }
}

/// What a driver feels: at 30 m his lamp 0.65 m high gives the wet road less light back to him and more to who comes towards him at 60 m.
TEST(WetRoad, GivesLessBackAndMoreToTheOncoming) {
    const double cosine = 0.65 / std::hypot(30.0, 0.65), dry = 0.08 / pi * cosine;
    const glm::dvec3 to_lamp = glm::normalize(glm::dvec3(-30.0, 0.0, 0.65));
    const double back = wet_light(glm::dvec3(0.08), up, to_lamp, glm::normalize(glm::dvec3(-32.0, 0.3, 1.2)), 1.0).x;
    const double onwards = wet_light(glm::dvec3(0.08), up, to_lamp, glm::normalize(glm::dvec3(30.0, 0.0, 1.1)), 1.0).x;
    RecordProperty("back_percent_of_dry", static_cast<int>(100.0 * back / dry));
    RecordProperty("onwards_percent_of_dry", static_cast<int>(100.0 * onwards / dry));
    EXPECT_LT(back, 0.6 * dry); // and R_L, which is 26 times as much, goes with the water
    EXPECT_GT(onwards, 20.0 * dry);
}

/// Uneven axes with a step of intensity, as cut-offs have.
CandelaTable steep_table() {
    CandelaTable table{{-40.0, -10.0, -1.0, 0.0, 0.2, 7.0, 35.0}, {-20.0, -5.0, -0.6, -0.5, 0.0, 8.0}, {}, {}, BetweenSamples::linear_cd};
    for (std::size_t v = 0; v < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h < table.h_deg.size(); ++h)
            table.cd.push_back(v < 3 ? 9000.0 + 1000.0 * static_cast<double>((3 * h + v) % 5) : 40.0 * static_cast<double>(h));
    return table;
}

LitLamp lamp_with(CandelaTable table, const glm::dvec3& position_m, double yaw_rad, double pitch_rad) {
    return LitLamp{.file = tests::file_of(std::move(table)),
                   .pose = {position_m, axes_from_angles(yaw_rad, pitch_rad, 0.02)},
                   .intensity_factor = 0.7};
}

Moment two_lamps(const CandelaTable& table) {
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = 0.2;
    moment.lamps = {lamp_with(table, {3.0, 0.6, 0.65}, 0.01, -0.01), lamp_with(table, {3.0, -0.6, 0.65}, -0.02, -0.012)};
    return moment;
}

LuxBounds target_bounds(const Moment& moment, const glm::dvec3& point_m) {
    LuxBounds bounds;
    const Pose place{point_m, glm::dmat3(1.0)};
    LightBounds(moment).target_lx(SurfacePlaces({&place, 1}), 0, 0.0, {&bounds, 1});
    return bounds;
}

/// The same light, but that no samples lie on even steps, and with a jump narrower than any step.
CandelaTable uneven_table() {
    CandelaTable table = steep_table();
    table.h_deg = {-40.0, -10.1234, -1.01, 0.0, 1e-9, 2.71828, 35.0};
    table.v_deg = {-20.0, -5.4321, -0.6, -0.5678, 0.0, 8.0};
    return table;
}

// In the dark, by the moon, in fog.
TEST(LightBounds, BoundsHoldTheIlluminanceAndAreNarrow) {
    constexpr double height_m = 0.25;
    Moment moon = two_lamps(steep_table()), fog = moon;
    moon.daylight.moon = {1.0, 0.6, 0.25};
    fog.weather.extinction_per_m = 0.05;
    const Moment even = two_lamps(steep_table()), uneven = two_lamps(uneven_table());
    std::mt19937_64 chance(7);
    std::uniform_real_distribution<double> along(-5.0, 120.0), across(-40.0, 40.0), above(-3.0, 4.0), tilt(-0.3, 0.3);
    std::vector<Pose> points(70'001);
    for (Pose& point : points)
        point = {{along(chance), across(chance), above(chance)}, axes_from_angles(0.3, tilt(chance), tilt(chance))};
    const SurfacePlaces places(points);
    for (const Moment* moment : std::initializer_list<const Moment*>{&even, &moon, &fog, &uneven}) {
        std::vector<LuxBounds> surface(points.size()), target(points.size()), narrow(points.size());
        LightBounds(*moment).surface_lx(places, 0, 0.0, surface);
        LightBounds(*moment).target_lx(places, 0, height_m, target);
        std::size_t unknown = 0;
        const auto hold = [&](const LuxBounds& bounds, double truth, const glm::dvec3& point_m) {
            if (!std::isfinite(bounds.high_lx)) {
                ++unknown;
                return;
            }
            ASSERT_LE(bounds.low_lx, truth);
            ASSERT_GE(bounds.high_lx, truth);
            double apart_m = std::numeric_limits<double>::infinity();
            for (const LitLamp& lamp : moment->lamps)
                apart_m = std::min(apart_m, glm::length(point_m - lamp.pose.position_m));
            // 1e5 cd per degree of cut-off times 1.6e-4 degrees, of two lamps, and rounding.
            if (moment != &uneven) {
                ASSERT_LE(bounds.high_lx - bounds.low_lx, 60.0 / (apart_m * apart_m) + 2e-5 * truth);
            }
        };
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec3 &point = points[i].position_m, &normal = points[i].up(), raised = point + height_m * normal;
            hold(surface[i], surface_illuminance_lx(*moment, point, normal), point);
            hold(target[i], target_illuminance_lx(*moment, raised), raised);
        }
        EXPECT_LT(unknown, points.size() / 25) << "only what is steeper than 30 degrees or on the border of the table";
        for (const packs::Level level : packs::levels_here()) {
            LightBounds(*moment, level).target_lx(places, 0, height_m, narrow);
            for (std::size_t i = 0; i < points.size(); ++i)
                ASSERT_TRUE((narrow[i].low_lx == target[i].low_lx && narrow[i].high_lx == target[i].high_lx) ||
                            std::isnan(target[i].low_lx));
        }
    }
}

// The far right lane of a cut-off: from a degree below it to a degree above, in steps that lie within the angles' error as well.
TEST(LightBounds, BoundsHoldAcrossACutOff) {
    const Moment moment = two_lamps(steep_table());
    for (const double step : {1e-3, 1e-7})
        for (int i = -1000; i <= 1000; ++i) {
            const glm::dvec3 point{60.0, 0.3, 0.65 - 57.0 * std::tan(0.01 + radians(0.55)) + step * i};
            const LuxBounds bounds = target_bounds(moment, point);
            const double truth = target_illuminance_lx(moment, point);
            ASSERT_LE(bounds.low_lx, truth);
            ASSERT_GE(bounds.high_lx, truth);
        }
}

TEST(LightBounds, KnowsTheDarkAndWhatItDoesNotKnow) {
    Moment moment = two_lamps(steep_table());
    moment.daylight.horizontal_illuminance_lx = 0.0;
    EXPECT_EQ(target_bounds(moment, {-10.0, 0.0, 0.5}).high_lx, 0.0);
    EXPECT_EQ(target_bounds(moment, {13.0, 30.0, 0.5}).high_lx, 0.0) << "outside the table there is no light";
    EXPECT_FALSE(std::isfinite(target_bounds(moment, {3.2, 0.6, 0.0}).high_lx)) << "steeper than 30 degrees";
    EXPECT_FALSE(std::isfinite(target_bounds(moment, moment.lamps[0].pose.position_m).high_lx)) << "in the lamp";
    const Pose place{{63.0, 0.0, 0.0}, glm::dmat3(1.0)};
    LuxBounds far;
    LightBounds(moment).surface_lx(SurfacePlaces({&place, 1}), 0, 1.0, {&far, 1});
    EXPECT_EQ(far.low_lx, 0.0);
    EXPECT_LT(far.high_lx, 1.0) << "13 000 cd x 0.7 x 2 lamps x 0.65 / 60^3 = 0.055 lx at most";

    CandelaTable logarithmic = steep_table(), with_gap = steep_table();
    logarithmic.rule = BetweenSamples::log_cd;
    with_gap.gaps.assign((with_gap.h_deg.size() - 1) * (with_gap.v_deg.size() - 1), 0);
    for (const CandelaTable& table : {logarithmic, with_gap})
        EXPECT_FALSE(std::isfinite(target_bounds(two_lamps(table), {23.0, 0.0, 0.5}).high_lx));
}

// At the lamp's own place there is no direction and no distance: 0 / 0 in every term, and no light in the end.
TEST(Light, IsANumberInTheLampItself) {
    const Moment moment = two_lamps(steep_table());
    for (const LitLamp& lamp : moment.lamps) {
        EXPECT_TRUE(std::isfinite(target_illuminance_lx(moment, lamp.pose.position_m)));
        EXPECT_TRUE(std::isfinite(surface_illuminance_lx(moment, lamp.pose.position_m, {-1.0, 0.0, 0.0})));
    }
}

// The colour of retroreflected light keeps the photometric figures that it was measured with.

const glm::dvec3 weights(0.2126, 0.7152, 0.0722);

double returned(const Material& material, double kelvin) {
    return glm::dot(weights, colour_of_temperature(kelvin).linear_srgb * retro_tint(material));
}

TEST(RetroTint, GreyIsTheLampsOwnColourToTheBit) {
    Material plate{.name = "plate", .retro_rl = 50.0F};
    EXPECT_EQ(retro_tint(plate), glm::dvec3(1.0));
    plate.retro_rgb = glm::vec3(0.3F);
    EXPECT_EQ(retro_tint(plate), glm::dvec3(1.0));
    EXPECT_FALSE(is_tinted(plate));
    const Material dull{.name = "dull", .retro_rgb = {1.0F, 0.0F, 0.0F}};
    EXPECT_FALSE(is_tinted(dull)) << "returns nothing";
}

TEST(RetroTint, LuminanceHoldsInIlluminantAAndFallsInBluerLight) {
    Material reflector{.name = "reflector", .retro_rl = 120.0F, .retro_rgb = {1.0F, 0.0F, 0.0F}};
    EXPECT_NEAR(returned(reflector, 2856.0), 1.0, 1e-12);
    EXPECT_LT(returned(reflector, 3200.0), 0.97);
    EXPECT_LT(returned(reflector, 4300.0), 0.85);
    EXPECT_GT(returned(reflector, 4300.0), 0.6);
    EXPECT_EQ(retro_tint(reflector).g, 0.0);
    const glm::dvec3 full = retro_tint(reflector);
    reflector.retro_rgb *= 0.5F;
    EXPECT_NEAR(glm::length(retro_tint(reflector) - full), 0.0, 1e-12) << "its size says nothing";
    reflector.retro_rgb = {0.8F, 0.55F, 0.0F}; // yellow
    EXPECT_NEAR(returned(reflector, 2856.0), 1.0, 1e-12);
}

} // namespace
} // namespace fernlicht
