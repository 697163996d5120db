// Sixteen independent means and what they say: mean, standard error, and how many more samples an error asks for.
#pragma once

#include "renderer/reference/embree_scene.h"

#include <array>

namespace fernlicht::reference {

inline constexpr std::size_t replicate_count = packet_size;

struct MeanAndError {
    double mean = 0.0, standard_error = 0.0;
};

/// Of independent, equally distributed means of `each` samples, given as their sums. The error is such that (mean - truth) / error has
/// variance 1 where the means are normal: s / sqrt(n) times sqrt((n - 1) / (n - 3)), the spread of Student's t with n - 1 degrees of
/// freedom.
MeanAndError mean_of(const std::array<double, replicate_count>& sums, int each);

/// How the error of stratified samples falls: error^2 goes with the number of samples to the power -power. 1: as for independent samples
/// (many dimensions); 1.5: an edge in two dimensions; 2: smooth in two dimensions (nets reach 3, which is not counted on).
/// The least power of two times `now` that brings `error` below 3/4 of `target`, at most `most`. now >= 1.
int samples_for(double error, double target, double power, int now, int most);

} // namespace fernlicht::reference
