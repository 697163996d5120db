// Road users as a drive file asks for them: by a place on the road and a speed, alone or in a row.
#pragma once

#include "scenarios/models/model.h"
#include "scenarios/roads/route.h"
#include "scenarios/traffic/road_user.h"

#include <optional>

namespace fernlicht {

struct SpeedPoint {
    double time_s = 0.0, speed_mps = 0.0; ///< linear between points, constant before the first and after the last

    bool operator==(const SpeedPoint&) const = default;
};

/// From where a road user follows its lane. ahead: on the own route, gap_m from the own car's start to it, both under the rear axle.
/// oncoming: beside that place, on the nearest driving lane of the other direction. lane: from a place on the road.
/// storyboard: an entity of the drive's storyboard; the row gives it lamps.
enum class TrafficPlace { ahead, oncoming, lane, storyboard };

struct TrafficRow {
    std::string name;
    RoadUserKind kind = RoadUserKind::car;
    std::optional<glm::dvec3> size_m;              ///< nullopt: the kind's usual size
    std::filesystem::path model;                   ///< glTF; "": a body of our own
    double model_yaw_rad = 0.0, model_scale = 1.0; ///< how the file's model is turned and scaled
    std::vector<Mount> mounts;                     ///< the model's, so turned and scaled; not part of the file
    std::optional<double> rear_m;                  ///< x of the model's rear end; nullopt: the kind's usual; not part of the file
    TrafficPlace place = TrafficPlace::oncoming;
    double gap_m = 0.0;                ///< ahead and oncoming; may be negative for ahead: behind
    Route::Start start;                ///< lane only
    std::vector<std::string> entities; ///< storyboard only: their names; none: all that no other row names
    std::vector<SpeedPoint> speed;     ///< along its lane
    std::vector<MountedLamp> lamps;    ///< in the road user's frame; what each is follows from its name (function_of)
    glm::dvec2 face_m{0.16, 0.12};     ///< width and height of each one's luminous face
    std::vector<LampChange> changes;
    double tail_cd = 0.0, brake_cd = 0.0; ///< of each rear lamp on its axis; 0: none
    int count = 1;
    double every_m = 25.0; ///< from one to the next, farther along
};

} // namespace fernlicht
