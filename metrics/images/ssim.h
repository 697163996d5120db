// Structural similarity: 1 for the same picture, towards 0 (and below, where structures are each other's negatives) for different ones.
// SSIM: Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to structural similarity" (2004).
// MS-SSIM: Wang, Simoncelli, Bovik, "Multiscale structural similarity for image quality assessment" (2003).
//
// A window of 11 x 11 weights (Gaussian, standard deviation 1.5) goes over every pixel. At the picture's edges it sees the picture mirrored
// about its outermost pixels (OpenCV's BORDER_REFLECT_101), so that edges count as much as the middle; the authors' own program leaves out
// the five outermost pixels instead. On one 8-bit channel with range 255, mean() is what OpenCV's QualitySSIM computes for that channel.
#pragma once

#include "scenarios/values/image.h"

#include <optional>

namespace fernlicht {

struct Ssim {
    double mean = 1.0;
    double minimum = 1.0; ///< least similar pixel
    int minimum_x = 0, minimum_y = 0;
};

/// `range`: of the values, 255 for 8-bit pictures, above 0; K1 = 0.01 and K2 = 0.03 of it keep the quotients from 0 / 0.
/// Throws std::invalid_argument for different sizes, empty pictures, values that are not finite, and a range that is not above 0.
Ssim ssim(const Image<float>& tested, const Image<float>& reference, double range);

/// The least width and height for five scales: the window still fits into the coarsest.
inline constexpr int smallest_for_ms_ssim_px = 161;

/// Five scales, each half as fine as the one before (means of 2 x 2 pixels; an odd last one counts twice): contrast and structure of the
/// first four and all of the coarsest, to the powers 0.0448, 0.2856, 0.3001, 0.2363 and 0.1333. A scale whose mean is below 0 counts as 0,
/// since a negative number has no such power. nullopt for pictures smaller than smallest_for_ms_ssim_px either way. Throws as ssim() does.
std::optional<double> ms_ssim(const Image<float>& tested, const Image<float>& reference, double range);

} // namespace fernlicht
