#include "scenarios/display/display_profile.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>
#include <stdexcept>

namespace fernlicht {
namespace {

// SMPTE ST 2084:2014, equations 4.1 and 5.2.
constexpr double pq_m1 = 2610.0 / 16384.0, pq_m2 = 128.0 * 2523.0 / 4096.0, pq_c1 = 3424.0 / 4096.0, pq_c2 = 32.0 * 2413.0 / 4096.0,
                 pq_c3 = 32.0 * 2392.0 / 4096.0;

double pq_luminance(double code) {
    const double e = std::pow(std::max(code, 0.0), 1.0 / pq_m2);
    return pq_most_cdm2 * std::pow(std::max(e - pq_c1, 0.0) / (pq_c2 - pq_c3 * e), 1.0 / pq_m1);
}

double pq_code(double luminance_cdm2) {
    const double y = std::pow(std::max(luminance_cdm2, 0.0) / pq_most_cdm2, pq_m1);
    return std::pow((pq_c1 + pq_c2 * y) / (1.0 + pq_c3 * y), pq_m2);
}

glm::dvec3 unit_xyz(const glm::dvec2& chromaticity) {
    if (!(chromaticity.y > 0.0))
        throw std::invalid_argument("a chromaticity with y <= 0 has no luminance");
    return {chromaticity.x / chromaticity.y, 1.0, (1.0 - chromaticity.x - chromaticity.y) / chromaticity.y};
}

} // namespace

double DisplayProfile::white_cdm2() const { return xyz_from_rgb[0].y + xyz_from_rgb[1].y + xyz_from_rgb[2].y; }

std::optional<double> DisplayProfile::pixel_deg() const {
    if (!viewing_distance_m || !pixel_pitch_mm)
        return std::nullopt;
    return 2.0 * std::atan(0.5e-3 * *pixel_pitch_mm / *viewing_distance_m) * 180.0 / std::numbers::pi;
}

glm::dmat3 xyz_from_light() { return {{0.4124, 0.2126, 0.0193}, {0.3576, 0.7152, 0.1192}, {0.1805, 0.0722, 0.9505}}; }

DisplayProfile srgb_display() {
    DisplayProfile profile;
    profile.name = "srgb";
    profile.title = "sRGB reference display";
    profile.xyz_from_rgb = 80.0 * xyz_from_light();
    return profile;
}

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

} // namespace fernlicht
