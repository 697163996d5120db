// The directions over which spot lights are fitted to a beam: weighted samples of the front half.
#pragma once

#include "scenarios/lamps/candela_table.h"

#include <glm/vec3.hpp>

namespace fernlicht {

/// Structure of arrays, one entry a direction.
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

/// Unit vector of an axis: x right, y up, z forward.
glm::dvec3 direction_of(double h_deg, double v_deg);

} // namespace fernlicht
