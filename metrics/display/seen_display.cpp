#include "metrics/display/seen_display.h"

#include "metrics/display/night_vision.h"

#include <cmath>
#include <numbers>

namespace fernlicht {
namespace {

constexpr double arcmin_a_rad = 60.0 * 180.0 / std::numbers::pi;

} // namespace

SeenSize seen_size(double vertical_fov_rad, int height_px, double pixel_pitch_mm, double viewing_distance_m) {
    const double half = std::tan(0.5 * vertical_fov_rad), pitch_m = 1.0e-3 * pixel_pitch_mm;
    return {2.0 * arcmin_a_rad * std::atan(half / height_px), 2.0 * arcmin_a_rad * std::atan(0.5 * pitch_m / viewing_distance_m),
            0.5 * height_px * pitch_m / half};
}

double resolved_arcmin(double adaptation_cdm2) { return 30.0 / acuity_cycles_per_deg(adaptation_cdm2); }

} // namespace fernlicht
