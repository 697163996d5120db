// A rough road: heights of its two tracks as a sum of waves, after ISO 8608. Smooth in the distance, with its derivatives in closed form.
#pragma once

#include "scenarios/vehicle/vehicle_parameters.h"

#include <cstddef>
#include <vector>

namespace fernlicht {

/// ISO 8608:2016: G(n) = G(n0) (n / n0)^-2, one-sided, in m3; n0 = 0.1 cycles/m. G(n0) is each class's geometric mean, 16e-6 m3 for A and
/// four times as much for each further one; a class reaches from half to twice of it.
inline constexpr double roughness_reference_per_m = 0.1;
/// The standard's range of spatial frequencies, cycles/m; waves of 91 m to 0.35 m.
inline constexpr double least_roughness_per_m = 0.011, greatest_roughness_per_m = 2.83;
double roughness_m3(RoadClass road_class); ///< G(n0)

/// Over which the roughness grows from nothing, so that a drive begins in balance.
inline constexpr double roughness_begins_m = 20.0;

/// Of two tracks `track_m` apart, as amplitudes, for waves of `per_m` cycles/m: k K1(k), k = 2 pi n track, K1 the modified Bessel function.
/// It follows from G(n) ~ n^-2 on a surface that is as rough across as along (isotropy: Dodds & Robson 1973): the cosine transform of the
/// plane's spectrum ~ |k|^-3. Long waves lift both tracks, short ones each for itself.
double track_coherence(double per_m, double track_m);

/// Under one axle.
struct RoughPlace {
    double height_m = 0.0, slope = 0.0, bend_per_m = 0.0;                          ///< mean of the tracks and its derivatives
    double tilt_rad = 0.0, tilt_slope_rad_per_m = 0.0, tilt_bend_rad_per_m2 = 0.0; ///< left above right positive
};

class RoughRoad {
  public:
    RoughRoad() = default; ///< smooth
    /// Twelve waves an octave, each with the power of its part of the spectrum, at a place in that part and with a phase by the seed.
    /// It begins at `from_m`. Tracks `track_m` apart; 0: both wheels run on the same one, and nothing tilts.
    RoughRoad(const Roughness& roughness, double track_m, double from_m);

    bool empty() const { return waves_.empty(); }
    RoughPlace at(double distance_m) const;

    struct Wave {
        double rad_per_m = 0.0;
        double height_sine_m = 0.0, height_cosine_m = 0.0; ///< amplitudes
        double tilt_sine_rad = 0.0, tilt_cosine_rad = 0.0;
    };
    const std::vector<Wave>& waves() const { return waves_; }

  private:
    std::vector<Wave> waves_;
    double from_m_ = 0.0;
};

} // namespace fernlicht
