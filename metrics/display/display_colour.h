// The last step of a picture: from coloured light, through a tone mapper, to what a display is told.
// What a drive's own luminances decide about its tone mapper: white, s, the histogram's curve. Fitted once for a drive, so that all its
// pictures, and those of the lamps compared in it, share one exposure.
// White that follows what the eye is adapted to.
#pragma once

#include "scenarios/display/display_profile.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/values/image.h"

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace fernlicht {

/// Shares of the display's red, green and blue, 0..1 each, whose light with black has this XYZ (cd/m2 on the display). What the display
/// cannot show: the luminance is cut to black..peak, then the colour follows the profile's gamut rule.
glm::dvec3 shares_for(const DisplayProfile& profile, const glm::dvec3& xyz_cdm2);

/// The light of the display for these codes, black included: XYZ in cd/m2.
glm::dvec3 shown_xyz(const DisplayProfile& profile, const glm::dvec3& code);

/// Codes, 0..1, for light of the scene: linear in sRGB's primaries, Y in cd/m2. Luminance goes through the tone mapper, to black + share *
/// (peak - black); chromaticity stays.
glm::dvec3 display_code(const DisplayProfile& profile, const ToneMapper& mapper, const glm::dvec3& light);

/// Three codes a pixel of profile.bits each; rounded to the nearest. `white`: of an eye that is adapted to another light
/// (light_adaptation); chromaticities go through it, luminances stay.
Image<glm::u16vec3> display_picture(const DisplayProfile& profile, const ToneMapper& mapper, const Image<glm::vec3>& light,
                                    const std::optional<glm::dmat3>& white = std::nullopt);

/// Mean luminance of the display over the pixels of such a picture, black included, cd/m2; not empty.
double mean_shown_cdm2(const DisplayProfile& profile, const Image<glm::u16vec3>& codes);

/// Luminances by decades: 40 bins each from 1e-6 to 1e9 cd/m2. What is darker is counted apart.
class LuminanceHistogram {
  public:
    static constexpr int bins_a_decade = 40, first_decade = -6, last_decade = 9;

    LuminanceHistogram();
    void add(const Image<float>& luminance_cdm2);
    void add(double luminance_cdm2);

    std::uint64_t pixels() const { return pixels_; }
    double max_cdm2() const { return most_; } ///< 0: nothing shines
    double log_mean_cdm2() const;             ///< geometric mean of what is above 1e-6 cd/m2; 0: nothing is
    const std::vector<std::uint64_t>& counts() const { return counts_; }
    static double bin_cdm2(std::size_t bin); ///< lower edge

  private:
    std::vector<std::uint64_t> counts_;
    std::uint64_t pixels_ = 0, counted_ = 0;
    double most_ = 0.0, ln_sum_ = 0.0;
};

/// The s >= 1 that shows `luminance_cdm2` with this share (0 < share < 1): s = d (L_max - L) / (L (1 - d)), from L' = s L / (s L - L +
/// L_max). 1 where the linear picture shows it brighter already.
double fitted_s(double luminance_cdm2, double l_max_cdm2, double share);

/// Larson, Rushmeier, Piatko 1997, equations 3 and 7, between the darkest luminance worth showing and l_max: the curve's slope in
/// logarithms follows the share of the pixels there, but is nowhere above 1 (the linear ceiling: no contrast is raised) nor below
/// `min_slope` of the mean slope, so that the curve has an inverse everywhere. `range` = black / white of the display, 0 < range < 1: the
/// darkest luminance is shown so. Where all luminances fit into the display's range the result is linear.
ToneMapper histogram_mapper(const LuminanceHistogram& histogram, double l_max_cdm2, double range, double min_slope = 0.05);

/// d ln A / dt = (ln L - ln A) / tau, solved exactly for a picture whose log-mean luminance L stands for a step: the result does not depend
/// on how a stretch of time is cut. tau is that of brighter light where L > A, of darker where L < A.
class AdaptedLuminance {
  public:
    /// brighter_s, darker_s > 0.
    AdaptedLuminance(double brighter_s, double darker_s) : brighter_s_(brighter_s), darker_s_(darker_s) {}

    /// The first picture is what the eye is adapted to already. A picture without light (0 cd/m2) changes nothing.
    void see(double log_mean_cdm2, double step_s);
    double cdm2() const { return adapted_cdm2_; } ///< 0 before the first light

  private:
    double brighter_s_, darker_s_, adapted_cdm2_ = 0.0;
};

} // namespace fernlicht
