// How two pictures differ whose pixels are means with estimated variances: rays against rays.
#pragma once

#include "scenarios/values/image.h"

#include <cstddef>
#include <cstdint>

namespace fernlicht {

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

} // namespace fernlicht
