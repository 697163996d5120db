// Differences of colour in the CIE's formula of 2000, after Sharma, Wu and Dalal, "The CIEDE2000 color-difference formula: implementation
// notes, supplementary test data, and mathematical observations" (2005), with kL = kC = kH = 1. About 1 is just seen beside each other.
#pragma once

#include "scenarios/drives/play/frame.h"

namespace fernlicht {

/// CIELAB: L* 0..100, a* to red, b* to yellow.
struct Lab {
    double l = 0.0, a = 0.0, b = 0.0;
};

double ciede2000(const Lab& one, const Lab& other);

/// Of an 8-bit sRGB colour, white D65 (BT.709's own, 2 degrees).
Lab lab_of(const Rgb8& colour);

struct ColourDifference {
    double mean = 0.0, median = 0.0, p95 = 0.0, maximum = 0.0; ///< over pixels; median and p95 by nearest rank
    int maximum_x = 0, maximum_y = 0;
};
/// Pixel by pixel. Throws std::invalid_argument for different sizes or empty pictures. The formula is meant for colours beside each other
/// in good light: in the dark parts of a night picture it says more than a driver sees.
Image<float> ciede2000_map(const Image<Rgb8>& tested, const Image<Rgb8>& reference);
ColourDifference summary_of_colours(const Image<float>& differences);

} // namespace fernlicht
