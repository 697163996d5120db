// White that follows what the eye is adapted to.
#pragma once

namespace fernlicht {

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
