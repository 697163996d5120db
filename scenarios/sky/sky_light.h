// How much light sun, moon and sky give, by their altitude: "Recommended practice for the calculation of daylight availability", IES 1984
// (RP-21), by day; Explanatory Supplement to the Astronomical Almanac (Seidelmann 1992, 9.3) through twilight and for the moon.
#pragma once

namespace fernlicht {

enum class SkyCover { clear, partly_cloudy, overcast };

/// Direct light on a plane perpendicular to it, and diffuse light of the sky on a horizontal one.
struct SkyLight {
    double direct_lx = 0.0, diffuse_lx = 0.0;
};

/// Perpendicular to the sun outside the atmosphere: 127.5 klx at the mean distance (IES 1984).
double extraterrestrial_lx(double distance_km);

/// Of the sun, from day through twilight into the night. Above 2 degrees: extinction exp(-c m) with c = 0.21 clear, 0.80 partly cloudy, no
/// direct sun under overcast; sky A + B sin^C h. With the sun down the Supplement's illuminance of a clear sky, times 0.3/0.8 under clouds
/// (the IES ratio at the horizon); between 0.83 degrees below and 2 above, the logarithm goes linearly from one to the other. Below -18
/// degrees what is left is the moonless night's 0.65 mlx.
SkyLight sun_light(double altitude_rad, double apparent_altitude_rad, double distance_km, SkyCover cover);

/// Of the moon: the sun's, as far as it is above the horizon, scaled by the ratio of full moon and sun at the zenith (2.1e-6), by the
/// Supplement's law of the phase, and by the square of the distance.
SkyLight moon_light(double apparent_altitude_rad, double distance_km, double phase_angle_rad, SkyCover cover);

/// The Supplement's fits themselves: horizontal illuminance, lx, under a clear sky of sun and sky (-18 to 90 degrees; constant beyond), and
/// of the full moon at its mean distance with its sky (0 below -0.8 degrees).
double supplement_sun_lx(double altitude_rad);
double supplement_full_moon_lx(double altitude_rad);

} // namespace fernlicht
