// How two linear pictures differ.
#pragma once

#include "scenarios/values/image.h"

namespace fernlicht {

struct ImageDifference {
    double maximum = 0.0; ///< largest |a - b|
    int maximum_x = 0, maximum_y = 0;
    double rmse = 0.0;
    /// 20 log10(peak / rmse) with peak = largest value of the reference. +infinity where nothing differs, -infinity where the
    /// reference is black: callers report both as not measured.
    double psnr_db = 0.0;
    bool identical = false;
    double percent_over = 0.0; ///< share of pixels, 0..100, with |a - b| > threshold_absolute + threshold_relative * |reference|
};
/// Throws std::invalid_argument for different sizes, empty pictures, NaN or infinity in either (with the first such pixel).
ImageDifference compare_images(const Image<float>& tested, const Image<float>& reference, double threshold_absolute,
                               double threshold_relative);

} // namespace fernlicht
