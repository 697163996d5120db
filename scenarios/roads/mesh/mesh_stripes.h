// Painted stripes of a lane's edge: which are there at s, where their dashes begin and end.
#pragma once

#include "scenarios/roads/mesh/mesh_materials.h"

#include <vector>

namespace fernlicht {

/// One painted line beside a lane's outer edge, on a stretch of road.
struct Stripe {
    double from_s_m = 0.0, to_s_m = 0.0; ///< along the road
    double t_m = 0.0;                    ///< of its middle from the lane's edge, left positive
    double width_m = 0.0;
    double first_dash_m = 0.0; ///< s of the first dash
    double dash_m = 0.0;
    double period_m = 0.0; ///< dash and gap; 0: solid
    RoadMaterial material = RoadMaterial::marking_white;

    bool painted_at(double s_m) const;
    /// s of each dash's start and end within the stripe.
    void append_ends(std::vector<double>& stations) const;
};

/// The stripes of a lane's marks. Kinds without explicit lines: broken lines have 4 m dashes and 8 m gaps; the two lines of a double
/// mark stand one line's width apart. Kerbs, botts' dots and marks without paint give none. Dashes with a period below 0.2 m
/// are drawn solid, as are marks of more than 20 000 dashes: each would cost a row of vertices.
std::vector<Stripe> stripes_of(const LaneSection& section, const Lane& lane);

} // namespace fernlicht
