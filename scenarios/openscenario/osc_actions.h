// Actions of one entity while they run: each begins once, then goes on by steps until it is over.
#pragma once

#include "scenarios/openscenario/osc_path.h"
#include "scenarios/openscenario/osc_world.h"
#include "scenarios/openscenario/play_story.h"

namespace fernlicht::osc {

/// What an action takes hold of; a new action ends running ones of the same entity that hold the same.
enum Domain : unsigned { no_domain = 0, longitudinal_domain = 1, lateral_domain = 2, light_domain = 4 };

/// One action of one entity. begin() once, then step() each tick until it returns true.
class RunningAction {
  public:
    RunningAction(const PrivateAction& action, std::size_t entity) : action_(&action), entity_(entity) {}

    std::size_t entity() const { return entity_; }
    unsigned domains() const;
    /// Both hold the same; of lights only those of the same name do.
    bool conflicts(const RunningAction& other) const;

    /// Speed and place may change at once. `played` takes light changes. Throws InputError for positions that cannot be placed.
    void begin(World& world, PlayedStory& played);
    /// From world.time_s over `dt_s`. Says which domains it moved, so that the default motion leaves them. True: over.
    bool step(World& world, double dt_s, unsigned& moved);

  private:
    EntityState& state(World& world) const { return world.entities()[entity_]; }

    void begin(const SpeedAction& action, World& world, PlayedStory& played);
    void begin(const SpeedProfileAction& action, World& world, PlayedStory& played);
    void begin(const LaneChangeAction& action, World& world, PlayedStory& played);
    void begin(const LaneOffsetAction& action, World& world, PlayedStory& played);
    void begin(const FollowTrajectoryAction& action, World& world, PlayedStory& played);
    void begin(const TeleportAction& action, World& world, PlayedStory& played);
    void begin(const VisibilityAction& action, World& world, PlayedStory& played);
    void begin(const LightStateAction& action, World& world, PlayedStory& played);
    void begin(const AssignRouteAction& action, World& world, PlayedStory& played);
    void begin(const AcquirePositionAction& action, World& world, PlayedStory& played);
    template <class Other> void begin(const Other&, World&, PlayedStory&) {}

    bool step(const SpeedAction& action, World& world, double dt_s);
    bool step(const SpeedProfileAction& action, World& world, double dt_s);
    bool step(const LaneChangeAction& action, World& world, double dt_s);
    bool step(const LaneOffsetAction& action, World& world, double dt_s);
    bool step(const LateralDistanceAction& action, World& world, double dt_s);
    bool step(const LongitudinalDistanceAction& action, World& world, double dt_s);
    bool step(const FollowTrajectoryAction& action, World& world, double dt_s);
    bool step(const SynchronizeAction& action, World& world, double dt_s);
    bool step(const LightStateAction& action, World& world, double dt_s);
    bool step(const AcquirePositionAction& action, World& world, double dt_s);
    template <class Other> bool step(const Other&, World&, double) { return true; }

    double target_speed(const World& world, const SpeedAction& action) const;
    double target_offset(const World& world, const LaneOffsetAction& action) const;
    void take_path(World& world, const std::vector<Spot>& goals, PlayedStory& played);

    const PrivateAction* action_;
    std::size_t entity_;
    Transition transition_;
    int target_lane_ = 0;
    std::vector<std::pair<double, double>> profile_; ///< time since the begin, speed
    double since_s_ = 0.0;                           ///< begin
    std::shared_ptr<const Path> path_;
    double path_s_ = 0.0, path_time_s_ = 0.0;
    std::optional<Spot> target_, master_target_;
};

} // namespace fernlicht::osc
