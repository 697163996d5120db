// How two display pictures (8-bit sRGB) differ, in their own levels 0..255 over all three channels.
#pragma once

#include "scenarios/drives/play/frame.h"

#include <array>

namespace fernlicht {

struct DisplayDifference {
    int maximum = 0;                     ///< largest |a - b| of a channel
    int maximum_x = 0, maximum_y = 0;    ///< the first such pixel by rows
    double rmse = 0.0;                   ///< root of the mean square over pixels and channels
    double psnr_db = 0.0;                ///< 20 log10(255 / rmse): the peak is 255. +infinity where nothing differs
    double percent_different = 0.0;      ///< of the pixels, in any channel
    std::array<double, 3> mean_signed{}; ///< tested - reference, of R, G and B
};
/// Throws std::invalid_argument for different sizes or empty pictures.
DisplayDifference compare_displays(const Image<Rgb8>& tested, const Image<Rgb8>& reference);

/// 0.2126 R + 0.7152 G + 0.0722 B of the encoded values, 0..255: BT.709's luma, what SSIM is taken of.
Image<float> luma_of(const Image<Rgb8>& picture);
/// 0: R, 1: G, 2: B; 0..255.
Image<float> channel_of(const Image<Rgb8>& picture, int channel);

} // namespace fernlicht
