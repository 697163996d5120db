#include "scenarios/sky/weather.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double db_in_nepers = 0.23025850929940457; // of power: ln(10) / 10
constexpr double rain_asymmetry = 0.88, snow_asymmetry = 0.80;

} // namespace

double extinction_of_range_per_m(double range_m, double contrast) { return -std::log(contrast) / range_m; }

Weather rain(Intensity intensity) {
    static constexpr double mm_h[] = {2.5, 7.6, 25.0}, wetness[] = {0.5, 1.0, 1.0};
    const auto i = static_cast<std::size_t>(intensity);
    const double db_per_km = 1.076 * std::pow(mm_h[i], 0.67);
    return {db_per_km * db_in_nepers / 1000.0, 1.0, rain_asymmetry, wetness[i]};
}

Weather snow(Intensity intensity) {
    static constexpr double range_m[] = {1500.0, 750.0, 350.0};
    return {extinction_of_range_per_m(range_m[static_cast<std::size_t>(intensity)]), 1.0, snow_asymmetry, 0.0};
}

Weather together(const Weather& a, const Weather& b) {
    const double scattered_a = a.extinction_per_m * a.scattering_albedo, scattered_b = b.extinction_per_m * b.scattering_albedo;
    Weather both = a;
    both.wetness = std::max(a.wetness, b.wetness);
    both.extinction_per_m = a.extinction_per_m + b.extinction_per_m;
    if (b.extinction_per_m <= 0.0)
        return both;
    both.scattering_albedo = (scattered_a + scattered_b) / both.extinction_per_m;
    if (scattered_a + scattered_b > 0.0)
        both.asymmetry = (scattered_a * a.asymmetry + scattered_b * b.asymmetry) / (scattered_a + scattered_b);
    return both;
}

} // namespace fernlicht
