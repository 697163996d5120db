#include "scenarios/sky/sky_light.h"

#include "scenarios/sky/ephemeris.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace fernlicht {
namespace {

constexpr double mean_moon_km = 384400.0;
constexpr double disc_radius_rad = radians(0.2667);                  // of sun and moon alike
constexpr double set_rad = radians(-0.8333), day_rad = radians(2.0); // twilight's model up to here, day's from here

struct CoverFigures {
    double extinction, a_lx, b_lx, c, twilight;
};
/// IES 1984, table 1 and equations of the sky's illuminance; klx there.
CoverFigures figures_of(SkyCover cover) {
    static constexpr CoverFigures figures[]{
        {0.21, 800.0, 15500.0, 0.5, 1.0}, {0.80, 300.0, 45000.0, 1.0, 0.375}, {HUGE_VAL, 300.0, 21000.0, 1.0, 0.375}};
    return figures[static_cast<std::size_t>(cover)];
}

/// Horizontal, of the sky by day; the sun's disc at and below the horizon counts as at it.
double day_sky_lx(const CoverFigures& f, double apparent_rad) {
    return f.a_lx + f.b_lx * std::pow(std::max(std::sin(apparent_rad), 0.0), f.c);
}

/// Share of a disc above the horizon whose centre stands at this altitude.
double risen_share(double apparent_rad) {
    const double x = std::clamp(apparent_rad / disc_radius_rad, -1.0, 1.0);
    return 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / pi;
}

/// Relative air mass, Kasten and Young 1989; 1 at the zenith, 38 at the horizon, where it stays below.
double air_mass(double apparent_altitude_rad) {
    const double h = std::max(degrees(apparent_altitude_rad), 0.0);
    return 1.0 / (std::sin(radians(h)) + 0.50572 * std::pow(h + 6.07995, -1.6364));
}

double direct_share(const CoverFigures& f, double apparent_rad) {
    const double risen = risen_share(apparent_rad);
    return risen > 0.0 && std::isfinite(f.extinction) ? risen * std::exp(-f.extinction * air_mass(apparent_rad)) : 0.0;
}

struct Fit {
    double above_deg, l0, l1, l2, l3; // log10 of lx, in powers of altitude / 90 degrees
};
/// By the first that reaches so low; 0 below the last.
double fitted(std::span<const Fit> fits, double altitude_deg) {
    const auto fit = std::ranges::find_if(fits, [&](const Fit& f) { return altitude_deg >= f.above_deg; });
    const double x = altitude_deg / 90.0;
    return fit == fits.end() ? 0.0 : std::pow(10.0, fit->l0 + x * (fit->l1 + x * (fit->l2 + x * fit->l3)));
}

} // namespace

double extraterrestrial_lx(double distance_km) {
    const double relative = astronomical_unit_km / distance_km;
    return 127500.0 * relative * relative;
}

double supplement_sun_lx(double altitude_rad) {
    static constexpr Fit fits[] = {{20.0, 3.74, 3.97, -4.07, 1.47},         {5.0, 3.05, 13.28, -45.98, 64.33},
                                   {-0.8, 2.88, 22.26, -207.64, 1034.30},   {-5.0, 2.88, 21.81, -258.11, -858.36},
                                   {-12.0, 2.70, 12.17, -431.69, -1899.83}, {-18.0, 13.84, 262.72, 1447.42, 2797.93}};
    return fitted(fits, std::clamp(degrees(altitude_rad), -18.0, 90.0));
}

double supplement_full_moon_lx(double altitude_rad) {
    static constexpr Fit fits[] = {
        {20.0, -1.95, 4.06, -4.24, 1.56}, {5.0, -2.58, 12.58, -42.58, 59.06}, {-0.8, -2.79, 24.27, -252.95, 1321.29}};
    return fitted(fits, degrees(altitude_rad));
}

SkyLight sun_light(double altitude_rad, double apparent_altitude_rad, double distance_km, SkyCover cover) {
    const CoverFigures f = figures_of(cover);
    SkyLight light{extraterrestrial_lx(distance_km) * direct_share(f, apparent_altitude_rad), 0.0};
    const double day = day_sky_lx(f, apparent_altitude_rad), night = f.twilight * supplement_sun_lx(altitude_rad);
    const double share = std::clamp((altitude_rad - set_rad) / (day_rad - set_rad), 0.0, 1.0);
    light.diffuse_lx = share >= 1.0 ? day : share <= 0.0 ? night : std::exp(std::lerp(std::log(night), std::log(day), share));
    return light;
}

SkyLight moon_light(double apparent_altitude_rad, double distance_km, double phase_angle_rad, SkyCover cover) {
    const double full_moon_share = supplement_full_moon_lx(pi / 2.0) / supplement_sun_lx(pi / 2.0);
    const double i = degrees(phase_angle_rad), relative = mean_moon_km / distance_km;
    const double phase = std::pow(10.0, -8.68e-3 * i - 2.2e-9 * i * i * i * i);
    const double moon = full_moon_share * phase * relative * relative, risen = risen_share(apparent_altitude_rad);
    const CoverFigures f = figures_of(cover);
    return {moon * extraterrestrial_lx(astronomical_unit_km) * direct_share(f, apparent_altitude_rad),
            risen > 0.0 ? moon * risen * day_sky_lx(f, apparent_altitude_rad) : 0.0};
}

} // namespace fernlicht
