// Lamps on poles beside the route, or on the poles that a road's file has.
#pragma once

#include "scenarios/lamps/mounted_lamp.h"
#include "scenarios/values/pose.h"

#include <optional>
#include <vector>

namespace fernlicht {

/// Where the road's file has something to hang a lamp on.
struct StreetLampPlace {
    std::string object;        ///< "object 12 (streetlamp)"
    Pose foot;                 ///< x along the road, y to its left, z up
    double beside_m = 0.0;     ///< from the road's reference line, left positive: the lamp hangs towards it
    double height_m = 0.0;     ///< of the lamp's centre above the foot
    double own_height_m = 0.0; ///< of the object, which is drawn with the road
};

/// A row of equal lamps along the route. The lamp's file is read with gamma 0 forward (type_c_axis nadir) and hung with
/// forward down, C 0 along the route and C 90 from the pole towards the lane.
struct StreetLampRow {
    std::string name;
    std::shared_ptr<const LampFile> file;
    double first_m = 0.0, last_m = 1.0e6; ///< along the route; poles stand within
    double every_m = 30.0;
    double beside_m = -5.0; ///< of the pole from the lane's centre, left positive
    double height_m = 8.0;  ///< of the lamp's centre above the surface; with on_objects 0: by each object's own height
    double arm_m = 1.0;     ///< from the pole towards the lane
    double tilt_rad = 0.0;  ///< lifts the side away from the pole
    double level = 1.0;     ///< 0..1
    LampColour colour;
    /// Not empty: instead of a row, a lamp on each object of the road's file whose type is one of these or whose name has one of them in
    /// it, whatever their case. first_m, last_m, every_m and beside_m then mean nothing.
    std::vector<std::string> on_objects = {};
    std::optional<std::vector<StreetLampPlace>> found = {}; ///< what find_street_lamps() made of on_objects; not part of the file
};

} // namespace fernlicht
