// Connected directions in which one beam is brighter or dimmer than another by more than noise explains.
#pragma once

#include <cstddef>
#include <vector>

namespace fernlicht {

/// Residuals over the samples of a table, row-major [v][h]. NaN in `r`: not compared there.
struct ResidualGrid {
    std::vector<double> h_deg, v_deg;
    std::vector<double> r;     ///< log of tested over against, all that is explained taken off
    std::vector<double> sigma; ///< its standard deviation by noise, above 0, independent from sample to sample
    std::vector<double> open;  ///< what interpolation leaves open, >= 0: not noise, does not average out
};

struct BeamZone {
    double share = 0.0;       ///< tested over against, less 1: -0.05 is 5 % dimmer; weighted mean over the zone
    double uncertainty = 0.0; ///< standard error of `share` and what interpolation leaves open
    double h_from_deg = 0.0, h_to_deg = 0.0, v_from_deg = 0.0, v_to_deg = 0.0; ///< borders halfway between samples in and out
    double z = 0.0;                                                            ///< of its clearest block of samples
    std::size_t samples = 0;
    double h_deg = 0.0, v_deg = 0.0; ///< its middle: mean over its samples
};

/// The z beyond which one of `tests` normal figures falls by chance with probability `chance` in all, either side (Bonferroni).
double z_limit(double chance, std::size_t tests);

/// Noise estimated from the residuals themselves: differences of each from the mean of its neighbours in its row and in its column, which
/// no smooth change and no border of a zone touches much; 1.4826 times their median size, over sqrt(1.5). `chosen`: which samples count,
/// empty for all. 0 for fewer than 30.
double neighbour_noise(const ResidualGrid& grid, const std::vector<bool>& chosen);

/// Means over blocks of 1, 3 x 3 and 5 x 5 samples beyond `z_limit` begin a zone, which holds what is connected and at least half as strong
/// as they are, after a mean over 3 x 3. At most 64, sorted by z, largest first.
std::vector<BeamZone> find_zones(const ResidualGrid& grid, double z_limit);

} // namespace fernlicht
