// Light of the sky against the figures its sources print, and against what the field expects of it.
#include "scenarios/sky/daylight.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

constexpr double au_km = 149597870.7, mean_moon_km = 384400.0;
constexpr SkyCover covers[] = {SkyCover::clear, SkyCover::partly_cloudy, SkyCover::overcast};

/// Munich.
Daylight at(int month, int day, int hour, int minute, SkyCover cover = SkyCover::clear) {
    Daylight daylight;
    daylight.clock = SkyClock{2026, month, day, 3600 * hour + 60 * minute, 0.0, 48.14, 11.58, cover, 0.0};
    return daylight_at(daylight, 0.0);
}

/// Beside typical maxima: full moon 0.2 lx, daylight without direct sun 27 000 lx, direct sun 100 000 lx.
TEST(SkyLight, LiesWithinAFactorOfTwoOfTypicalMaxima) {
    const SkyLight sun = sun_light(radians(62.0), radians(62.0), au_km, SkyCover::clear);
    EXPECT_GT(sun.direct_lx, 50'000.0);
    EXPECT_LT(sun.direct_lx, 200'000.0);
    for (const SkyCover cover : covers) {
        const double diffuse = sun_light(radians(62.0), radians(62.0), au_km, cover).diffuse_lx;
        EXPECT_GT(diffuse, 13'500.0);
        EXPECT_LT(diffuse, 54'000.0);
    }
    const SkyLight moon = moon_light(radians(62.0), mean_moon_km, 0.0, SkyCover::clear);
    const double horizontal = moon.direct_lx * std::sin(radians(62.0)) + moon.diffuse_lx;
    EXPECT_GT(horizontal, 0.1);
    EXPECT_LT(horizontal, 0.4);
}

/// 127.5 klx exp(-0.21 / sin h) and 0.8 + 15.5 sqrt(sin h) klx, worked out by hand for sin h = 1 and 0.5.
TEST(SkyLight, FollowsTheIes1984) {
    const SkyLight zenith = sun_light(pi / 2.0, pi / 2.0, au_km, SkyCover::clear);
    EXPECT_NEAR(zenith.direct_lx, 103'350.0, 100.0);
    EXPECT_NEAR(zenith.diffuse_lx, 16'300.0, 1e-6);
    const SkyLight thirty = sun_light(radians(30.0), radians(30.0), au_km, SkyCover::clear);
    EXPECT_NEAR(thirty.direct_lx, 83'770.0, 0.003 * 83'770.0); // air mass 1.994 in place of 2
    EXPECT_NEAR(thirty.diffuse_lx, 11'760.2, 0.1);
    EXPECT_NEAR(sun_light(radians(30.0), radians(30.0), au_km, SkyCover::partly_cloudy).diffuse_lx, 22'800.0, 1e-6);
    EXPECT_NEAR(sun_light(radians(30.0), radians(30.0), au_km, SkyCover::overcast).diffuse_lx, 10'800.0, 1e-6);
    EXPECT_EQ(sun_light(radians(30.0), radians(30.0), au_km, SkyCover::overcast).direct_lx, 0.0);
    EXPECT_NEAR(extraterrestrial_lx(au_km * 0.983), 131'950.0, 50.0); // early January
}

/// The Supplement's fits by hand: 3.4 lx at the end of civil twilight, 8 mlx of nautical, 0.65 mlx of astronomical; full moon 0.27 lx
/// overhead.
TEST(SkyLight, FollowsTheExplanatorySupplementThroughTwilight) {
    EXPECT_NEAR(sun_light(radians(-6.0), radians(-6.0), au_km, SkyCover::clear).diffuse_lx, 3.41, 0.02);
    EXPECT_NEAR(sun_light(radians(-12.0), radians(-12.0), au_km, SkyCover::clear).diffuse_lx, 0.00807, 0.0001);
    EXPECT_NEAR(sun_light(radians(-18.0), radians(-18.0), au_km, SkyCover::clear).diffuse_lx, 6.46e-4, 0.05e-4);
    EXPECT_EQ(sun_light(radians(-50.0), radians(-50.0), au_km, SkyCover::clear).diffuse_lx,
              sun_light(radians(-18.0), radians(-18.0), au_km, SkyCover::clear).diffuse_lx);
    EXPECT_NEAR(supplement_full_moon_lx(pi / 2.0), 0.269, 0.001);
    EXPECT_EQ(supplement_full_moon_lx(radians(-1.0)), 0.0);
}

/// Two sources, one light: sun and sky together by the IES, and the moon by ours, beside the Supplement's own totals.
TEST(SkyLight, AgreesWithTheSupplementWhereBothSpeak) {
    for (const double h : {5.0, 10.0, 20.0, 40.0, 60.0, 90.0}) {
        const SkyLight sun = sun_light(radians(h), radians(h), au_km, SkyCover::clear);
        const double total = sun.direct_lx * std::sin(radians(h)) + sun.diffuse_lx;
        EXPECT_NEAR(std::log2(total / supplement_sun_lx(radians(h))), 0.0, 0.6) << h;
        const SkyLight moon = moon_light(radians(h), mean_moon_km, 0.0, SkyCover::clear);
        const double moonlight = moon.direct_lx * std::sin(radians(h)) + moon.diffuse_lx;
        EXPECT_NEAR(std::log2(moonlight / supplement_full_moon_lx(radians(h))), 0.0, 0.6) << h;
    }
}

/// Half a moon gives a tenth, and a new moon nothing that counts.
TEST(SkyLight, MoonlightFollowsThePhase) {
    const auto horizontal = [](double phase_deg) {
        const SkyLight moon = moon_light(radians(60.0), mean_moon_km, radians(phase_deg), SkyCover::clear);
        return moon.direct_lx * std::sin(radians(60.0)) + moon.diffuse_lx;
    };
    EXPECT_NEAR(horizontal(90.0) / horizontal(0.0), 0.119, 0.001); // 10^(-0.7812 - 0.1443)
    EXPECT_LT(horizontal(175.0) / horizontal(0.0), 1e-3);
    for (double i = 0.0; i < 180.0; i += 1.0)
        EXPECT_GT(horizontal(i), horizontal(i + 1.0));
}

/// No step where one source hands over to the other, nor where a disc sets: within 2 % from one hundredth of a degree to the next, and
/// light never falls by more while the sun rises.
TEST(SkyLight, HasNoSteps) {
    for (const SkyCover cover : covers)
        for (double h = -25.0; h < 90.0; h += 0.01) {
            const auto total = [&](double degrees_up) {
                const double apparent = radians(degrees_up) + refraction_rad(radians(degrees_up));
                const SkyLight light = sun_light(radians(degrees_up), apparent, au_km, cover);
                return light.diffuse_lx + light.direct_lx * std::max(std::sin(apparent), 0.0);
            };
            const double below = total(h), above = total(h + 0.01);
            EXPECT_LE(std::abs(std::log(above / below)), 0.02) << h;
            EXPECT_TRUE(std::isfinite(above));
        }
}

TEST(Daylight, OneOfSunAndMoonShinesAtMost) {
    for (int month = 1; month <= 12; ++month)
        for (int hour = 0; hour < 24; ++hour) {
            const Daylight daylight = at(month, 15, hour, 0);
            EXPECT_FALSE(daylight.sun.illuminance_lx > 0.0 && daylight.moon.illuminance_lx > 0.0);
            EXPECT_GT(daylight.horizontal_illuminance_lx, 6e-4);
            EXPECT_LT(daylight.horizontal_illuminance_lx, 20'000.0);
            EXPECT_EQ(daylight.direct() == &daylight.sun, daylight.sun.illuminance_lx > 0.0);
            EXPECT_LT(std::abs(glm::dot(daylight.sun.towards(), daylight.sun.towards()) - 1.0), 1e-14);
        }
}

/// Full moon of 2026 January 3 (10:03 UT by the almanac): high in the following night over Munich. Summer noon; sunset at 21:17 summer
/// time.
TEST(Daylight, TellsTheRightHour) {
    const Daylight moonlit = at(1, 3, 23, 0);
    ASSERT_EQ(moonlit.direct(), &moonlit.moon);
    EXPECT_GT(degrees(moonlit.moon.elevation_rad), 60.0);
    EXPECT_GT(moonlit.moon.illuminance_lx, 0.1);
    const Daylight noon = at(6, 21, 11, 14);
    EXPECT_NEAR(degrees(noon.sun.elevation_rad), 65.3, 0.1); // 90 - 48.14 + 23.44
    EXPECT_NEAR(degrees(noon.sun.azimuth_rad), 180.0, 1.5);
    EXPECT_GT(at(6, 21, 19, 15).sun.illuminance_lx, 0.0);
    EXPECT_EQ(at(6, 21, 19, 21).sun.illuminance_lx, 0.0);
}

TEST(Daylight, RunsWithTheClock) {
    Daylight evening = at(6, 21, 19, 0);
    evening.name = "evening";
    EXPECT_EQ(daylight_at(evening, 3600.0), evening) << "stands still";
    evening.clock->rate = 60.0;
    const Daylight later = daylight_at(evening, 30.0); // half an hour of the sky
    Daylight expected = at(6, 21, 19, 30);
    EXPECT_NEAR(later.horizontal_illuminance_lx, expected.horizontal_illuminance_lx, 1e-6 * expected.horizontal_illuminance_lx);
    EXPECT_EQ(later.name, "evening");
    EXPECT_EQ(daylight_at(Daylight{"day", 27000.0}, 99.0), (Daylight{"day", 27000.0})) << "without a clock, as it is";
}

} // namespace
} // namespace fernlicht
