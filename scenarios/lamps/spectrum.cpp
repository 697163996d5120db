#include "scenarios/lamps/spectrum.h"

#include "scenarios/lamps/spectral_tables.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double step_nm = 1.0;
// Most lumens a watt can give by cones at 555 nm and by rods (CIE 018:2019).
constexpr double km_lm_per_w = 683.0, km_scotopic_lm_per_w = 1700.0;
constexpr double coolest_k = 1000.0, hottest_k = 25000.0;

SpectralWeights weights_at(double nm) {
    const double at = (nm - spectral_table_first_nm) / spectral_table_step_nm;
    const auto i = std::min(static_cast<std::size_t>(at), spectral_table.size() - 2);
    const double t = at - static_cast<double>(i);
    const SpectralWeights &a = spectral_table[i], &b = spectral_table[i + 1];
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z), a.scotopic + t * (b.scotopic - a.scotopic)};
}

double power_at(const Spectrum& s, double nm) {
    if (s.wavelength_nm.empty() || nm < s.wavelength_nm.front() || nm > s.wavelength_nm.back())
        return 0.0;
    const auto above = std::lower_bound(s.wavelength_nm.begin(), s.wavelength_nm.end(), nm);
    const auto i = static_cast<std::size_t>(above - s.wavelength_nm.begin());
    if (*above == nm)
        return s.power[i];
    const double t = (nm - s.wavelength_nm[i - 1]) / (s.wavelength_nm[i] - s.wavelength_nm[i - 1]);
    return s.power[i - 1] + t * (s.power[i] - s.power[i - 1]);
}

struct Chromaticity1960 {
    double u, v;
};

Chromaticity1960 chromaticity(const VisualIntegrals& i) {
    const double sum = i.x + 15.0 * i.y + 3.0 * i.z;
    return {4.0 * i.x / sum, 6.0 * i.y / sum};
}

double distance_to_planck(const Chromaticity1960& c, double kelvin) {
    const Chromaticity1960 p = chromaticity(visual_integrals(planck_spectrum(kelvin)));
    return std::hypot(c.u - p.u, c.v - p.v);
}

/// Golden section over the reciprocal temperature, in which the locus is run through evenly and the distance has one minimum.
double correlated_temperature_k(const Chromaticity1960& c) {
    const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
    double low = 1e6 / hottest_k, high = 1e6 / coolest_k; // mired
    double a = high - ratio * (high - low), b = low + ratio * (high - low);
    double at_a = distance_to_planck(c, 1e6 / a), at_b = distance_to_planck(c, 1e6 / b);
    while (high - low > 1e-4) {
        if (at_a < at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - ratio * (high - low);
            at_a = distance_to_planck(c, 1e6 / a);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + ratio * (high - low);
            at_b = distance_to_planck(c, 1e6 / b);
        }
    }
    const double kelvin = 2e6 / (low + high);
    return distance_to_planck(c, kelvin) <= 0.05 ? kelvin : 0.0;
}

/// Linear sRGB (IEC 61966-2-1) of luminance 1. A colour outside the gamut moves towards grey of the same luminance until it fits.
glm::dvec3 linear_srgb(const VisualIntegrals& i) {
    const double x = i.x / i.y, y = 1.0, z = i.z / i.y;
    glm::dvec3 rgb{3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                   0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
    if (const double lowest = std::min({rgb.x, rgb.y, rgb.z}); lowest < 0.0)
        rgb = glm::dvec3(1.0) + (rgb - glm::dvec3(1.0)) * (1.0 / (1.0 - lowest));
    rgb = glm::dvec3(std::max(rgb.x, 0.0), std::max(rgb.y, 0.0), std::max(rgb.z, 0.0));
    return rgb / (0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z);
}

} // namespace

Spectrum planck_spectrum(double kelvin) {
    if (!(kelvin > 0.0) || !std::isfinite(kelvin))
        throw std::invalid_argument("planck_spectrum: a temperature above 0 K is needed");
    constexpr double c2_nm_k = 1.438776877e7; // h c / k, SI 2019
    Spectrum s;
    for (double nm = spectral_table_first_nm; nm <= spectral_table_last_nm; nm += step_nm) {
        s.wavelength_nm.push_back(nm);
        s.power.push_back(std::pow(560.0 / nm, 5.0) * std::expm1(c2_nm_k / (560.0 * kelvin)) / std::expm1(c2_nm_k / (nm * kelvin)));
    }
    return s;
}

VisualIntegrals visual_integrals(const Spectrum& spectrum) {
    VisualIntegrals sum;
    for (double nm = spectral_table_first_nm; nm <= spectral_table_last_nm; nm += step_nm) {
        const double power = power_at(spectrum, nm) * step_nm;
        const SpectralWeights w = weights_at(nm);
        sum.x += power * w.x;
        sum.y += power * w.y;
        sum.z += power * w.z;
        sum.scotopic += power * w.scotopic;
    }
    return sum;
}

LampColour colour_of_spectrum(const Spectrum& spectrum) {
    const VisualIntegrals i = visual_integrals(spectrum);
    if (!(i.y > 0.0) || !std::isfinite(i.x + i.y + i.z + i.scotopic))
        throw std::invalid_argument("colour_of_spectrum: a spectrum with visible light is needed");
    return {linear_srgb(i), km_scotopic_lm_per_w * i.scotopic / (km_lm_per_w * i.y), correlated_temperature_k(chromaticity(i))};
}

LampColour colour_of_temperature(double kelvin) {
    if (!(kelvin >= coolest_k && kelvin <= hottest_k))
        throw std::invalid_argument("colour_of_temperature: 1000 to 25000 K is the range");
    LampColour colour = colour_of_spectrum(planck_spectrum(kelvin));
    colour.cct_k = kelvin;
    return colour;
}

} // namespace fernlicht
