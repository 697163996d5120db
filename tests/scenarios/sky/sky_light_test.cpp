// Light of the sky against the figures its sources print, and against what the field expects of it.
#include "scenarios/sky/daylight.h"
#include "scenarios/sky/ephemeris.h"
#include "scenarios/sky/weather.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

constexpr double au_km = 149597870.7, mean_moon_km = 384400.0;
constexpr SkyCover covers[] = {SkyCover::clear, SkyCover::partly_cloudy, SkyCover::overcast};

/// Munich.
Daylight at(int month, int day, int hour, int minute, SkyCover cover = SkyCover::clear) {
    Daylight daylight{.clock = SkyClock{2026, month, day, 3600 * hour + 60 * minute, 0.0, 48.14, 11.58, cover, 0.0}};
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
TEST(SkyLight, FollowsTheIesAndTheExplanatorySupplement) {
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
    /// The Supplement's fits by hand: 3.4 lx at the end of civil twilight, 8 mlx of nautical, 0.65 mlx of astronomical; full moon 0.27 lx
    /// overhead.
    EXPECT_NEAR(sun_light(radians(-6.0), radians(-6.0), au_km, SkyCover::clear).diffuse_lx, 3.41, 0.02);
    EXPECT_NEAR(sun_light(radians(-12.0), radians(-12.0), au_km, SkyCover::clear).diffuse_lx, 0.00807, 0.0001);
    EXPECT_NEAR(sun_light(radians(-18.0), radians(-18.0), au_km, SkyCover::clear).diffuse_lx, 6.46e-4, 0.05e-4);
    EXPECT_EQ(sun_light(radians(-50.0), radians(-50.0), au_km, SkyCover::clear).diffuse_lx,
              sun_light(radians(-18.0), radians(-18.0), au_km, SkyCover::clear).diffuse_lx);
    EXPECT_NEAR(supplement_full_moon_lx(pi / 2.0), 0.269, 0.001);
    EXPECT_EQ(supplement_full_moon_lx(radians(-1.0)), 0.0);
    /// Two sources, one light: sun and sky together by the IES, and the moon by ours, beside the Supplement's own totals.
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

/// Also from pole to pole through four centuries, and at dates far from where the fits were made.
TEST(Daylight, OneOfSunAndMoonShinesAtMost) {
    const auto check = [](const SkyClock& clock) {
        const Daylight daylight = daylight_at(Daylight{.clock = clock}, 0.0);
        const double sky = daylight.horizontal_illuminance_lx, sun = daylight.sun.illuminance_lx, moon = daylight.moon.illuminance_lx;
        EXPECT_TRUE(sun == 0.0 || moon == 0.0);
        EXPECT_TRUE(sky > 1e-4 && sky < 60'000.0 && sun >= 0.0 && sun < 110'000.0 && moon >= 0.0 && moon < 0.4)
            << clock.year << '-' << clock.month << ", latitude " << clock.latitude_deg << ": " << sky << ", " << sun << ", " << moon;
        EXPECT_NEAR(glm::length(daylight.sun.towards()) + glm::length(daylight.moon.towards()), 2.0, 1e-12);
    };
    for (const double latitude_deg : {-90.0, -66.5, 0.0, 48.0, 69.0, 90.0}) {
        for (int year = 1800; year < 2200; year += 7)
            for (int k = 0; k < 12; ++k)
                check({year, 1 + k, 1 + 2 * k, 7000 * k, 0.0, latitude_deg, 180.0 - 30.0 * k, covers[k % 3], 0.0});
        for (const int year : {-4712, -2000, 0, 1582, 4000, 9999})
            for (int month = 1; month <= 12; ++month)
                for (const int hour : {0, 6, 12, 18})
                    check({year, month, 21, 3600 * hour, 0.0, latitude_deg, 0.0, SkyCover::clear, 0.0});
    }
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

/// At 69 degrees north the sun is up all day at midsummer and never at midwinter; at the pole a day's sky hardly changes.
TEST(Daylight, HasPolarDaysAndNights) {
    const auto north = [](int month, int hour, double latitude_deg) {
        return daylight_at(Daylight{.clock = SkyClock{2026, month, 21, 3600 * hour, 0.0, latitude_deg, 0.0, SkyCover::clear, 0.0}}, 0.0);
    };
    const double at_midnight_lx = north(6, 0, 90.0).horizontal_illuminance_lx;
    for (int hour = 0; hour < 24; ++hour) {
        EXPECT_GT(north(6, hour, 69.0).sun.illuminance_lx, 0.0) << hour;
        EXPECT_EQ(north(12, hour, 69.0).sun.illuminance_lx, 0.0) << hour;
        EXPECT_NEAR(north(6, hour, 90.0).horizontal_illuminance_lx, at_midnight_lx, 0.01 * at_midnight_lx) << hour;
    }
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

// Against the printed examples of J. Meeus, Astronomical Algorithms (2nd edition), and of I. Reda and A. Andreas, Solar Position Algorithm
// (NREL/TP-560-34302).

TEST(Calendar, DaysAndTimesOfMeeusAndTheAlmanacs) {
    EXPECT_EQ(julian_day({1957, 10, 4, 0.81 * 24.0}), 2436116.31); // launch of Sputnik 1
    EXPECT_EQ(julian_day({2000, 1, 1, 12.0}), 2451545.0);
    EXPECT_EQ(julian_day({1987, 1, 27, 0.0}), 2446822.5);
    EXPECT_EQ(julian_day({1900, 1, 1, 0.0}), 2415020.5);
    EXPECT_EQ(julian_day({2026, 12, 31, 26.0}), julian_day({2027, 1, 1, 2.0}));
    EXPECT_EQ(days_in_month(2000, 2), 29);
    EXPECT_EQ(days_in_month(1900, 2), 28);
    const double day = julian_day({1987, 4, 10, 0.0});
    const Ecliptic ecliptic = ecliptic_at(julian_centuries(day)); // 22.a: -3.788", 23 deg 26' 36.850"
    EXPECT_NEAR(degrees(ecliptic.nutation_rad) * 3600.0, -3.788, 0.5);
    EXPECT_NEAR(degrees(ecliptic.obliquity_rad) * 3600.0, 84396.850, 0.1);
    EXPECT_NEAR(degrees(sidereal_time_rad(day, ecliptic.nutation_rad, ecliptic.obliquity_rad)),
                15.0 * (13.0 + 10.0 / 60.0 + 46.1351 / 3600.0), 2e-4);
    /// Observed: 56.86 s in 1990, 63.83 s in 2000, 69.4 s in 2020 (IERS).
    EXPECT_NEAR(delta_t_s(julian_day({1990, 1, 1, 0.0})), 56.86, 0.5);
    EXPECT_NEAR(delta_t_s(julian_day({2000, 1, 1, 0.0})), 63.83, 0.5);
    EXPECT_NEAR(delta_t_s(julian_day({2020, 1, 1, 0.0})), 69.4, 3.0); // the fit was made before, and is 2.2 s long
}

TEST(Sun, Example25a) {
    const CelestialPlace sun = sun_place(julian_centuries(2448908.5)); // 1992 October 13, 0 h TD
    EXPECT_NEAR(degrees(sun.longitude_rad), 199.90895, 1e-4);
    EXPECT_NEAR(degrees(sun.right_ascension_rad), 198.38083, 2e-4);
    EXPECT_NEAR(degrees(sun.declination_rad), -7.78507, 1e-4);
    EXPECT_NEAR(sun.distance_km, 0.99766 * 149597870.7, 1000.0);
}

TEST(Moon, Examples47aAnd48a) {
    const CelestialPlace moon = moon_place(julian_centuries(2448724.5)); // 1992 April 12, 0 h TD
    EXPECT_NEAR(degrees(moon.longitude_rad), 133.167265, 2e-4);
    EXPECT_NEAR(degrees(moon.latitude_rad), -3.229126, 1e-6);
    EXPECT_NEAR(moon.distance_km, 368409.7, 0.1);
    EXPECT_NEAR(degrees(moon.right_ascension_rad), 134.688470, 2e-4);
    EXPECT_NEAR(degrees(moon.declination_rad), 13.768368, 1e-4);
    const double t = julian_centuries(2448724.5), phase = phase_angle_rad(sun_place(t), moon_place(t));
    EXPECT_NEAR(degrees(phase), 69.0756, 0.01);
}

/// 2003 October 17, 12:30:30 at UTC - 7 h; 105.1786 W, 39.742476 N; 820 hPa, 11 C: zenith 50.11162, azimuth 194.34024 degrees.
TEST(Horizon, ExampleOfTheSolarPositionAlgorithmRefractionAndAzimuth) {
    const double day = julian_day({2003, 10, 17, 12.0 + 30.5 / 60.0 + 7.0});
    EXPECT_NEAR(day, 2452930.312847, 1e-6);
    const double centuries = julian_centuries(day + 67.0 / 86400.0);
    const Ecliptic ecliptic = ecliptic_at(centuries);
    const HorizontalPlace sun =
        horizontal_place(sun_place(centuries), sidereal_time_rad(day, ecliptic.nutation_rad, ecliptic.obliquity_rad),
                         {radians(39.742476), radians(-105.1786)});
    EXPECT_NEAR(degrees(sun.azimuth_rad), 194.34024, 0.01); // the accuracy of chapter 25
    const double apparent = sun.altitude_rad + refraction_rad(sun.altitude_rad, 820.0, 11.0);
    EXPECT_NEAR(90.0 - degrees(apparent), 50.11162, 0.005);
    /// Meeus, chapter 16: 28.75 arc minutes at a true altitude of 32.92'; about 34' lift a sun that has set, 1' at 45 degrees.
    EXPECT_NEAR(degrees(refraction_rad(radians(32.92 / 60.0))) * 60.0, 24.6, 0.2); // 57.86' apparent less 33.1', at 1010 hPa
    EXPECT_NEAR(degrees(refraction_rad(radians(-0.5667))) * 60.0, 34.0, 1.5);
    EXPECT_NEAR(degrees(refraction_rad(radians(45.0))) * 60.0, 1.0, 0.05);
    EXPECT_EQ(refraction_rad(radians(-5.05)), 0.0);
    EXPECT_EQ(refraction_rad(radians(-90.0)), 0.0);
    for (double h = -90.0; h < 90.0; h += 0.01) // what is higher is seen higher: no jump turns the order round
        EXPECT_LE(radians(h) + refraction_rad(radians(h)), radians(h + 0.01) + refraction_rad(radians(h + 0.01))) << h;
    EXPECT_NEAR(horizon_direction(0.0, 0.0).y, 1.0, 1e-15);
    EXPECT_NEAR(horizon_direction(pi / 2.0, 0.0).x, 1.0, 1e-15);
    EXPECT_NEAR(horizon_direction(1.0, pi / 2.0).z, 1.0, 1e-15);
}

// Extinction of fog, rain and snow against their sources' figures.

TEST(Weather, ExtinctionOfFogRainAndSnow) {
    EXPECT_NEAR(extinction_of_range_per_m(100.0, 0.02), 0.03912, 1e-6);
    EXPECT_NEAR(extinction_of_range_per_m(100.0), 0.02996, 5e-6);
    /// 1.076 R^0.67 dB/km: 1.988 dB/km at 2.5 mm/h, 4.188 at 7.6, 9.300 at 25; 4.343 dB are one neper.
    EXPECT_NEAR(rain(Intensity::light).extinction_per_m, 1.988 / 4343.0, 1e-6);
    EXPECT_NEAR(rain(Intensity::moderate).extinction_per_m, 4.188 / 4343.0, 1e-6);
    EXPECT_NEAR(rain(Intensity::heavy).extinction_per_m, 9.300 / 4343.0, 1e-6);
    EXPECT_NEAR(snow(Intensity::light).extinction_per_m, 2.996 / 1500.0, 1e-6);
    EXPECT_GT(snow(Intensity::heavy).extinction_per_m, rain(Intensity::heavy).extinction_per_m);
    EXPECT_EQ(rain(Intensity::heavy).wetness, 1.0);
    EXPECT_EQ(snow(Intensity::heavy).wetness, 0.0);
    const Weather fog{0.03, 1.0, 0.85, 0.0}, dark{0.01, 0.5, 0.0, 0.2}, both = together(fog, dark);
    EXPECT_DOUBLE_EQ(both.extinction_per_m, 0.04);
    EXPECT_DOUBLE_EQ(both.scattering_albedo, 0.035 / 0.04);
    EXPECT_DOUBLE_EQ(both.asymmetry, 0.03 * 0.85 / 0.035);
    EXPECT_EQ(both.wetness, 0.2);
    EXPECT_EQ(together(fog, Weather{}), fog);
}

} // namespace
} // namespace fernlicht
