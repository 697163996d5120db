// Dates as astronomers count them. Gregorian calendar throughout.
#pragma once

namespace fernlicht {

/// A moment by date and universal time.
struct CalendarTime {
    int year = 2000, month = 1, day = 1; ///< 1 <= month <= 12
    double hours_ut = 0.0;               ///< may lie outside 0..24: it then counts into the neighbouring days
};

/// Days from year 1 on that month has.
int days_in_month(int year, int month);

/// Julian day of universal time (Meeus, Astronomical Algorithms, 7.1).
double julian_day(const CalendarTime& time);

/// Seconds by which dynamical time is ahead of universal time: Espenak and Meeus (NASA, Five Millennium Canon of Solar Eclipses) for
/// 1986 to 2050; their long-term parabola elsewhere, which is minutes off at most between 1600 and 2200.
double delta_t_s(double julian_day_ut);

/// Julian centuries of dynamical time since J2000.0.
double julian_centuries(double julian_day_tt);

/// Apparent sidereal time at Greenwich in radians, 0..2 pi (Meeus 12.4, with the nutation of `nutation_rad` along the ecliptic).
double sidereal_time_rad(double julian_day_ut, double nutation_rad, double obliquity_rad);

} // namespace fernlicht
