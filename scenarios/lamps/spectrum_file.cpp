#include "scenarios/lamps/spectrum.h"

#include "scenarios/lamps/lamp_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace fernlicht {
namespace {

constexpr std::size_t most_samples = 100000;
constexpr double needed_from_nm = 400.0, needed_to_nm = 700.0, coarsest_nm = 20.0;

bool is_separator(char c) { return c == ',' || c == ';' || c == '\t' || c == ' ' || c == '\r'; }

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t i = 0; i < line.size();) {
        while (i < line.size() && is_separator(line[i]))
            ++i;
        const std::size_t begin = i;
        while (i < line.size() && !is_separator(line[i]))
            ++i;
        if (i > begin)
            fields.push_back(line.substr(begin, i - begin));
    }
    return fields;
}

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
    const auto fields = fields_of(line);
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
    if (s.power.size() == most_samples)
        throw InputError(where, fmt::format("found more than {} samples", most_samples), "a spectrum in nm");
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

} // namespace

Spectrum read_spectrum_file(const std::filesystem::path& path, FilesRead& opened) {
    const std::string content = lamp_text(read_file(path, opened, std::size_t{16} << 20), path);
    Spectrum s;
    bool names_seen = false;
    std::size_t line_number = 0;
    for (std::size_t begin = 0; begin < content.size();) {
        const std::size_t end = std::min(content.find('\n', begin), content.size());
        const std::string_view line(content.data() + begin, end - begin);
        ++line_number;
        const bool may_be_names = s.power.empty() && !names_seen;
        const bool sample = add_sample(line, {path, line_number, 0, {}}, s, may_be_names);
        const auto fields = fields_of(line);
        names_seen = names_seen || (!sample && !fields.empty() && fields[0].front() != '#');
        begin = end + 1;
    }
    check_coverage(s, path);
    if (std::none_of(s.power.begin(), s.power.end(), [](double p) { return p > 0.0; }))
        throw InputError({path, 0, 0, {}}, "found a power of 0 at every wavelength", "a lamp that gives light");
    return s;
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
