// Light in fog and on a wet road against closed forms, integrals worked out another way, and what physics allows.
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"
#include "scenarios/values/scene.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

LitLamp lamp_of(CandelaTable table, const Pose& pose) {
    auto file = std::make_shared<LampFile>();
    file->table = std::move(table);
    return {"lamp", file, pose, 1.0, {}, 0.0};
}

LitLamp even(double cd) {
    CandelaTable table;
    table.h_deg = {-180.0, 180.0};
    table.v_deg = {-90.0, 90.0};
    table.cd = {cd, cd, cd, cd};
    return lamp_of(table, {glm::dvec3(0.0), axes_from_angles(0.0, 0.0, 0.0)});
}

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
    // A ray from behind the lamp: only the half before it counts.
    const double l = airlight_cdm2(even(500.0), thin, {-3.0, 1.0, 0.0}, {1e6, 1.0, 0.0});
    EXPECT_NEAR(l, 1e-9 * 500.0 * (pi / 2.0) / (4.0 * pi), 2e-4 * l);
}

/// Another way to the same integral: a million equal steps along the ray, by intensity and distance themselves.
TEST(Airlight, IsTheIntegralAlongTheRay) {
    CandelaTable beam;
    for (int i = -40; i <= 40; ++i)
        beam.h_deg.push_back(i);
    for (int i = -60; i <= 40; ++i)
        beam.v_deg.push_back(0.25 * i);
    for (const double v : beam.v_deg)
        for (const double h : beam.h_deg)
            beam.cd.push_back(300.0 + 20000.0 / (1.0 + std::exp((v + 0.6) / 0.2)) * std::exp(-h * h / 200.0));
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
TEST(Airlight, ComesCloserWithMoreMidpoints) {
    const LitLamp lamp = even(1000.0);
    const Weather fog{0.03, 1.0, 0.85, 0.0};
    for (const double y : {0.3, 1.0, 3.0}) {
        const glm::dvec3 eye(-2.0, y, 0.5), end(60.0, 0.5 * y, -0.6);
        const double truth = airlight_cdm2(lamp, fog, eye, end, 1e-6);
        EXPECT_NEAR(airlight_cdm2(lamp, fog, eye, end, 32), truth, 0.1 * truth);
        EXPECT_NEAR(airlight_cdm2(lamp, fog, eye, end, 128), truth, 0.01 * truth);
    }
}

TEST(Airlight, IsExactlyNothingInClearAirAndFromADarkLamp) {
    LitLamp lamp = even(1000.0);
    EXPECT_EQ(airlight_cdm2(lamp, Weather{}, {1.0, 1.0, 0.0}, {9.0, 1.0, 0.0}), 0.0);
    EXPECT_EQ(air_transmittance(Weather{}, 1e9), 1.0);
    EXPECT_EQ(airlight_cdm2(lamp, Weather{0.1, 1.0, 0.85, 0.0}, {-9.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}), 0.0) << "behind the lamp";
    lamp.intensity_factor = 0.0;
    EXPECT_EQ(airlight_cdm2(lamp, Weather{0.1, 1.0, 0.85, 0.0}, {1.0, 1.0, 0.0}, {9.0, 1.0, 0.0}), 0.0);
}

glm::dvec3 at_elevation(double deg, double azimuth_deg = 0.0) {
    return {std::cos(radians(deg)) * std::cos(radians(azimuth_deg)), std::cos(radians(deg)) * std::sin(radians(azimuth_deg)),
            std::sin(radians(deg))};
}
const glm::dvec3 up(0.0, 0.0, 1.0);

/// n = 1.333: 2.04 % at normal incidence, all at grazing; at Brewster's angle, 53.1 degrees, one polarisation alone.
TEST(Water, ReflectsAsFresnelSays) {
    EXPECT_NEAR(photometry::water_reflectance(1.0), std::pow(0.333 / 2.333, 2), 1e-12);
    EXPECT_NEAR(photometry::water_reflectance(0.0), 1.0, 1e-12);
    const double n2 = 1.333 * 1.333, brewster = 1.0 / std::sqrt(1.0 + n2);
    EXPECT_NEAR(photometry::water_reflectance(brewster), 0.5 * std::pow((1.0 - n2) / (1.0 + n2), 2), 1e-12);
}

/// Twice the integral of F cosine gives 6.6 % for diffuse light from outside; from within, 1 - (1 - 0.066) / n^2 = 47.4 %.
TEST(Water, HoldsBackFromWithinWhatReciprocitySays) {
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
TEST(WetRoad, IsDarkerFromAbove) {
    const double dry = 0.08 / pi * 100.0;
    const double wet = wet_light(glm::dvec3(0.08), up, at_elevation(60.0), at_elevation(60.0, 90.0), 100.0 / std::sin(radians(60.0))).x;
    EXPECT_LT(wet, 0.7 * dry);
    EXPECT_NEAR(photometry::wet_albedo(0.08, 1.0, 1.0), 0.0449, 0.0002);
}

/// No more light comes back than came, whatever the direction: diffuse and mirrored, over the hemisphere.
TEST(WetRoad, ReturnsNoMoreThanItGets) {
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

} // namespace
} // namespace fernlicht
