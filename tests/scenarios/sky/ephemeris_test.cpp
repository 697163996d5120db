// Against the printed examples of J. Meeus, Astronomical Algorithms (2nd edition), and of I. Reda and A. Andreas, Solar Position Algorithm
// (NREL/TP-560-34302).
#include "scenarios/sky/ephemeris.h"
#include "scenarios/values/pose.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(Calendar, JulianDaysOfMeeusChapter7) {
    EXPECT_EQ(julian_day({1957, 10, 4, 0.81 * 24.0}), 2436116.31); // launch of Sputnik 1
    EXPECT_EQ(julian_day({2000, 1, 1, 12.0}), 2451545.0);
    EXPECT_EQ(julian_day({1987, 1, 27, 0.0}), 2446822.5);
    EXPECT_EQ(julian_day({1900, 1, 1, 0.0}), 2415020.5);
    EXPECT_EQ(julian_day({2026, 12, 31, 26.0}), julian_day({2027, 1, 1, 2.0}));
    EXPECT_EQ(days_in_month(2000, 2), 29);
    EXPECT_EQ(days_in_month(1900, 2), 28);
}

TEST(Calendar, SiderealTimeOfExample12a) {
    const double day = julian_day({1987, 4, 10, 0.0});
    const Ecliptic ecliptic = ecliptic_at(julian_centuries(day)); // 22.a: -3.788", 23 deg 26' 36.850"
    EXPECT_NEAR(degrees(ecliptic.nutation_rad) * 3600.0, -3.788, 0.5);
    EXPECT_NEAR(degrees(ecliptic.obliquity_rad) * 3600.0, 84396.850, 0.1);
    EXPECT_NEAR(degrees(sidereal_time_rad(day, ecliptic.nutation_rad, ecliptic.obliquity_rad)),
                15.0 * (13.0 + 10.0 / 60.0 + 46.1351 / 3600.0), 2e-4);
}

/// Observed: 56.86 s in 1990, 63.83 s in 2000, 69.4 s in 2020 (IERS).
TEST(Calendar, DeltaTOfTheAlmanacs) {
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

TEST(Moon, Example47a) {
    const CelestialPlace moon = moon_place(julian_centuries(2448724.5)); // 1992 April 12, 0 h TD
    EXPECT_NEAR(degrees(moon.longitude_rad), 133.167265, 2e-4);
    EXPECT_NEAR(degrees(moon.latitude_rad), -3.229126, 1e-6);
    EXPECT_NEAR(moon.distance_km, 368409.7, 0.1);
    EXPECT_NEAR(degrees(moon.right_ascension_rad), 134.688470, 2e-4);
    EXPECT_NEAR(degrees(moon.declination_rad), 13.768368, 1e-4);
}

TEST(Moon, Example48a) {
    const double t = julian_centuries(2448724.5);
    const double phase = phase_angle_rad(sun_place(t), moon_place(t));
    EXPECT_NEAR(degrees(phase), 69.0756, 0.01);
}

/// 2003 October 17, 12:30:30 at UTC - 7 h; 105.1786 W, 39.742476 N; 820 hPa, 11 C: zenith 50.11162, azimuth 194.34024 degrees.
TEST(Horizon, ExampleOfTheSolarPositionAlgorithm) {
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
}

/// Meeus, chapter 16: 28.75 arc minutes at a true altitude of 32.92'; about 34' lift a sun that has set, 1' at 45 degrees.
TEST(Horizon, Refraction) {
    EXPECT_NEAR(degrees(refraction_rad(radians(32.92 / 60.0))) * 60.0, 24.6, 0.2); // 57.86' apparent less 33.1', at 1010 hPa
    EXPECT_NEAR(degrees(refraction_rad(radians(-0.5667))) * 60.0, 34.0, 1.5);
    EXPECT_NEAR(degrees(refraction_rad(radians(45.0))) * 60.0, 1.0, 0.05);
    EXPECT_EQ(refraction_rad(radians(-5.05)), 0.0);
    EXPECT_EQ(refraction_rad(radians(-90.0)), 0.0);
    for (double h = -90.0; h < 90.0; h += 0.01) // what is higher is seen higher: no jump turns the order round
        EXPECT_LE(radians(h) + refraction_rad(radians(h)), radians(h + 0.01) + refraction_rad(radians(h + 0.01))) << h;
}

TEST(Horizon, AzimuthRunsFromNorthOverEast) {
    EXPECT_NEAR(horizon_direction(0.0, 0.0).y, 1.0, 1e-15);
    EXPECT_NEAR(horizon_direction(pi / 2.0, 0.0).x, 1.0, 1e-15);
    EXPECT_NEAR(horizon_direction(1.0, pi / 2.0).z, 1.0, 1e-15);
}

} // namespace
} // namespace fernlicht
