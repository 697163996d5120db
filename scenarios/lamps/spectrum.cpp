#include "scenarios/lamps/spectrum.h"

#include "scenarios/lamps/lamp_text.h"
#include "scenarios/lamps/spectral_tables.h"
#include "scenarios/values/refusals.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <stdexcept>
#include <string_view>

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

constexpr std::size_t max_samples = 100000;
constexpr double needed_from_nm = 400.0, needed_to_nm = 700.0, coarsest_nm = 20.0;

constexpr std::string_view field_separators = ",;\t \r";

std::optional<double> number_of(std::string_view field) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::string quoted(std::string_view text) { return "'" + printable(std::string(text), 40) + "'"; }

/// One line of the file; false when it is one to be skipped.
bool add_sample(std::string_view line, const InputError::Where& where, Spectrum& s, bool names_allowed) {
    const auto fields = words_of(line, field_separators);
    if (fields.empty() || fields[0].front() == '#')
        return false;
    const std::optional<double> nm = number_of(fields[0]);
    const std::optional<double> power = fields.size() == 2 ? number_of(fields[1]) : std::nullopt;
    if (!nm && names_allowed)
        return false;
    if (!nm || !power) {
        std::string by_blanks(line);
        std::replace(by_blanks.begin(), by_blanks.end(), ';', ' ');
        refuse_decimal_commas(by_blanks, where.line - 1, where.file);
        throw InputError(where, "found " + quoted(line), "a wavelength in nm and a relative power");
    }
    if (*nm <= 0.0 || (!s.wavelength_nm.empty() && *nm <= s.wavelength_nm.back()))
        throw InputError(where, fmt::format("found wavelength {} nm", *nm), "wavelengths above 0 that ascend from line to line");
    if (*power < 0.0)
        throw InputError(where, fmt::format("found power {}", *power), "a relative power of 0 or more");
    if (s.power.size() == max_samples)
        throw InputError(where, fmt::format("found more than {} samples", max_samples), "a spectrum in nm");
    s.wavelength_nm.push_back(*nm);
    s.power.push_back(*power);
    return true;
}

void check_coverage(const Spectrum& s, const std::filesystem::path& path) {
    const auto& nm = s.wavelength_nm;
    if (nm.empty() || nm.front() > needed_from_nm || nm.back() < needed_to_nm) {
        const std::string found =
            nm.empty() ? "found no samples" : fmt::format("found samples from {} to {} nm only", nm.front(), nm.back());
        throw InputError({path, 0, 0, {}}, found, "the visible range, at least 400 to 700 nm");
    }
    for (std::size_t i = 1; i < nm.size(); ++i)
        if (nm[i] - nm[i - 1] > coarsest_nm && nm[i] > needed_from_nm && nm[i - 1] < needed_to_nm)
            throw InputError({path, 0, 0, {}}, fmt::format("found nothing between {} and {} nm", nm[i - 1], nm[i]),
                             "steps of at most 20 nm");
}

Spectrum read_spectrum_file(const std::filesystem::path& path, FilesRead& opened) {
    const std::string content = lamp_text(read_file(path, opened, std::size_t{16} << 20), path);
    Spectrum s;
    bool names_seen = false;
    std::size_t line_number = 0;
    EachRead each;
    for (std::size_t begin = 0; begin < content.size();) {
        const std::size_t end = std::min(content.find('\n', begin), content.size());
        const std::string_view line(content.data() + begin, end - begin);
        ++line_number;
        const bool may_be_names = s.power.empty() && !names_seen;
        bool sample = true;
        each([&] { sample = add_sample(line, {path, line_number, 0, {}}, s, may_be_names); });
        const auto fields = words_of(line, field_separators);
        names_seen = names_seen || (!sample && !fields.empty() && fields[0].front() != '#');
        begin = end + 1;
    }
    each.end();
    check_coverage(s, path);
    if (std::none_of(s.power.begin(), s.power.end(), [](double p) { return p > 0.0; }))
        throw InputError({path, 0, 0, {}}, "found a power of 0 at every wavelength", "a lamp that gives light");
    return s;
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

LampColour read_spectrum(const std::filesystem::path& path, FilesRead& opened) {
    const Spectrum spectrum = read_spectrum_file(path, opened);
    const VisualIntegrals i = visual_integrals(spectrum);
    if (!(i.y > 0.0) || !std::isfinite(i.x + i.y + i.z + i.scotopic))
        throw InputError({path, 0, 0, {}}, "found no finite amount of visible light",
                         "relative powers of ordinary size between 380 and 780 nm");
    return colour_of_spectrum(spectrum);
}

} // namespace fernlicht
