#include "scenarios/openscenario/osc_actions.h"
#include "scenarios/openscenario/osc_mover.h"
#include "scenarios/values/errors.h"

#include <fmt/format.h>

namespace fernlicht::osc {
namespace {

template <class... Cases> struct Overloaded : Cases... { using Cases::operator()...; };
template <class... Cases> Overloaded(Cases...) -> Overloaded<Cases...>;

void take_path(const World& world, EntityState& car, const std::vector<Spot>& goals, PlayedStory& played) {
    car.path = plan_path(world, car.spot, goals);
    if (!car.path)
        played.notes.push_back(fmt::format("at {:.6g} s: no way over lanes leads {} along its route; it follows its lane", world.time_s,
                                           printable(car.entity->name)));
}

} // namespace

unsigned RunningAction::domains() const {
    return std::visit(Overloaded{[](const SpeedAction&) -> unsigned { return longitudinal_domain; },
                                 [](const SpeedProfileAction&) -> unsigned { return longitudinal_domain; },
                                 [](const LongitudinalDistanceAction&) -> unsigned { return longitudinal_domain; },
                                 [](const SynchronizeAction&) -> unsigned { return longitudinal_domain; },
                                 [](const LaneChangeAction&) -> unsigned { return lateral_domain; },
                                 [](const LaneOffsetAction&) -> unsigned { return lateral_domain; },
                                 [](const LateralDistanceAction&) -> unsigned { return lateral_domain; },
                                 [](const FollowTrajectoryAction& action) -> unsigned {
                                     return action.timed ? lateral_domain | longitudinal_domain : lateral_domain;
                                 },
                                 [](const LightStateAction&) -> unsigned { return light_domain; },
                                 [](const auto&) -> unsigned { return no_domain; }},
                      *action_);
}

bool RunningAction::conflicts(const RunningAction& other) const {
    if (entity_ != other.entity_ || (domains() & other.domains()) == 0)
        return false;
    const auto *mine = std::get_if<LightStateAction>(action_), *theirs = std::get_if<LightStateAction>(other.action_);
    return !mine || !theirs || mine->light == theirs->light;
}

void RunningAction::begin(World& world, PlayedStory& played) {
    EntityState& car = state(world);
    since_s_ = world.time_s;
    std::visit(Overloaded{[&](const SpeedAction& action) { begin_speed(world, action); },
                          [&](const SpeedProfileAction& action) { begin_profile(world, action); },
                          [&](const LaneChangeAction& action) { begin_lane_change(world, action); },
                          [&](const LaneOffsetAction& action) { begin_lane_offset(world, action); },
                          [&](const FollowTrajectoryAction& action) { begin_trajectory(world, action); },
                          [&](const TeleportAction& action) {
                              car.spot = world.spot(action.position);
                              car.present = true;
                              car.path.reset();
                              car.end_of_road = false;
                          },
                          [&](const VisibilityAction& action) { car.visible = action.graphics; },
                          [&](const LightStateAction& action) {
                              played.entities[entity_].lights.push_back({world.time_s, action});
                          },
                          [&](const AssignRouteAction& action) {
                              std::vector<Spot> goals;
                              for (const Waypoint& waypoint : action.route->waypoints)
                                  goals.push_back(world.spot(waypoint.position));
                              take_path(world, car, goals, played);
                          },
                          [&](const AcquirePositionAction& action) { take_path(world, car, {world.spot(action.position)}, played); },
                          [](const auto&) {}},
               *action_);
}

bool RunningAction::step(World& world, double dt_s, unsigned& moved) {
    return std::visit(Overloaded{[&](const SpeedAction& action) { return step_speed(world, action, dt_s); },
                                 [&](const SpeedProfileAction&) { return step_profile(world, dt_s); },
                                 [&](const LongitudinalDistanceAction& action) { return step_distance(world, action, dt_s); },
                                 [&](const SynchronizeAction& action) { return step_synchronize(world, action, dt_s); },
                                 [&](const LaneChangeAction& action) {
                                     moved |= longitudinal_domain | lateral_domain;
                                     return step_lane_change(world, action, dt_s);
                                 },
                                 [&](const LaneOffsetAction& action) {
                                     moved |= lateral_domain;
                                     return step_lane_offset(world, action, dt_s);
                                 },
                                 [&](const LateralDistanceAction& action) {
                                     moved |= lateral_domain;
                                     return step_lateral_distance(world, action, dt_s);
                                 },
                                 [&](const FollowTrajectoryAction& action) {
                                     moved |= longitudinal_domain | lateral_domain;
                                     return step_trajectory(world, action, dt_s);
                                 },
                                 [&](const LightStateAction& action) { return world.time_s >= since_s_ + action.transition_s - 1e-6; },
                                 [&](const AcquirePositionAction&) { return step_acquire(world); }, [](const auto&) { return true; }},
                      *action_);
}

} // namespace fernlicht::osc
