// Plays a storyboard by fixed steps, the same file on the same road to the same bytes; what it did, tick by tick.
#pragma once

#include "scenarios/openscenario/storyboard.h"
#include "scenarios/roads/road_network.h"
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

struct PlayStoryOptions {
    double step_s = 0.01;
    double max_s = 60.0;   ///< longest time played
    double day_rate = 1.0; ///< seconds of an animated time of day for one of the story; conditions of the time of day go by it
};

/// From init to the stop trigger, to where all stories are over (in a storyboard that has some), or for `max_s`. Without a controller
/// entities move by their actions, else along their lane at their speed. Throws InputError with file and line for positions that are not
/// on the road. The network may be empty: then only positions of the world can be placed.
PlayedStory play_story(const Storyboard& storyboard, const RoadNetwork& network, const PlayStoryOptions& options = {});

} // namespace fernlicht::osc
