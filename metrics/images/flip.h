// FLIP, the difference that a person notices who flips between two pictures on a screen, 0 (none) to 1. Written from the papers:
// display pictures after Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom and Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images" (HPG 2020); linear pictures after Andersson, Nilsson, Shirley and Akenine-Moeller, "Visualizing Errors in Rendered
// High Dynamic Range Images" (Eurographics 2021). Any number of threads gives the same bytes.
#pragma once

#include "scenarios/drives/play/frame.h"

#include <glm/vec3.hpp>

namespace fernlicht {

/// Of the papers: a screen 3840 pixels and 0.7 m wide, 0.7 m away.
inline constexpr double default_pixels_per_degree = 67.02064327658226;
/// What FLIP is taken at: coarser, its filters are less than a pixel; finer, they are larger than pictures.
inline constexpr double min_pixels_per_degree = 1.0, max_pixels_per_degree = 1000.0;
inline bool has_flip_at(double pixels_per_degree) {
    return pixels_per_degree >= min_pixels_per_degree && pixels_per_degree <= max_pixels_per_degree;
}

/// On the axis of a perspective view: a picture seen from where it was drawn for. Field of view above 0 and below 180 degrees.
double pixels_per_degree_of_view(double vertical_fov_rad, int height_px);

/// Of 8-bit sRGB pictures, both ways the same. Throws std::invalid_argument for sizes that differ, empty pictures, and pixels per degree
/// without FLIP.
Image<float> flip_ldr(const Image<Rgb8>& tested, const Image<Rgb8>& reference, double pixels_per_degree = default_pixels_per_degree);

/// Exposures in stops (powers of two), from the one that shows the brightest pixel to the one that shows the middle one.
struct ExposureRange {
    double start = 0.0, stop = 0.0;
    int count = 2; ///< evenly from start to stop, both included; at least 2
};

/// The most stops between start and stop: a million to one, more than an eye adapted to any one level tells apart.
inline constexpr double max_stops = 20.0;

/// Start: the tone mapper gives 0.85 to the reference's largest luminance; stop: to its median. Night pictures are black for more than
/// half: where the median is 0, it is that of the pixels above 0 (the paper has no answer there), and stop is at most start + max_stops.
/// Throws std::invalid_argument for a picture without light, or with values below 0 or not finite.
ExposureRange exposures_for(const Image<glm::vec3>& reference);
ExposureRange exposures_for(const Image<float>& reference);

/// Of linear RGB, in any unit: the largest FLIP of all exposures, each tone mapped (ACES after Narkowicz, as in the paper). Not the same
/// both ways: exposures come from the reference. Throws std::invalid_argument as flip_ldr and exposures_for do.
Image<float> flip_hdr(const Image<glm::vec3>& tested, const Image<glm::vec3>& reference, const ExposureRange& exposures,
                      double pixels_per_degree = default_pixels_per_degree);

/// Of one channel (luminance in cd/m2, illuminance in lx), shown as grey: what colours need is left out.
Image<float> flip_hdr(const Image<float>& tested, const Image<float>& reference, const ExposureRange& exposures,
                      double pixels_per_degree = default_pixels_per_degree);

/// What the published tool prints of a map of errors.
struct FlipSummary {
    double mean = 0.0, minimum = 0.0, maximum = 0.0;
    double first_quartile = 0.0, median = 0.0, third_quartile = 0.0; ///< of the pixels, nearest rank
    /// Below which a quarter, half, three quarters of the sum of all errors lies: of the errors that there are, not of the pixels.
    double weighted_first_quartile = 0.0, weighted_median = 0.0, weighted_third_quartile = 0.0;
};
/// Throws std::invalid_argument for an empty map.
FlipSummary summary_of_flip(const Image<float>& errors);

} // namespace fernlicht
