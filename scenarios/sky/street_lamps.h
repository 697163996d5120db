// Lamps on poles beside the route.
#pragma once

#include "scenarios/lamps/mounted_lamp.h"

#include <vector>

namespace fernlicht {

/// A row of equal lamps along the route. The lamp's file is read with gamma 0 forward (type_c_axis nadir) and hung with
/// forward down, C 0 along the route and C 90 from the pole towards the lane.
struct StreetLampRow {
    std::string name;
    std::shared_ptr<const LampFile> file;
    double first_m = 0.0, last_m = 1.0e6; ///< along the route; poles stand within
    double every_m = 30.0;
    double beside_m = -5.0; ///< of the pole from the lane's centre, left positive
    double height_m = 8.0;  ///< of the lamp's centre above the surface
    double arm_m = 1.0;     ///< from the pole towards the lane
    double tilt_rad = 0.0;  ///< lifts the side away from the pole
    double level = 1.0;     ///< 0..1
    LampColour colour;
};

} // namespace fernlicht
