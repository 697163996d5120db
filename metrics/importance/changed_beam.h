// What a gradient predicts for other candela tables, to be checked against their readings: smooth random changes, and a spot of light.
#pragma once

#include "metrics/importance/reading_of_light.h"

#include <random>

namespace fernlicht {

/// Tables in place of those that a gradient is of, in its order.
using ChangedTables = std::vector<CandelaTable>;

/// Sum of d reading / d cd times the change of cd.
double foretold_change(const BeamGradient& gradient, const ChangedTables& tables);
std::vector<Moment> with_tables(std::vector<Moment> moments, const BeamGradient& gradient, const ChangedTables& tables);

/// For each table the factors 1 + size g, with |g| <= 1 the sum of six bumps of Gaussian shape, 0.2 to 2 degrees wide (sigma), about where
/// the gradient is not 0, each lamp's its own.
class SmoothChange {
  public:
    SmoothChange(const BeamGradient& gradient, std::mt19937_64& generator);
    ChangedTables tables(double size) const; ///< 0 <= size <= 1

  private:
    const BeamGradient& gradient_;
    std::vector<std::vector<double>> g_; ///< by table and sample
};

struct ForetoldChange {
    double foretold = 0.0;
    Value found; ///< the changed lamps' reading less the reading
};
/// One change of so much for each of `count` draws; the same for each size. By size, then by draw; the same bytes for any number of
/// threads.
std::vector<std::vector<ForetoldChange>> try_changes(const ReadingOfLight& reading, const std::vector<Moment>& moments,
                                                     const ReadingOfLight::Found& found, const std::vector<double>& sizes, int count,
                                                     std::uint64_t seed);

/// A round spot of Gaussian shape, `full_width_deg` wide where it has half its height.
struct BeamSpot {
    double h_deg = 0.0, v_deg = 0.0, full_width_deg = 0.5;
    double at(double h, double v) const; ///< 1 in its middle; exactly 0 from twice its full width on
};
/// A table with such a spot of `cd` more, in the samples that it reaches.
CandelaTable with_spot(CandelaTable table, const BeamSpot& spot, double cd);

/// What a spot of 1 cd changes, by its middle: at every H and V, row-major from the first V.
struct SpotMap {
    std::vector<double> h_deg, v_deg, per_cd;
    double at(std::size_t v, std::size_t h) const { return per_cd[v * h_deg.size() + h]; }
};
/// Of those lamps of the gradient that have this file, together.
SpotMap spot_map(const BeamGradient& gradient, const LampFile& file, std::vector<double> h_deg, std::vector<double> v_deg,
                 double full_width_deg);

} // namespace fernlicht
