// One instant of a drive: where the car is, what its lamps do, how light the sky is.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

struct LitLamp {
    std::string name;
    std::shared_ptr<const LampFile> file;
    Pose pose;                     ///< in the world; x forward along the beam axis, y left, z up
    double intensity_factor = 1.0; ///< 0: off
    LampColour colour;
    double photometric_distance_m = 0.0;
};

struct Moment {
    int tick = 0;
    double time_s = 0.0;
    double distance_m = 0.0; ///< along the route
    double speed_mps = 0.0;
    Pose ego; ///< the car's frame in the world: on the road's surface under the rear axle
    std::vector<LitLamp> lamps;
    Daylight daylight;
    Weather weather;
};

} // namespace fernlicht
