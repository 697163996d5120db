#include "scenarios/openscenario/osc_actions.h"

#include "scenarios/roads/plan.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <type_traits>

namespace fernlicht::osc {
namespace {

double limited(double speed_mps, const SpeedLimits& limits) {
    const double most = limits.speed_mps.value_or(HUGE_VAL);
    return std::clamp(speed_mps, -most, most);
}

double limited_change(double from_mps, double to_mps, double dt_s, const SpeedLimits& limits) {
    const double up = limits.acceleration.value_or(HUGE_VAL) * dt_s, down = limits.deceleration.value_or(HUGE_VAL) * dt_s;
    return dt_s > 0.0 ? std::clamp(to_mps, from_mps - down, from_mps + up) : from_mps;
}

template <class Kind, class... Known> constexpr bool is_one_of = (std::is_same_v<Kind, Known> || ...);

} // namespace

unsigned RunningAction::domains() const {
    return std::visit(
        []<class Kind>(const Kind& action) -> unsigned {
            if constexpr (is_one_of<Kind, SpeedAction, SpeedProfileAction, LongitudinalDistanceAction, SynchronizeAction>)
                return longitudinal_domain;
            else if constexpr (is_one_of<Kind, LaneChangeAction, LaneOffsetAction, LateralDistanceAction>)
                return lateral_domain;
            else if constexpr (is_one_of<Kind, FollowTrajectoryAction>)
                return action.timed ? lateral_domain | longitudinal_domain : lateral_domain;
            else
                return is_one_of<Kind, LightStateAction> ? light_domain : no_domain;
        },
        *action_);
}

bool RunningAction::conflicts(const RunningAction& other) const {
    if (entity_ != other.entity_ || (domains() & other.domains()) == 0)
        return false;
    const auto *mine = std::get_if<LightStateAction>(action_), *theirs = std::get_if<LightStateAction>(other.action_);
    return !mine || !theirs || mine->light == theirs->light;
}

void RunningAction::begin(World& world, PlayedStory& played) {
    since_s_ = world.time_s;
    std::visit([&](const auto& action) { begin(action, world, played); }, *action_);
}

bool RunningAction::step(World& world, double dt_s, unsigned& moved) {
    moved |= domains() & lateral_domain;
    if (std::holds_alternative<LaneChangeAction>(*action_) || std::holds_alternative<FollowTrajectoryAction>(*action_))
        moved |= longitudinal_domain;
    return std::visit([&](const auto& action) { return step(action, world, dt_s); }, *action_);
}

void RunningAction::begin(const SpeedAction& action, World& world, PlayedStory& /*played*/) {
    EntityState& car = state(world);
    const SpeedLimits& limits = car.entity->limits;
    const double from = car.speed_mps, to = limited(target_speed(world, action), limits);
    Dynamics dynamics = action.dynamics;
    if (dynamics.dimension == Dimension::distance) { // the time in which the distance is driven at the mean speed
        if (std::abs(to - from) < small)
            dynamics.value = 0.0;
        else if (from * to < 0.0)
            dynamics.value = 2.0 * dynamics.value * (std::abs(from) + std::abs(to)) / (from * from + to * to);
        else
            dynamics.value = 2.0 * dynamics.value / std::abs(from + to);
        dynamics.dimension = Dimension::time;
    }
    transition_ = Transition(dynamics, from, to);
    transition_.limit_rate((to > from ? limits.acceleration : limits.deceleration).value_or(HUGE_VAL));
    car.speed_mps = transition_.value();
}

double RunningAction::target_speed(const World& world, const SpeedAction& action) const {
    if (const double* absolute = std::get_if<double>(&action.target))
        return *absolute;
    const auto& relative = std::get<RelativeSpeed>(action.target);
    const double other = world.entity(relative.entity).speed_mps;
    return relative.factor ? other * relative.value : other + relative.value;
}

bool RunningAction::step(const SpeedAction& action, World& world, double dt_s) {
    EntityState& car = state(world);
    const SpeedLimits& limits = car.entity->limits;
    const auto* relative = std::get_if<RelativeSpeed>(&action.target);
    if (relative)
        transition_.retarget(limited(target_speed(world, action), limits));
    const bool was_over = transition_.over() && !transition_.at_once();
    double speed = transition_.target();
    if (!was_over) {
        transition_.advance(dt_s);
        speed = transition_.value();
    }
    if (was_over || transition_.at_once())
        speed = dt_s > 0.0 ? limited_change(car.speed_mps, speed, dt_s, limits) : car.speed_mps;
    car.speed_mps = limited(speed, limits);
    const bool reached = transition_.over() && std::abs(car.speed_mps - transition_.target()) < small;
    return reached && !(relative && relative->continuous);
}

void RunningAction::begin(const SpeedProfileAction& action, World& world, PlayedStory& /*played*/) {
    EntityState& car = state(world);
    const double offset = action.relative_to.empty() ? 0.0 : world.entity(action.relative_to).speed_mps;
    profile_ = {{0.0, car.speed_mps}};
    for (const SpeedEntry& entry : action.entries) {
        const double to = limited(entry.speed_mps + offset, action.limits), from = profile_.back().second, by = to - from;
        const double most = (by > 0.0 ? action.limits.acceleration : action.limits.deceleration)
                                .value_or((by > 0.0 ? car.entity->limits.acceleration : car.entity->limits.deceleration).value_or(10.0));
        double lasts = entry.duration_s.value_or(0.0);
        if (by != 0.0 && most > 0.0)
            lasts = std::max(lasts, std::abs(by) / most);
        if (entry.duration_s && *entry.duration_s == 0.0 && profile_.size() == 1)
            profile_.back().second = to; // where it begins
        else
            profile_.emplace_back(profile_.back().first + lasts, to);
    }
    since_s_ = 0.0;
}

bool RunningAction::step(const SpeedProfileAction& /*action*/, World& world, double dt_s) {
    since_s_ += dt_s;
    EntityState& car = state(world);
    for (std::size_t i = 1; i < profile_.size(); ++i)
        if (since_s_ < profile_[i].first) {
            const auto& [t0, v0] = profile_[i - 1];
            const auto& [t1, v1] = profile_[i];
            car.speed_mps = std::lerp(v0, v1, (since_s_ - t0) / (t1 - t0));
            return false;
        }
    car.speed_mps = profile_.back().second;
    return true;
}

void RunningAction::begin(const LaneChangeAction& action, World& world, PlayedStory& played) {
    EntityState& car = state(world);
    Spot& spot = car.spot;
    if (!spot.on_network)
        return;
    if (const int* absolute = std::get_if<int>(&action.target)) {
        target_lane_ = *absolute;
    } else {
        const auto& relative = std::get<RelativeLane>(action.target);
        const Spot& other = world.entity(relative.entity).spot;
        target_lane_ = other.lane + relative.lanes * (other.with_s() ? 1 : -1);
        if (relative.lanes != 0 && (target_lane_ == 0 || (target_lane_ > 0) != (other.lane > 0)))
            target_lane_ += target_lane_ > other.lane ? 1 : -1; // lane 0 has no width
    }
    const Road& road = world.network().roads[spot.road];
    const bool forward = spot.with_s();
    if (!lane_of(road, target_lane_, spot.s_m)) {
        std::vector<int> there;
        for (const Lane& lane : section_at(road, spot.s_m).lanes)
            if (lane.id != 0)
                there.push_back(lane.id);
        played.notes.push_back(fmt::format("at {:.6g} s: {} cannot change to lane {}, road '{}' has {} there; it stays on lane {}",
                                           world.time_s, printable(car.entity->name), target_lane_, printable(road.id),
                                           fmt::join(there, ", "), spot.lane));
        target_lane_ = spot.lane;
    }
    const double offset = spot.t_m - lane_centre_t(road, target_lane_, spot.s_m);
    spot = world.on_lane(spot.road, target_lane_, spot.s_m, offset, forward ? 0.0 : pi);
    transition_ = Transition(action.dynamics, offset, action.target_offset_m);
    car.settle_to_m.reset();
}

/// The way of a step is that of the car: what goes sideways does not go ahead.
bool RunningAction::step(const LaneChangeAction& action, World& world, double dt_s) {
    EntityState& car = state(world);
    Spot& spot = car.spot;
    const double step_m = std::abs(car.speed_mps) * dt_s;
    if (!spot.on_network)
        return true;
    if (std::abs(car.speed_mps) < small)
        return false;
    const double slope = transition_.slope();
    double ahead_m = step_m, offset = 0.0, angle = 0.0;
    if (transition_.at_once()) {
        offset = transition_.value();
    } else if (action.dynamics.dimension == Dimension::distance) {
        ahead_m = step_m / std::sqrt(1.0 + slope * slope);
        transition_.advance(ahead_m);
        offset = transition_.value();
        angle = std::atan(slope);
    } else {
        const double aside_m = dt_s * std::abs(slope);
        if (aside_m < step_m + small) {
            ahead_m = std::sqrt(std::max(step_m * step_m - aside_m * aside_m, 0.0));
            transition_.advance(dt_s);
            offset = transition_.value();
            angle = std::atan2(slope * dt_s, ahead_m);
        } else { // too slow for it: straight to the side
            ahead_m = 0.0;
            transition_.advance(step_m * transition_.length() / std::abs(transition_.target() - transition_.start()));
            offset = transition_.linear_value();
            angle = std::copysign(0.5 * pi - small, slope);
        }
    }
    const bool forward = spot.with_s();
    Spot aside = world.on_lane(spot.road, spot.lane, spot.s_m, offset, forward ? 0.0 : pi);
    const Moved moved = move_along(world, aside, std::copysign(ahead_m, car.speed_mps), true, car.path ? &*car.path : nullptr);
    spot = moved.spot;
    car.end_of_road = moved.end_of_road;
    const bool over = transition_.over() || std::abs(offset - transition_.target()) < small;
    if (!over) {
        const double turn = (spot.with_s() ? angle : -angle) * (car.speed_mps < 0.0 ? -1.0 : 1.0);
        spot = world.on_lane(spot.road, spot.lane, spot.s_m, spot.offset_m, (spot.with_s() ? 0.0 : pi) + turn);
    }
    return over || moved.end_of_road;
}

double RunningAction::target_offset(const World& world, const LaneOffsetAction& action) const {
    const Spot& spot = world.entities()[entity_].spot;
    if (const double* absolute = std::get_if<double>(&action.target))
        return *absolute;
    const auto& relative = std::get<RelativeOffset>(action.target);
    const Spot& other = world.entity(relative.entity).spot;
    const Road& road = world.network().roads[spot.road];
    return other.t_m + relative.offset_m * (other.with_s() ? 1.0 : -1.0) - lane_centre_t(road, spot.lane, spot.s_m);
}

/// The longest lateral acceleration is pi^2 b / 2 T^2 of the sinusoidal, 6 b / T^2 of the cubic shape; linear takes that of the cubic.
void RunningAction::begin(const LaneOffsetAction& action, World& world, PlayedStory& /*played*/) {
    const Spot& spot = state(world).spot;
    if (!spot.on_network)
        return;
    const double target = target_offset(world, action), by = std::abs(target - spot.offset_m);
    const double most = action.max_lateral_acceleration.value_or(HUGE_VAL);
    const double factor = action.shape == Shape::sinusoidal ? 0.5 * pi * pi : 6.0;
    const double lasts = std::isfinite(most) && most > 0.0 ? std::sqrt(factor * by / most) : 0.0;
    transition_ = Transition({action.shape, Dimension::time, lasts}, spot.offset_m, target);
}

bool RunningAction::step(const LaneOffsetAction& action, World& world, double dt_s) {
    EntityState& car = state(world);
    Spot& spot = car.spot;
    if (!spot.on_network)
        return true;
    const bool over = transition_.over();
    if (over && action.continuous)
        transition_.retarget(target_offset(world, action));
    const double offset = over ? transition_.target() : transition_.value();
    const double angle = over ? 0.0 : std::atan2(transition_.slope(), std::max(std::abs(car.speed_mps), small));
    const bool forward = spot.with_s();
    spot = world.on_lane(spot.road, spot.lane, spot.s_m, offset, forward ? angle : pi - angle);
    transition_.advance(dt_s);
    return over && !action.continuous;
}

bool RunningAction::step(const LateralDistanceAction& action, World& world, double dt_s) {
    EntityState& car = state(world);
    const EntityState& other = world.entity(action.entity);
    if (!car.spot.on_network)
        return true;
    const double half = action.freespace ? 0.5 * (car.entity->box.width_m + other.entity->box.width_m) : 0.0;
    const double side = car.spot.t_m >= other.spot.t_m ? 1.0 : -1.0;
    const double wanted = other.spot.t_m + side * (action.distance_m + half), most = action.max_speed_mps.value_or(HUGE_VAL) * dt_s;
    const double by = dt_s > 0.0 ? std::clamp(wanted - car.spot.t_m, -most, most) : 0.0;
    car.spot = world.on_lane(car.spot.road, car.spot.lane, car.spot.s_m, car.spot.offset_m + by, car.spot.relative_heading_rad);
    return !action.continuous && std::abs(wanted - car.spot.t_m) < 0.01;
}

/// A critically damped second-order law for the gap, within the limits; without limits the gap is taken at once.
bool RunningAction::step(const LongitudinalDistanceAction& action, World& world, double dt_s) {
    constexpr double reached_m = 0.1, natural_per_s = 0.8;
    EntityState& car = state(world);
    const EntityState& other = world.entity(action.entity);
    const double gap = longitudinal_gap(world, car, other, action.freespace);
    double wanted = action.distance_m ? *action.distance_m : *action.time_gap_s * std::abs(other.speed_mps);
    if (action.ahead || (action.any_side && gap < 0.0))
        wanted = -wanted;
    const double error = gap - wanted;
    const SpeedLimits& given = action.limits;
    if (!given.acceleration && !given.deceleration && !given.speed_mps) {
        if (dt_s > 0.0) {
            const Moved moved = move_along(world, car.spot, error, false, nullptr);
            car.spot = moved.spot;
            car.speed_mps = other.speed_mps;
        }
    } else {
        const double pull = natural_per_s * natural_per_s * error + 2.0 * natural_per_s * (other.speed_mps - car.speed_mps);
        const double held = std::clamp(pull, -given.deceleration.value_or(HUGE_VAL), given.acceleration.value_or(HUGE_VAL));
        const double most = given.speed_mps.value_or(HUGE_VAL);
        car.speed_mps = std::clamp(car.speed_mps + held * dt_s, -most, most);
    }
    return !action.continuous && std::abs(error) < reached_m;
}

void RunningAction::begin(const FollowTrajectoryAction& action, World& world, PlayedStory& /*played*/) {
    EntityState& car = state(world);
    path_ = std::make_shared<const Path>(build_path(*action.trajectory, world, car.spot));
    path_s_ = action.initial_offset_m;
    const PathPoint start = path_->at(path_s_);
    path_time_s_ = start.time_s.value_or(0.0);
    car.stand_at(world.at_point({start.x_m, start.y_m, start.z_m}, path_->has_z, start.heading_rad, {}, {},
                                car.spot.on_network ? std::optional(car.spot.road) : std::nullopt));
    car.path.reset();
    if (action.timed && path_->timed && path_->points.size() > 1) {
        const PathPoint& a = path_->points[0];
        const PathPoint& b = path_->points[1];
        if (*b.time_s > *a.time_s)
            car.speed_mps = (b.s_m - a.s_m) / (*b.time_s - *a.time_s) * action.time_scale;
    }
}

bool RunningAction::step(const FollowTrajectoryAction& action, World& world, double dt_s) {
    EntityState& car = state(world);
    const double before = path_s_;
    double beyond_m = 0.0;
    bool over = false;
    PathPoint at;
    if (action.timed && path_->timed) {
        path_time_s_ = action.time_absolute ? (world.time_s + dt_s) * action.time_scale : path_time_s_ + action.time_scale * dt_s;
        const double time = path_time_s_ + action.time_offset_s;
        at = path_->at_time(time);
        path_s_ = at.s_m;
        over = time > path_->end_s() - small;
        if (over)
            beyond_m = std::max(time - path_->end_s(), 0.0) * car.speed_mps;
        else if (dt_s > small)
            car.speed_mps = (path_s_ - before) / dt_s;
    } else {
        path_s_ += car.speed_mps * dt_s;
        over = dt_s > 0.0 && !path_->closed && (path_s_ > path_->length_m() - small || (car.speed_mps < 0.0 && path_s_ < small));
        if (over)
            beyond_m = std::max(path_s_ - path_->length_m(), 0.0);
        at = path_->at(path_s_);
    }
    car.spot = world.at_point({at.x_m + beyond_m * std::cos(at.heading_rad), at.y_m + beyond_m * std::sin(at.heading_rad), at.z_m},
                              path_->has_z, at.heading_rad, {}, {}, car.spot.on_network ? std::optional(car.spot.road) : std::nullopt);
    return over;
}

/// Speed as a quadratic of time that covers the distance in the master's time and ends at the final speed (without one: a constant
/// acceleration), solved anew at each step.
bool RunningAction::step(const SynchronizeAction& action, World& world, double dt_s) {
    EntityState& car = state(world);
    const EntityState& master = world.entity(action.master);
    if (!target_) {
        target_ = world.spot(action.target);
        master_target_ = world.spot(action.master_target);
    }
    double way = way_to(world, car, *target_), time = 0.0;
    const double master_way = way_to(world, master, *master_target_);
    if (way <= std::max(action.tolerance_m, small) || master_way <= std::max(action.master_tolerance_m, small))
        return true;
    if (dt_s <= 0.0 || std::abs(master.speed_mps) < small)
        return false;
    time = master_way / std::abs(master.speed_mps);
    std::optional<double> final_mps;
    if (action.final_speed)
        final_mps = action.final_speed->value + (action.final_speed->relative ? master.speed_mps : 0.0);
    if (final_mps && *final_mps > 0.0) {
        double steady_s = action.final_speed->steady_time_s.value_or(0.0);
        if (action.final_speed->steady_distance_m)
            steady_s = *action.final_speed->steady_distance_m / *final_mps;
        if (time <= steady_s) {
            car.speed_mps = limited_change(car.speed_mps, *final_mps, dt_s, car.entity->limits);
            return false;
        }
        time -= steady_s;
        way -= steady_s * *final_mps;
    }
    if (time < 2.0 * dt_s)
        return false;
    const double now = car.speed_mps;
    const double acceleration =
        final_mps ? 6.0 * (way - now * time - (*final_mps - now) * time / 3.0) / (time * time) : 2.0 * (way - now * time) / (time * time);
    car.speed_mps = limited(limited_change(now, std::max(now + acceleration * dt_s, 0.0), dt_s, car.entity->limits), car.entity->limits);
    return false;
}

bool RunningAction::step(const AcquirePositionAction& /*action*/, World& world, double /*dt_s*/) {
    const EntityState& car = state(world);
    if (!car.path)
        return true;
    const Spot& goal = car.path->goal;
    return car.spot.road == goal.road && (car.spot.with_s() ? car.spot.s_m >= goal.s_m : car.spot.s_m <= goal.s_m);
}

void RunningAction::begin(const TeleportAction& action, World& world, PlayedStory& /*played*/) {
    EntityState& car = state(world);
    car.stand_at(world.spot(action.position));
    car.path.reset();
    car.end_of_road = false;
}

void RunningAction::begin(const VisibilityAction& action, World& world, PlayedStory& /*played*/) { state(world).visible = action.graphics; }

void RunningAction::begin(const LightStateAction& action, World& world, PlayedStory& played) {
    played.entities[entity_].lights.push_back({world.time_s, action});
}

bool RunningAction::step(const LightStateAction& action, World& world, double /*dt_s*/) {
    return world.time_s >= since_s_ + action.transition_s - 1e-6;
}

void RunningAction::begin(const AssignRouteAction& action, World& world, PlayedStory& played) {
    std::vector<Spot> goals;
    for (const Position& waypoint : action.route->waypoints)
        goals.push_back(world.spot(waypoint));
    take_path(world, goals, played);
}

void RunningAction::begin(const AcquirePositionAction& action, World& world, PlayedStory& played) {
    take_path(world, {world.spot(action.position)}, played);
}

void RunningAction::take_path(World& world, const std::vector<Spot>& goals, PlayedStory& played) {
    EntityState& car = state(world);
    car.path = plan_path(world, car.spot, goals);
    if (!car.path)
        played.notes.push_back(fmt::format("at {:.6g} s: no way over lanes leads {} along its route; it follows its lane", world.time_s,
                                           printable(car.entity->name)));
}

} // namespace fernlicht::osc
