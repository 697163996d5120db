// What a storyboard did, tick by tick: the plain result that drives, logs and tests share.
#pragma once

#include "scenarios/openscenario/storyboard.h"
#include "scenarios/values/pose.h"

namespace fernlicht::osc {

struct EntitySample {
    glm::dvec3 position_m{0.0};
    double heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0; ///< pitch positive upwards, roll lifts the left side (pose.h)
    double speed_mps = 0.0;
    bool present = false, visible = true;
    std::size_t road = 0; ///< into network.roads; what it stands on or is nearest to
    int lane = 0;
    double s_m = 0.0, t_m = 0.0;

    Pose pose() const { return {position_m, axes_from_angles(heading_rad, pitch_rad, roll_rad)}; }
};

/// From `time_s` the light goes to its new state over `action.transition_s`.
struct LightChange {
    double time_s = 0.0;
    LightStateAction action;
};

struct EnvironmentChange {
    double time_s = 0.0;
    Environment environment;   ///< merged: what holds from then on
    double clock_from_s = 0.0; ///< when its date_time was given
};

struct PlayedEntity {
    Entity entity;
    std::vector<EntitySample> samples; ///< one per tick
    std::vector<LightChange> lights;
};

struct PlayedStory {
    double step_s = 0.01;
    std::vector<PlayedEntity> entities;
    std::vector<EnvironmentChange> environment;
    std::string end;                ///< why it ended there: "stop trigger", "all stories are over", "60 s were played"
    std::vector<std::string> notes; ///< one sentence each

    std::size_t ticks() const { return entities.empty() ? 0 : entities.front().samples.size(); }
};

} // namespace fernlicht::osc
