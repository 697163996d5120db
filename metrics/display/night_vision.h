// What an eye loses at night: colours, since rods see none, and sharpness. Both follow the luminance to which the eye is adapted where it
// looks, the mean over one degree around the pixel.
// How the pictures of a drive are seen on the display that they were made for.
// How large, and how finely, a picture is seen by who looks at a display.
#pragma once

#include "scenarios/values/image.h"

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// Finest grating that an eye resolves, cycles a degree: 17.25 atan(1.4 lg L + 0.35) + 25.72 (Larson, Rushmeier, Piatko 1997, equation 13,
/// fitted to Shaler's data). L in cd/m2, > 0; 3.0 where the fit ends, at 1e-3 cd/m2 and below.
double acuity_cycles_per_deg(double adaptation_cdm2);

/// Share of the cones in what is seen: m of CIE 191 (metrics/seeing/visibility.h) for light of S/P 1. 1 from 5 cd/m2 on, 0 up to 0.005.
double cone_share(double adaptation_cdm2);

/// Rods' luminance of light in sRGB's primaries, cd/m2, so scaled that of white it is the photopic one: Y (1.33 (1 + (Y + Z) / X) - 1.68)
/// / 2.573 (Larson, Rushmeier, Piatko 1997, equation 9). Not below 0.
double rod_luminance_cdm2(const glm::dvec3& light);

/// Luminance of what one degree around each pixel has, cd/m2. A square window, cut at the picture's edges. 0 < pixel_deg.
Image<float> adaptation_cdm2(const Image<glm::vec3>& light, double pixel_deg);

/// m of the light as it is, 1 - m of it as rods see it, in `grey` (luminance 1). Pixels where m = 1 keep their bytes.
Image<glm::vec3> colours_at_night(const Image<glm::vec3>& light, double pixel_deg, const glm::dvec3& grey = glm::dvec3(1.0));

/// Blurred by a Gaussian that leaves a tenth of the finest grating: sigma = 0.3415 degrees / acuity. Where that is less than a fifth of a
/// pixel the pixels keep their bytes.
Image<glm::vec3> sharpness_at_night(const Image<glm::vec3>& light, double pixel_deg);

/// What the eye resolves by day: Landolt's rings of a visual acuity of 1.
inline constexpr double resolved_by_day_arcmin = 1.0;

/// A pixel in the middle of a perspective picture with square pixels, as the scene has it and as the beholder sees it.
struct SeenSize {
    double scene_pixel_arcmin = 0.0;   ///< 2 atan(tan(fov / 2) / height)
    double display_pixel_arcmin = 0.0; ///< 2 atan(pitch / (2 distance))
    double life_size_m = 0.0;          ///< the distance at which both are equal: height pitch / (2 tan(fov / 2))

    /// Angle on the display over angle in the scene: 1 seen as large as it is, below smaller.
    double magnification() const { return display_pixel_arcmin / scene_pixel_arcmin; }
};

/// 0 < fov < pi; height, pitch, distance > 0.
inline SeenSize seen_size(double vertical_fov_rad, int height_px, double pixel_pitch_mm, double viewing_distance_m) {
    constexpr double arcmin_a_rad = 60.0 * 180.0 / std::numbers::pi;
    const double half = std::tan(0.5 * vertical_fov_rad), pitch_m = 1.0e-3 * pixel_pitch_mm;
    return {2.0 * arcmin_a_rad * std::atan(half / height_px), 2.0 * arcmin_a_rad * std::atan(0.5 * pitch_m / viewing_distance_m),
            0.5 * height_px * pitch_m / half};
}

/// Half a period of the finest grating that an eye resolves when it is adapted to this luminance, in minutes of arc: 30 / acuity in cycles
/// a degree (acuity_cycles_per_deg). cd/m2 > 0; 9.98 at 1e-3 cd/m2 and below, where its fit ends.
inline double resolved_arcmin(double adaptation_cdm2) { return 30.0 / acuity_cycles_per_deg(adaptation_cdm2); }

struct SeenView {
    std::string view;
    SeenSize size;
    int pictures = 0; ///< stored and shown by the profile
    /// Mean of their pixels' light on the display, black included, over all of these pictures; nullopt without any.
    std::optional<double> mean_cdm2;

    bool finer_by_day() const { return size.display_pixel_arcmin <= resolved_by_day_arcmin; }
    /// At the mean luminance.
    std::optional<double> resolved() const { return mean_cdm2 ? std::optional(resolved_arcmin(*mean_cdm2)) : std::nullopt; }
};

/// Of a profile that says both where it is looked at from and how large its pixels are; of all perspective views.
struct SeenDisplay {
    std::string profile;
    double viewing_distance_m = 0.0, pixel_pitch_mm = 0.0;
    std::vector<SeenView> views;
};

} // namespace fernlicht
