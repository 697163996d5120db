// What a dazzled driver's eye is adapted to: the mean luminance of his own lane, as he sees it, in the low beams of his own car, the light
// of the sky and that of street lamps. On an unlit road that is some 0.5 cd/m2, of which most is the road nearer than 30 m; at 50 m it is
// 0.1.
#pragma once

#include "metrics/readings/value.h"
#include "scenarios/drives/play/nudge.h"
#include "scenarios/roads/road_surface.h"
#include "scenarios/roads/route.h"

#include <string>
#include <vector>

namespace fernlicht {

/// The stretch of lane that counts, from the driver's own front bumper along the route, and where on it luminances are taken: ten places
/// from 15 to 60 m, of equal weight. Ours: nearer ground lies below the line of sight to the road ahead, farther ground is hardly lit.
inline constexpr double adaptation_from_m = 15.0, adaptation_to_m = 60.0, adaptation_step_m = 5.0;

/// Where a driver's car stands, where his eye is, and places on the surface of his lane ahead.
struct Driver {
    Pose car;
    glm::dvec3 eye_m{0.0};
    Pavement pavement = Pavement::standard;
    std::vector<Pose> lane = {};
    std::string no_lane = {}; ///< why there is no such lane; "" where there is
};

/// Who stands on the nearest oncoming lane's centre at `at_m` and drives against the route. His car is as the drive's own: its eye is above
/// that place, at `eye_height_m`; both axles stand on the lane's centre, on a straight line with it beyond the route's ends. There must be
/// an oncoming lane.
Driver oncoming_driver(const Drive& drive, const Route& route, double at_m, double eye_height_m);

/// Who drives along the own lane in the car's pose `car`, its rear axle at `along_m`. `eye_m` in the world.
Driver driver_ahead(const Drive& drive, const Route& route, double along_m, const Pose& car, const glm::dvec3& eye_m);

/// The low beams of the lamp set as they are mounted, before any change, on a car in that pose: without high beams and cornering lamps,
/// without what lamp control does. Drive::adaptation_lamp takes the place of each one's file; without it his lamps are the lamp set's, and
/// nudged as they are.
std::vector<LitLamp> low_beams(const Drive& drive, const LampSet& lamp_set, const Pose& car, const Nudge& nudge = {});

/// The mean luminance, cd/m2, of asphalt as pictures have it (metrics/seeing/visibility.h), in the moment's lamps, sky and weather; of the
/// other lamps those that are fixed in the world count, too. The air takes and adds its part. Nothing stands in the light's way. Not
/// measured without a lane.
Value lane_luminance_cdm2(const Driver& driver, std::vector<LitLamp> lamps, const Moment& moment);

} // namespace fernlicht
