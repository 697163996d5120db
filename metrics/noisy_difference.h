// How two pictures differ whose pixels are means with known variances: rays against rays.
#pragma once

#include "scenarios/values/image.h"

#include <cstddef>

namespace fernlicht {

struct NoisyPicture {
    const Image<float>* mean;
    const Image<float>* variance; ///< of the mean, in its unit squared
    int freedom;                  ///< degrees of freedom of each pixel's variance; at least 1
};

struct NoisyDifference {
    bool identical = false;   ///< means and variances, to the bit
    std::size_t compared = 0; ///< pixels with a variance in either picture
    double worst_z = 0.0;     ///< largest |a - b| / sqrt(var a + var b) of a pixel
    int worst_x = 0, worst_y = 0;
    double pixel_bound = 0.0;   ///< what worst_z may reach by chance
    double sum_z = 0.0;         ///< sum of (a - b) over sqrt(sum of variances), signed: sees light that is missing everywhere a little
    double sum_bound = 0.0;     ///< what |sum_z| may reach by chance
    double sum_ratio = 1.0;     ///< sum of a over sum of b; 1 where b is black
    std::size_t exact_over = 0; ///< pixels without variance that differ by more than the threshold

    bool agrees() const { return identical || (worst_z <= pixel_bound && sum_z <= sum_bound && -sum_z <= sum_bound && exact_over == 0); }
};

/// Two tests at half of `false_alarm` each. Pixels: Student's t with the fewer degrees of freedom of the two (of a difference they are
/// more: Welch and Satterthwaite), two-sided, at false_alarm / 2 / pixels (Bonferroni). Sum: normal, for the sum over many pixels. Both
/// hold where pixels are independent and each mean is normally distributed; a pixel that sees a rare bright path is neither, and may be
/// called different. Pixels without variance in both must agree within threshold_absolute + threshold_relative * |b|. Throws
/// std::invalid_argument for different sizes, empty pictures, values that are not finite, variances below 0.
NoisyDifference compare_noisy(const NoisyPicture& a, const NoisyPicture& b, double threshold_absolute, double threshold_relative,
                              double false_alarm);

} // namespace fernlicht
