// One instant of a drive: where the car is, what its lamps do, how light the sky is.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

inline constexpr int fixed_in_world = -2; ///< LitLamp::body of a lamp that belongs to nobody

struct LitLamp {
    std::string name;
    std::shared_ptr<const LampFile> file;
    Pose pose;                     ///< in the world; x forward along the beam axis, y left, z up
    double intensity_factor = 1.0; ///< 0: off
    LampColour colour;
    double photometric_distance_m = 0.0;
    int body = -1;          ///< into Moment::bodies; -1: on the own car; or fixed_in_world
    glm::dvec2 face_m{0.0}; ///< width and height of the luminous face; 0: a point that is not seen
};

/// Something that moves, as it stands at the moment; what belongs to it is in this frame (Mesh::body).
struct Body {
    std::string name;
    Pose pose;
    bool visible = true;
    double speed_mps = 0.0;
    bool own = false; ///< the own car's: behind all others
};

struct Moment {
    int tick = 0;
    double time_s = 0.0;
    double distance_m = 0.0; ///< along the route
    double speed_mps = 0.0;
    Pose ego;                         ///< the car's frame in the world: on the road's surface under the rear axle
    std::vector<LitLamp> lamps;       ///< of the own car
    std::vector<LitLamp> other_lamps; ///< of other road users and along the road; all shine
    std::vector<Body> bodies;         ///< other road users, as in Drive::traffic; then the own car where it has a body
    double min_traffic_lx = 0.05;     ///< light of other_lamps fainter than this is left out (Drive)
    Daylight daylight;
    Weather weather;
    Pose wheels; ///< `ego` as it stands on its wheels, before load and springs lift and pitch the body; of a replay, not known: `ego`
};

} // namespace fernlicht
