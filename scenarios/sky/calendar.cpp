#include "scenarios/sky/calendar.h"

#include "scenarios/values/pose.h"

#include <cmath>

namespace fernlicht {

int days_in_month(int year, int month) {
    const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return month == 2 ? (leap ? 29 : 28) : (month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31);
}

double julian_day(const CalendarTime& time) {
    const int y = time.month > 2 ? time.year : time.year - 1, m = time.month > 2 ? time.month : time.month + 12;
    const double century = std::floor(y / 100.0), leap = 2.0 - century + std::floor(century / 4.0);
    return std::floor(365.25 * (y + 4716)) + std::floor(30.6001 * (m + 1)) + time.day + leap - 1524.5 + time.hours_ut / 24.0;
}

double delta_t_s(double julian_day_ut) {
    const double year = 2000.0 + (julian_day_ut - 2451544.5) / 365.2425, t = year - 2000.0;
    if (year >= 1986.0 && year < 2005.0)
        return 63.86 + t * (0.3345 + t * (-0.060374 + t * (0.0017275 + t * (0.000651814 + t * 0.00002373599))));
    if (year >= 2005.0 && year < 2050.0)
        return 62.92 + t * (0.32217 + t * 0.005589);
    const double u = (year - 1820.0) / 100.0;
    return -20.0 + 32.0 * u * u;
}

double julian_centuries(double julian_day_tt) { return (julian_day_tt - 2451545.0) / 36525.0; }

double sidereal_time_rad(double julian_day_ut, double nutation_rad, double obliquity_rad) {
    const double days = julian_day_ut - 2451545.0, t = days / 36525.0;
    const double mean_deg = 280.46061837 + 360.98564736629 * days + t * t * (0.000387933 - t / 38710000.0);
    const double angle = radians(std::fmod(mean_deg, 360.0)) + nutation_rad * std::cos(obliquity_rad);
    return angle - 2.0 * pi * std::floor(angle / (2.0 * pi));
}

} // namespace fernlicht
