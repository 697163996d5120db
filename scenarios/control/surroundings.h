// What lamp control is told besides the signals: plain values, in the frame of the own car (x forward, y left, on the road under the rear
// axle).
#pragma once

#include <string>
#include <vector>

namespace fernlicht {

struct OtherUser {
    std::string name;
    double ahead_m = 0.0, left_m = 0.0; ///< of the middle of its nearer end
    double heading_rad = 0.0;           ///< against the own car's; 0: drives the same way
    double speed_mps = 0.0;
    double width_m = 1.8, height_m = 1.5;
    bool lamps_on = true;

    bool oncoming() const { return heading_rad > 1.5707963267948966 || heading_rad < -1.5707963267948966; }
    bool operator==(const OtherUser&) const = default;
};

/// A place on the own lane's centre ahead.
struct RoadPoint {
    double along_m = 0.0; ///< from the rear axle along the lane
    double ahead_m = 0.0, left_m = 0.0;
    double curvature_per_m = 0.0; ///< left bends positive

    bool operator==(const RoadPoint&) const = default;
};

struct Surroundings {
    std::vector<OtherUser> others;
    std::vector<RoadPoint> road; ///< only where a plug-in asks for it
};

} // namespace fernlicht
