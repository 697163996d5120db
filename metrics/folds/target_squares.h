// Squares of a target on the road as the driver sees them: where they stand and what is behind them, which is the same in all light; their
// light; how visible that makes them.
#pragma once

#include "metrics/readings/reading_key.h"
#include "metrics/road/lit_line.h"
#include "metrics/seeing/visibility.h"
#include "scenarios/drives/drive.h"

namespace fernlicht {

/// The lane ahead as one moment's driver and lamps see it.
struct SeenLane {
    LaneAhead lane;
    LaneAhead::Origin eye;
    std::vector<LaneAhead::Origin> lamps; ///< of the moment
    SeenLane(const Drive& drive, const Route& route, const VisibilityParameters& asked, const Moment& moment);
};

struct TargetSquare {
    glm::dvec3 middle_m{0.0}, behind_m{0.0}; ///< its own, and of what is seen behind it; without a road there, far off
    glm::dvec3 face{0.0};                    ///< unit normal, towards the car
    glm::dvec3 road_up{0.0};                 ///< unit normal of the road behind it
    double size_arcmin = 0.0;
    bool hidden = false, on_road = false;
    std::vector<bool> unlit = {}; ///< by lamp of the moment: the lane stands before it; empty: before none
    std::string no_mirror;        ///< why light by way of a wet road is not known
    std::string unknown;          ///< why it has no level; "" where it has
    // In a light:
    double illuminance_lx = 0.0, background_cdm2 = 0.0, adaptation_cdm2 = 0.0;
    double left = 1.0, veil_cdm2 = 0.0; ///< share of its light that the air leaves, and what the air puts before it

    double target_cdm2(double reflectance) const;
};

/// Of a target that far along the route, from the lowest; the lowest alone where nothing tells what the eye is adapted to; none without
/// such a lane.
std::vector<TargetSquare> target_squares(const Moment& moment, const SeenLane& seen, const Route& route, double along_m, Across across,
                                         double size_m, int squares);

/// Fills in clear air and the lamps' own light.
void light_squares(const Moment& moment, const glm::dvec3& eye_m, const VisibilityParameters& asked, Pavement behind,
                   std::vector<TargetSquare>& squares);

/// The moment without lamps that the lane hides from the square.
Moment lamps_reaching(const Moment& moment, const TargetSquare& square);

/// 0 where the lane hides it.
Value square_level(const TargetSquare& square, double reflectance, const VisibilityParameters& asked);
/// Of the clearest square that has a level.
Value target_level(const std::vector<TargetSquare>& squares, double reflectance, const VisibilityParameters& asked);

/// A length up to the detection distance, by the levels at places ahead. Where the route's end comes into sight, backgrounds of the last
/// places are missing: it cuts the detection off.
Value known_detection(double metres, const std::vector<LineSample>& levels, double wanted, bool to_routes_end);

/// Quantity, subject and place.
ReadingKey detection_key(const VisibilityTarget& target, Across across);

} // namespace fernlicht
