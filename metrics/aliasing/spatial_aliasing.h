// How much of what a picture shows is not there: structure that neither the scene below the display's Nyquist limit nor a blur of it
// explains.
// What a display of w x h pixels can show of a picture drawn k times as fine, and what it cannot.
// Beyond a picture's border it goes on as in a mirror that stands on the border.
// The discrete Fourier transform of small blocks. Radix 2 in double precision, one order of operations: the same bytes whatever the number
// of threads.
#pragma once

#include "scenarios/values/image.h"

#include <complex>
#include <span>
#include <vector>

namespace fernlicht {

/// A view of w x h pixels out of its reference of (k w) x (k h).
struct BandSplit {
    Image<double> ideal;  ///< the reference below the display's Nyquist limit, 0.5 cycles per pixel along x and y, at the pixels' centres
    Image<double> folded; ///< the reference at the pixels' centres less `ideal`: what is above the limit, where it folds back to
};

/// Low pass: sinc under a Kaiser window (Kaiser 1974, beta 6) of 16 pixels to each side: flat within 0.2 % up to 0.44 cycles per pixel,
/// below 0.2 % from 0.56 on. Beyond its edges the picture is mirrored. Threads do not change a bit.
/// Throws std::invalid_argument unless `reference` is k times 1 x 1 or more, k even and at least 4, and its values are finite.
BandSplit split_bands(const Image<float>& reference, int k);

/// The pixel 0 .. count - 1 that is seen at place i: -1 is 0 again, count is count - 1. count > 0.
inline int mirrored(int i, int count) {
    const int period = 2 * count;
    const int within = ((i % period) + period) % period;
    return within < count ? within : period - 1 - within;
}

/// The values in double; std::invalid_argument for one that is not finite: "the reference's value 3 is nan".
Image<double> finite_doubles(const Image<float>& picture, const char* what);

/// In place: X[k] = sum over n of x[n] exp(-2 pi i k n / N) (Cooley and Tukey 1965). Throws std::invalid_argument unless N is a power of 2.
void fourier_transform(std::span<std::complex<double>> values);

/// The same along rows and columns of a square block, row after row. Throws std::invalid_argument unless the block is side x side.
void fourier_transform(std::vector<std::complex<double>>& block, std::size_t side);

/// Cycles per sample of bin k of N, -0.5 <= f < 0.5.
double bin_frequency(std::size_t k, std::size_t count);

/// Mean squares over the picture of one part of the difference, by how it is weighed.
struct AliasingPart {
    double rms = 0.0;              ///< in the picture's unit
    double contrast_percent = 0.0; ///< r.m.s. over blocks of the part's r.m.s. / the block's r.m.s. luminance
    double visible = 0.0; ///< the same in multiples of the contrast that an eye just sees: sqrt(sum (modulation * sensitivity)^2), r.m.s.
};

/// Of spatial frequencies |f| in [from, to) cycles per pixel.
struct AliasingBand {
    double from = 0.0, to = 0.0;
    AliasingPart aliasing, lost;
};

struct SpatialAliasing {
    // Only structure of at least 1/16 cycle per pixel: what is slower is shading.
    AliasingPart aliasing;           ///< what no blur explains; aliasing^2 = folded^2 + rest^2 but for the ridge of the fit
    AliasingPart folded;             ///< of it, what goes with the scene's content above the display's Nyquist limit, folded back
    AliasingPart rest;               ///< of it, what does not: stairs of a beam's texels, steps of 8 bits, noise
    AliasingPart lost;               ///< what blur took away of the content below the limit; no aliasing
    std::vector<AliasingBand> bands; ///< octaves, and what lies in the corners beyond 1/2
    double worst_visible = 0.0;      ///< the block with the most visible aliasing
    int worst_x = 0, worst_y = 0;    ///< its centre, pixels
    Image<double> aliasing_picture, folded_picture;
    Image<double> level_picture; ///< the r.m.s. luminance that contrast is taken to
};

/// How small a contrast the eye sees: the reciprocal of the modulation (amplitude / mean) at threshold.
/// Still gratings over 10 x 10 degrees. Barten (2004), Formula for the contrast sensitivity of the human eye, Proc. SPIE 5294, 231-238:
/// S = 5200 exp(-0.0016 u^2 (1 + 100 / L)^0.08) / sqrt((1 + 144 / X^2 + 0.64 u^2) (63 / L^0.83 + 1 / (1 - exp(-0.02 u^2)))), X^2 = 100.
/// u > 0 in cycles per degree, L > 0 in cd/m2; 0 at u = 0. Throws std::invalid_argument for others.
double still_contrast_sensitivity(double cycles_per_degree, double luminance_cdm2);

/// Luminances below count as this where contrast is taken: the lower end of mesopic vision in CIE 191:2010.
inline constexpr double min_seen_cdm2 = 0.005;

/// Blocks of 32 x 32 pixels under a sine window, neighbours overlapping by half. In each, `tested` without level and slope is told apart by
/// least squares (squared window) into
///   a symmetric filter of 7 x 7 pixels of the ideal picture (25 free values): the scene, sharp or blurred, as bright as it may be;
///   of what is left, a symmetric filter of 3 x 3 pixels (5 values) of the content folded back, and the rest.
/// A pure blur reads 0 as far as 7 x 7 pixels hold it. What folds back to within 1/64 cycle per pixel of where it came from, 0.5, is taken
/// for the scene. `folded` knows only what the reference knows: content up to k / 2 cycles per pixel. Frequencies come from the blocks'
/// Fourier transform, sensitivity from still_contrast_sensitivity() at the block's own luminance: the r.m.s., of the picture or of the
/// ideal one, whichever is brighter, which is the mean but for a bright spot in the dark, whose contrast would be without bound. `tested`
/// and `split` have the same size, at least 32 x 32; pixels_per_degree > 0. Throws std::invalid_argument otherwise and for values that are
/// not finite. Threads do not change a bit.
SpatialAliasing measure_spatial_aliasing(const Image<float>& tested, const BandSplit& split, double pixels_per_degree);

} // namespace fernlicht
