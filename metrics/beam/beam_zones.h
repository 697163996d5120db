// Connected directions in which one beam is brighter or dimmer than another by more than noise explains.
#pragma once

#include "scenarios/lamps/candela_table.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

/// Residuals over the samples of a table, row-major [v][h]. NaN in `r`: not compared there. A residual's noise is that of one stored sample
/// of the tested file and of the samples of the other one that were interpolated there: neighbours may share both.
struct ResidualGrid {
    std::vector<double> h_deg, v_deg; ///< axes of the table, whatever angles they are
    std::vector<double> r;            ///< log of tested over against, all that is explained taken off
    std::vector<double> noise;        ///< standard deviation of one sample's log, of either file, above 0
    std::vector<double> open;         ///< what interpolation leaves open, >= 0: not noise, does not average out
    std::vector<std::size_t> source;  ///< which stored sample: a symmetric file stands for more directions than it stores
    /// Samples of the other file with their weights: those of `r[i]` from shared[first[i]] to shared[first[i + 1]].
    std::vector<std::size_t> first;
    std::vector<std::pair<std::size_t, double>> shared;
    std::vector<TwoAngles> un; ///< H and V of each; empty: the axes
};

/// How much of the compared light a zone holds; wide: points, and much that has no name round them.
enum class ZoneExtent { part, wide, all, below_cut_off, above_cut_off };

struct BeamZone {
    double share = 0.0;       ///< tested over against, less 1: -0.05 is 5 % dimmer; weighted mean over the zone
    double uncertainty = 0.0; ///< standard error of `share` and what interpolation leaves open
    /// Nine tenths of its samples have a share between these; both are `share` where they scatter by no more than noise, or by 2 %.
    double share_low = 0.0, share_high = 0.0;
    double h_from_deg = 0.0, h_to_deg = 0.0, v_from_deg = 0.0, v_to_deg = 0.0; ///< borders halfway between samples in and out
    double z = 0.0;                                                            ///< of its clearest block of samples
    std::size_t samples = 0;
    double h_deg = 0.0, v_deg = 0.0;  ///< its middle: mean over its samples
    std::vector<std::size_t> members; ///< its samples, by their place in the grid
    // What it holds, as name_zones (beam_places.h) finds it.
    ZoneExtent extent = ZoneExtent::part;
    std::vector<std::string> holds; ///< named places, at least half of each
    std::string part_of;            ///< the region that it lies in, where it holds none; "" where there is none either
};

/// The z beyond which one of `tests` normal figures falls by chance with probability `chance` in all, either side (Bonferroni).
double z_limit(double chance, std::size_t tests);

/// Noise of one sample estimated from the residuals themselves: differences of each from the mean of its neighbours in its row and in its
/// column, which no smooth change and no border of a zone touches much, each over the standard deviation that noise of 1 would give it;
/// 1.4826 times their median size, and its standard error more. `chosen`: which samples count, empty for all. 0 for fewer than 30.
double neighbour_noise(const ResidualGrid& grid, const std::vector<bool>& chosen);

/// Means over blocks of 1, 3 x 3 and 5 x 5 samples beyond `z_limit` begin a zone, which holds what is connected and at least half as strong
/// as they are, after a mean over 3 x 3. At most 64, sorted by z, largest first.
std::vector<BeamZone> find_zones(const ResidualGrid& grid, double z_limit);

} // namespace fernlicht
