// Display profiles in YAML.
#include "scenarios/display/display_profile.h"

#include "scenarios/values/refusals.h"
#include "scenarios/yaml/yaml_entry.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/matrix.hpp>
#include <numbers>
#include <stdexcept>

namespace fernlicht {
namespace {

// SMPTE ST 2084:2014, equations 4.1 and 5.2, and what it ends at.
constexpr double pq_max_cdm2 = 10000.0;
constexpr double pq_m1 = 2610.0 / 16384.0, pq_m2 = 128.0 * 2523.0 / 4096.0, pq_c1 = 3424.0 / 4096.0, pq_c2 = 32.0 * 2413.0 / 4096.0,
                 pq_c3 = 32.0 * 2392.0 / 4096.0;

double pq_luminance(double code) {
    const double e = std::pow(std::max(code, 0.0), 1.0 / pq_m2);
    return pq_max_cdm2 * std::pow(std::max(e - pq_c1, 0.0) / (pq_c2 - pq_c3 * e), 1.0 / pq_m1);
}

double pq_code(double luminance_cdm2) {
    const double y = std::pow(std::max(luminance_cdm2, 0.0) / pq_max_cdm2, pq_m1);
    return std::pow((pq_c1 + pq_c2 * y) / (1.0 + pq_c3 * y), pq_m2);
}

glm::dvec3 unit_xyz(const glm::dvec2& chromaticity) {
    if (!(chromaticity.y > 0.0))
        throw std::invalid_argument("a chromaticity with y <= 0 has no luminance");
    return {chromaticity.x / chromaticity.y, 1.0, (1.0 - chromaticity.x - chromaticity.y) / chromaticity.y};
}

constexpr std::size_t max_profile_bytes = std::size_t{1} << 20;
constexpr double lumens_per_watt = 683.0, min_white_cdm2 = 1.0e-3, max_cdm2 = 1.0e5,
                 rounding_of_colours = 1.0e-3; ///< of what files give to three digits

glm::dmat3 read_matrix(const YamlEntry& entry) {
    const std::vector<YamlEntry> rows = entry.list(3, 3);
    glm::dmat3 matrix;
    for (int row = 0; row < 3; ++row) {
        const std::vector<double> numbers = rows[static_cast<std::size_t>(row)].numbers(3, 3, -max_cdm2, max_cdm2);
        for (int column = 0; column < 3; ++column)
            matrix[column][row] = numbers[static_cast<std::size_t>(column)];
    }
    return matrix;
}

glm::dvec2 read_chromaticity(const YamlMap& primaries, const char* key) {
    const YamlEntry entry = primaries.require(key);
    const std::vector<double> xy = entry.numbers(2, 2, -max_cdm2, max_cdm2);
    if (xy[0] < 0.0 || xy[1] <= 0.0 || xy[0] + xy[1] > 1.0 + rounding_of_colours)
        entry.refuse(fmt::format("found [{}, {}], a chromaticity that no light has", xy[0], xy[1]),
                     "x, y with x at least 0, y above 0 and x + y at most 1");
    return {xy[0], xy[1]};
}

double read_peak(const YamlEntry& entry, double black_cdm2) {
    const double peak_cdm2 = entry.number_above(0.0, max_cdm2);
    if (!(peak_cdm2 > black_cdm2))
        entry.refuse(fmt::format("a peak of {:g} cd/m2 with black_cdm2: {:g}", peak_cdm2, black_cdm2), "more than black_cdm2");
    return peak_cdm2;
}

/// Light has no negative X, Y or Z; a rounded matrix may, by a digit.
void refuse_impossible_light(const glm::dmat3& matrix, const YamlEntry& entry) {
    for (int channel = 0; channel < 3; ++channel) {
        const glm::dvec3& light = matrix[channel];
        for (int row = 0; row < 3; ++row)
            if (light[row] < -rounding_of_colours * std::max({light.x, light.y, light.z}))
                entry.refuse(fmt::format("found a {} channel with {} = {:g}, which no light has",
                                         std::array{"red", "green", "blue"}[static_cast<std::size_t>(channel)], "XYZ"[row], light[row]),
                             "columns of X, Y, Z that are not below 0");
    }
}

/// Light of full red, green and blue, from the matrix or the primaries; luminances as the file has them or, with `white_cdm2`, scaled.
glm::dmat3 read_light(const YamlMap& keys, double black_cdm2) {
    const auto given = keys.one_of({"rgb_to_xyz", "primaries"});
    if (!given)
        keys.refuse_missing("rgb_to_xyz", "a matrix of three rows X, Y, Z, or `primaries`");
    const auto peak = keys.find("peak_cdm2");
    const double peak_cdm2 = peak ? read_peak(*peak, black_cdm2) : 0.0;
    if (given->first == "primaries") {
        const YamlMap primaries = given->second.map({"red", "green", "blue", "white"});
        if (const auto unit = keys.find("unit"))
            unit->refuse("a unit beside primaries", "none: it is that of rgb_to_xyz; primaries take peak_cdm2, in cd/m2");
        if (!peak)
            keys.refuse_missing("peak_cdm2", "the luminance of white, cd/m2; primaries alone say nothing of it");
        try {
            return xyz_from_primaries(read_chromaticity(primaries, "red"), read_chromaticity(primaries, "green"),
                                      read_chromaticity(primaries, "blue"), read_chromaticity(primaries, "white"), peak_cdm2 - black_cdm2);
        } catch (const std::invalid_argument& error) {
            given->second.refuse(error.what(), "chromaticities x, y of three primaries with white between them");
        }
    }
    glm::dmat3 matrix = read_matrix(given->second);
    const auto unit = keys.find("unit");
    if (unit && unit->choice({"cd/m2", "W/(sr m2)"}) == 1)
        matrix = lumens_per_watt * matrix;
    const double white_cdm2 = matrix[0].y + matrix[1].y + matrix[2].y;
    if (!(white_cdm2 >= min_white_cdm2 && white_cdm2 <= max_cdm2))
        given->second.refuse(fmt::format("a white of {:.3g} cd/m2", white_cdm2), fmt::format("{:g} to {:g}", min_white_cdm2, max_cdm2));
    if (peak)
        matrix *= (peak_cdm2 - black_cdm2) / white_cdm2;
    refuse_impossible_light(matrix, given->second);
    if (matrix[0].y < 0.0 || matrix[1].y < 0.0 || matrix[2].y < 0.0)
        given->second.refuse("a channel of negative luminance", "a row Y of numbers that are not below 0");
    const double scale = std::cbrt(std::abs(glm::determinant(matrix)));
    if (!(scale > 1.0e-4 * (matrix[0].y + matrix[1].y + matrix[2].y)))
        given->second.refuse("channels that mix to no plane of colours", "three columns that differ: the matrix must have an inverse");
    return matrix;
}

void read_transfer(const YamlMap& keys, DisplayProfile& profile) {
    const YamlEntry transfer = keys.require("transfer");
    if (transfer.is_scalar()) {
        constexpr TransferKind kinds[] = {TransferKind::linear, TransferKind::srgb, TransferKind::pq};
        profile.transfer = kinds[transfer.choice({"linear", "srgb", "pq"})];
        return;
    }
    profile.transfer = TransferKind::gamma;
    profile.gamma = transfer.map({"gamma"}).require("gamma").number(0.1, 10.0);
}

void refuse_white_beyond_pq(const YamlMap& keys, const DisplayProfile& profile) {
    if (profile.transfer != TransferKind::pq || profile.peak_cdm2() <= pq_max_cdm2 * (1.0 + 1.0e-9))
        return;
    const auto peak = keys.find("peak_cdm2");
    (peak ? *peak : keys.require("rgb_to_xyz"))
        .refuse(fmt::format("a peak of {:g} cd/m2 with transfer: pq", profile.peak_cdm2()),
                fmt::format("at most {:g}, where the codes of SMPTE ST 2084 end", pq_max_cdm2));
}

} // namespace

double DisplayProfile::white_cdm2() const { return xyz_from_rgb[0].y + xyz_from_rgb[1].y + xyz_from_rgb[2].y; }

std::optional<double> DisplayProfile::pixel_deg() const {
    if (!viewing_distance_m || !pixel_pitch_mm)
        return std::nullopt;
    return 2.0 * std::atan(0.5e-3 * *pixel_pitch_mm / *viewing_distance_m) * 180.0 / std::numbers::pi;
}

glm::dmat3 xyz_from_light() { return {{0.4124, 0.2126, 0.0193}, {0.3576, 0.7152, 0.1192}, {0.1805, 0.0722, 0.9505}}; }

DisplayProfile srgb_display() { return {.name = "srgb", .title = "sRGB reference display", .xyz_from_rgb = 80.0 * xyz_from_light()}; }

bool is_srgb(const DisplayProfile& profile) {
    if (profile.transfer != TransferKind::srgb || profile.bits != 8)
        return false;
    const glm::dmat3 light = xyz_from_light();
    double most = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            most = std::max(most, std::abs(profile.xyz_from_rgb[i][k] / profile.white_cdm2() - light[i][k]));
    return most < 1.0e-4;
}

glm::dmat3 xyz_from_primaries(const glm::dvec2& red, const glm::dvec2& green, const glm::dvec2& blue, const glm::dvec2& white,
                              double white_cdm2) {
    const glm::dmat3 columns(unit_xyz(red), unit_xyz(green), unit_xyz(blue));
    if (std::abs(glm::determinant(columns)) < 1.0e-6)
        throw std::invalid_argument("the primaries lie on a line");
    const glm::dvec3 shares = glm::inverse(columns) * unit_xyz(white);
    if (shares.x <= 0.0 || shares.y <= 0.0 || shares.z <= 0.0)
        throw std::invalid_argument("white lies outside the triangle of the primaries");
    glm::dmat3 matrix;
    for (int i = 0; i < 3; ++i)
        matrix[i] = columns[i] * (shares[i] * white_cdm2);
    return matrix;
}

double decoded(const DisplayProfile& profile, double code) {
    switch (profile.transfer) {
    case TransferKind::linear:
        return code;
    case TransferKind::gamma:
        return std::pow(code, profile.gamma);
    case TransferKind::srgb:
        return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    case TransferKind::pq:
        return pq_luminance(code) / profile.white_cdm2();
    }
    return 0.0;
}

double encoded(const DisplayProfile& profile, double share) {
    switch (profile.transfer) {
    case TransferKind::linear:
        return share;
    case TransferKind::gamma:
        return std::pow(share, 1.0 / profile.gamma);
    case TransferKind::srgb:
        return share <= 0.0031308 ? 12.92 * share : 1.055 * std::pow(share, 1.0 / 2.4) - 0.055;
    case TransferKind::pq:
        return pq_code(share * profile.white_cdm2());
    }
    return 0.0;
}

DisplayProfile read_display_profile(const std::filesystem::path& path, FilesRead& opened) {
    const YamlValue tree = parse_yaml(read_file(path, opened, max_profile_bytes), path);
    const YamlMap keys = YamlEntry(tree, path, "")
                             .map({"fernlicht_display", "title", "rgb_to_xyz", "unit", "primaries", "peak_cdm2", "black_cdm2", "transfer",
                                   "gamut", "bits", "viewing_distance_m", "pixel_pitch_mm"});
    if (const YamlEntry version = keys.require("fernlicht_display"); version.whole(0, 1000) != 1)
        version.refuse("1, the version of display profiles that this program knows");
    DisplayProfile profile;
    profile.name = path.stem().string();
    EachRead each;
    each([&] {
        const auto title = keys.find("title");
        profile.title = title ? title->text() : profile.name;
    });
    const bool has_light = each([&] {
        profile.black_cdm2 = keys.number_or("black_cdm2", 0.0, 0.0, max_cdm2);
        profile.xyz_from_rgb = read_light(keys, profile.black_cdm2);
    });
    if (each([&] { read_transfer(keys, profile); }) && has_light)
        each([&] { refuse_white_beyond_pq(keys, profile); });
    each([&] {
        if (const auto gamut = keys.find("gamut"))
            profile.gamut = gamut->choice({"keep-luminance", "clip"}) == 0 ? GamutRule::keep_luminance : GamutRule::clip;
    });
    profile.bits = profile.transfer == TransferKind::pq ? 16 : 8;
    each([&] {
        if (const auto bits = keys.find("bits"))
            if ((profile.bits = bits->whole(8, 16)) != 8 && profile.bits != 16)
                bits->refuse("8 or 16");
    });
    each([&] {
        if (const auto distance = keys.find("viewing_distance_m"))
            profile.viewing_distance_m = distance->number_above(0.0, 1000.0);
    });
    each([&] {
        if (const auto pitch = keys.find("pixel_pitch_mm"))
            profile.pixel_pitch_mm = pitch->number_above(0.0, 1000.0);
    });
    each.end();
    return profile;
}

std::string write_display_profile(const DisplayProfile& profile) {
    std::string text = fmt::format("fernlicht_display: 1\ntitle: {}\nrgb_to_xyz:\n", quoted(profile.title));
    for (int row = 0; row < 3; ++row)
        text += fmt::format("  - [{}, {}, {}]\n", profile.xyz_from_rgb[0][row], profile.xyz_from_rgb[1][row], profile.xyz_from_rgb[2][row]);
    const char* const kinds[] = {"linear", "gamma", "srgb", "pq"};
    text += fmt::format("unit: cd/m2\nblack_cdm2: {}\n", profile.black_cdm2);
    text += profile.transfer == TransferKind::gamma ? fmt::format("transfer: {{gamma: {}}}\n", profile.gamma)
                                                    : fmt::format("transfer: {}\n", kinds[static_cast<int>(profile.transfer)]);
    text += fmt::format("gamut: {}\nbits: {}\n", profile.gamut == GamutRule::clip ? "clip" : "keep-luminance", profile.bits);
    if (profile.viewing_distance_m)
        text += fmt::format("viewing_distance_m: {}\n", *profile.viewing_distance_m);
    if (profile.pixel_pitch_mm)
        text += fmt::format("pixel_pitch_mm: {}\n", *profile.pixel_pitch_mm);
    return text;
}

} // namespace fernlicht
