// How two linear pictures differ.
// How two display pictures (8-bit sRGB) differ, in their own levels 0..255 over all three channels.
// How two pictures differ whose pixels are means with estimated variances: rays against rays.
// Light as an eye and a log scale take it: in decades, for metrics that compare structure.
// sRGB as IEC 61966-2-1 encodes it.
// Structural similarity: 1 for the same picture, towards 0 (and below, where structures are each other's negatives) for different ones.
// SSIM: Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to structural similarity" (2004).
// MS-SSIM: Wang, Simoncelli, Bovik, "Multiscale structural similarity for image quality assessment" (2003).
//
// A window of 11 x 11 weights (Gaussian, standard deviation 1.5) goes over every pixel. At the picture's edges it sees the picture mirrored
// about its outermost pixels (OpenCV's BORDER_REFLECT_101), so that edges count as much as the middle; the authors' own program leaves out
// the five outermost pixels instead. On one 8-bit channel with range 255, mean() is what OpenCV's QualitySSIM computes for that channel.
// Differences of colour in the CIE's formula of 2000, after Sharma, Wu and Dalal, "The CIEDE2000 color-difference formula: implementation
// notes, supplementary test data, and mathematical observations" (2005), with kL = kC = kH = 1. About 1 is just seen beside each other.
#pragma once

#include "scenarios/drives/play/frame.h"
#include "scenarios/values/image.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace fernlicht {

/// Throws std::invalid_argument for different sizes or empty pictures.
void check_comparable(int width, int height, int reference_width, int reference_height);
template <class Picture> void check_comparable(const Picture& tested, const Picture& reference) {
    check_comparable(tested.width(), tested.height(), reference.width(), reference.height());
}

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

struct NoisyPicture {
    const Image<float>* mean;
    const Image<float>* variance; ///< of the mean, in its unit squared, as estimated from samples
    const Image<float>* mixed;    ///< not 0: several surfaces or a shadow's edge in the pixel; nullptr where nobody knows
    int freedom;                  ///< degrees of freedom of each pixel's variance; at least 1
};

/// Edge of the squares of pixels that are tested as one; the last column and row of squares may be cut.
constexpr int noise_block_px = 4;

struct NoisyDifference {
    bool identical = false;      ///< means and variances, to the bit
    std::size_t compared = 0;    ///< pixels that are tested: with noise, mixed in neither picture
    std::size_t left_out = 0;    ///< pixels with noise that are mixed in either picture
    std::size_t blocks = 0;      ///< with at least one pixel that is tested
    std::size_t blocks_over = 0; ///< beyond their bound
    double worst_z = 0.0;     ///< of the block that is farthest beyond its bound, or nearest to it: |sum (a - b)| / sqrt(sum of variances)
    double worst_bound = 0.0; ///< what chance reaches there
    int worst_x = 0, worst_y = 0; ///< its first pixel
    double sum_z = 0.0;           ///< the same for all tested pixels, signed: sees light that is missing everywhere a little
    double sum_bound = 0.0;       ///< what |sum_z| may reach by chance
    double sum_ratio = 1.0;       ///< sum of a over sum of b, tested pixels; 1 where b is black
    std::size_t exact_over = 0;   ///< pixels without noise that differ by more than the threshold

    bool differs() const { return !identical && (blocks_over > 0 || sum_z > sum_bound || -sum_z > sum_bound || exact_over > 0); }
    /// Whether more pixels are tested than left out. Where not, that nothing differs says little.
    bool enough() const { return identical || compared >= left_out; }
};

/// Two tests at half of `false_alarm` each, all blocks and their sum.
/// - Where few samples meet an edge of light, most sets of them hit one side alone: the mean is off by many of its estimated errors. So a
///   pixel's variance is taken to be at least the mean of those of the 3 x 3 around it: edges of light cross several pixels, of which some
///   sample both sides. It is never lowered. Pixels known to be mixed are left out and counted: small things are missed by all samples
///   alike.
/// - Pixels are added up over blocks, whose means are nearer to the normal distribution than one pixel's, by which also a small difference
///   over a zone is seen. Bound: Student's t, two-sided, at false_alarm / 2 / blocks (Bonferroni), with Welch and Satterthwaite's degrees
///   of freedom of the block, f (sum v)^2 / sum v^2 over both pictures' estimated variances: f where one pixel decides, more where many do.
/// - Sum: normal.
/// Pixels without variance all around must agree within threshold_absolute + threshold_relative * |b|. Throws std::invalid_argument for
/// different sizes, empty pictures, values that are not finite, variances below 0.
NoisyDifference compare_noisy(const NoisyPicture& a, const NoisyPicture& b, double threshold_absolute, double threshold_relative,
                              double false_alarm);

/// How far below the reference's largest value structure is looked at: four decades are headlamps on the road (100 lx) down to moonlight
/// (0.01 lx).
inline constexpr double decades_below_peak = 4.0;

/// log10(value / peak) + decades_below_peak, 0 for everything darker than that (also for 0 and below), so 0..4 for a picture with this
/// peak. The range to hand to ssim() is decades_below_peak. Throws std::invalid_argument for a peak that is not above 0.
Image<float> decades_of(const Image<float>& picture, double peak);

/// The largest value; 0 for a picture without light.
double peak_of(const Image<float>& picture);

/// 0..1 to 0..1.
double srgb_decoded(double encoded);
/// Of all 8-bit values.
const std::array<float, 256>& srgb_table();

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

struct SsimScales {
    Ssim finest;
    std::optional<double> all; ///< MS-SSIM; nothing for pictures smaller than smallest_for_ms_ssim_px either way
};
/// ssim(), and five scales, each half as fine as the one before (means of 2 x 2 pixels; an odd last one counts twice): contrast and
/// structure of the first four and all of the coarsest, to the powers 0.0448, 0.2856, 0.3001, 0.2363 and 0.1333. A scale whose mean is
/// below 0 counts as 0, since a negative number has no such power. Throws as ssim() does.
SsimScales ssim_scales(const Image<float>& tested, const Image<float>& reference, double range);

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
