// A beam as a few spot lights of OpenGL 1.x, all that per-vertex lighting had: the least-squares fit, and what is left over.
#pragma once

#include "scenarios/lamps/candela_table.h"

#include <glm/vec3.hpp>
#include <vector>

namespace fernlicht {

/// I = cd cos(angle)^exponent within the cut-off of the axis, 0 outside it. OpenGL 1.x allows exponents 0..128 (GL_SPOT_EXPONENT) and
/// cut-offs of 0..90 degrees from the axis (GL_SPOT_CUTOFF). Its narrowest bell, exponent 128, still is 12 degrees wide between its halves.
struct Spot {
    double h_deg = 0.0, v_deg = 0.0; ///< the axis, on the goniometer
    double cd = 0.0;                 ///< along the axis
    double exponent = 0.0;
    double cutoff_deg = 90.0;
};
double intensity_cd(const Spot& spot, double h_deg, double v_deg);
/// In closed form: 2 pi cd (1 - cos(cut-off)^(exponent + 1)) / (exponent + 1).
double flux_lm(const Spot& spot);

struct SpotFit {
    std::vector<Spot> spots;    ///< in the order found; fewer than asked for where another one gains nothing
    double relative_l2 = 0.0;   ///< sqrt(sum w (I - fit)^2 / sum w I^2), w the solid angle, over the front half (H and V within 90 degrees)
    double rms_of_peak = 0.0;   ///< the same sum over the solid angle that is lit, over the peak
    double worst_of_peak = 0.0; ///< largest |I - fit| at a sample of the table with H within 90 degrees, over the peak
    double worst_h_deg = 0.0, worst_v_deg = 0.0;
    double flux_lm = 0.0, table_flux_lm = 0.0; ///< all that the spots give, all that the table gives
};

constexpr int max_spots = 8; // of OpenGL 1.x

/// Fits 1 to 8 spots to the light within H +-90 degrees, each direction weighted by its solid angle. One spot is added at a time where it
/// gains most, then all are refined together (Levenberg-Marquardt; cut-offs by exhaustion), so more spots never fit worse. A good fit, no
/// proof of the best one. Large tables are fitted on means over groups of samples; the spread within a group counts as left over. Same
/// table, same spots. Throws std::invalid_argument for another count.
SpotFit fit_spots(const CandelaTable& table, int count);

/// The directions over which spot lights are fitted to a beam, weighted samples of the front half: structure of arrays, one entry a
/// direction.
struct SpotDirections {
    std::vector<double> x, y, z;   ///< unit, lamp space
    std::vector<double> cd;        ///< mean of the table over the direction's solid angle
    std::vector<double> weight_sr; ///< solid angle; their sum is 2 pi
    double total_cd2_sr = 0.0;     ///< sum of w I^2 over the table's own samples, means not taken
    double within_cd2_sr = 0.0;    ///< of it what the means do not show: sum of w (I - mean)^2
    double lit_sr = 0.0;           ///< solid angle of samples with light

    std::size_t size() const { return cd.size(); }
};

/// At most about `most` directions: the table's own samples, closed up with dark ones where it does not reach, or means over
/// neighbouring samples where they are more.
SpotDirections spot_directions(const CandelaTable& table, std::size_t most);

} // namespace fernlicht
