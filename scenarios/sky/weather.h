// What is in the air and on the road: a homogeneous medium that takes light and scatters it, and water on the surfaces.
#pragma once

#include <string_view>

namespace fernlicht {

/// Default: clear and dry, which costs nothing.
struct Weather {
    double extinction_per_m = 0.0;  ///< share of light lost per metre (scattered and absorbed), for visible light
    double scattering_albedo = 1.0; ///< share of that which is scattered; droplets absorb next to nothing in the visible
    double asymmetry = 0.85;        ///< g of the Henyey-Greenstein phase function, the mean cosine of scattering; 0..0.9
    double wetness = 0.0;           ///< of surfaces that lie open: 0 dry .. 1 under a film of water

    bool operator==(const Weather&) const = default;
};

enum class Intensity { light, moderate, heavy };

/// Koschmieder: extinction from the meteorological range at which a black object's contrast with the horizon falls to `contrast`:
/// -ln(contrast) / V. 0.02 gives 3.912 / V (Koschmieder 1924), 0.05 gives 2.996 / V (WMO, meteorological optical range).
double extinction_of_range_per_m(double range_m, double contrast = 0.05);

/// Fog's drops of some 10 um: g 0.85, albedo 1 (Mie theory gives 0.84 to 0.87 at 550 nm).
inline constexpr double fog_asymmetry = 0.85;

/// Rain of 2.5, 7.6 and 25 mm/h, the upper bounds of "light" and "moderate" and a value within "heavy" (AMS, Glossary of Meteorology):
/// 1.076 R^0.67 dB/km (Carbonneau and Wisely 1998, as in ITU-R P.1814). g 0.88: large spheres of water, diffraction included.
Weather rain(Intensity intensity);
/// Snow by the visibility that defines its classes (AMS): 1500 m for light (above 1000), 750 m moderate (500 to 1000), 350 m heavy (below
/// 500), as extinction at 5 % contrast. g 0.80: between compact crystals (0.75) and drops.
Weather snow(Intensity intensity);

/// Two media in one place: extinctions add; albedo and asymmetry are means by what each scatters. Wetness: the larger.
Weather together(const Weather& a, const Weather& b);

} // namespace fernlicht
