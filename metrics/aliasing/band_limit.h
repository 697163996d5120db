// What a display of w x h pixels can show of a picture drawn k times as fine, and what it cannot.
// Beyond a picture's border it goes on as in a mirror that stands on the border.
// The discrete Fourier transform of small blocks. Radix 2 in double precision, one order of operations: the same bytes whatever the number
// of threads.
#pragma once

#include "scenarios/values/image.h"

#include <complex>
#include <span>

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

} // namespace fernlicht
