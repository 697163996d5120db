#include "metrics/display/camera_picture.h"

#include "metrics/display/scatter.h"
#include "scenarios/values/mixed_bits.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tbb/parallel_for.h>

namespace fernlicht {
namespace {

/// Above 0, up to 1.
double uniform(std::uint64_t n) { return (static_cast<double>(next_mixed(n) >> 11) + 1.0) * 0x1p-53; }

/// Box and Muller 1958.
double normal_deviate(std::uint64_t seed, std::uint64_t n) {
    const std::uint64_t first = next_mixed(seed) + 2 * n;
    return std::sqrt(-2.0 * std::log(uniform(first))) * std::cos(2.0 * std::numbers::pi * uniform(first + 1));
}

DisplayProfile with_tone(const CameraSettings& camera) {
    DisplayProfile profile = srgb_display();
    profile.transfer = camera.tone;
    profile.gamma = camera.gamma;
    return profile;
}

} // namespace

double camera_code(const CameraSettings& camera, double share) { return encoded(with_tone(camera), std::clamp(share, 0.0, 1.0)); }

Image<glm::u16vec3> camera_picture(const CameraSettings& camera, const Image<glm::vec3>& light, double vertical_fov_rad,
                                   const std::optional<glm::dmat3>& white, std::uint64_t seed) {
    const Image<glm::vec3> seen = scattered(light, vertical_fov_rad, windscreen_scatter(camera.bloom));
    const glm::dmat3 balanced = white.value_or(glm::dmat3(1.0));
    const DisplayProfile tone = with_tone(camera);
    const double saturation_cdm2 = camera.saturation_cdm2(), full = camera.saturation_e, read = camera.read_noise_e;
    Image<glm::u16vec3> codes(seen.width(), seen.height());
    tbb::parallel_for(0, seen.height(), [&](int y) {
        for (int x = 0; x < seen.width(); ++x) {
            const glm::dvec3 shares = balanced * glm::dvec3(seen.at(x, y)) / saturation_cdm2;
            const std::uint64_t first =
                3 * (static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(seen.width()) + static_cast<std::uint64_t>(x));
            for (int i = 0; i < 3; ++i) {
                double share = std::max(shares[i], 0.0);
                if (full > 0.0) {
                    const double electrons = share * full;
                    share += std::sqrt(electrons + read * read) / full * normal_deviate(seed, first + static_cast<std::uint64_t>(i));
                }
                codes.at(x, y)[i] = static_cast<std::uint16_t>(std::lround(255.0 * encoded(tone, std::clamp(share, 0.0, 1.0))));
            }
        }
    });
    return codes;
}

} // namespace fernlicht
