#include "scenarios/openscenario/play_story.h"

#include "scenarios/openscenario/story_tree.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht::osc {
namespace {

constexpr double still_mps = 1e-3;
constexpr double settle_mps = 1.0, settle_slope = 0.15; ///< how quickly a car glides to the lane its way needs

/// On its way to a goal the car changes to the lane that its road is to be left on.
void glide(const World& world, EntityState& car, double dt_s) {
    if (car.path && car.path->at < car.path->steps.size()) {
        const RoadPath::Step& step = car.path->steps[car.path->at];
        const Road& road = world.network().roads[car.spot.road];
        if (step.road == car.spot.road && step.lane != car.spot.lane && lane_of(road, step.lane, car.spot.s_m)) {
            const double offset = car.spot.t_m - lane_centre_t(road, step.lane, car.spot.s_m);
            car.spot = world.on_lane(car.spot.road, step.lane, car.spot.s_m, offset, car.spot.relative_heading_rad);
            car.settle_to_m = 0.0;
        }
    }
    if (!car.settle_to_m)
        return;
    const double most = std::min(settle_mps, settle_slope * std::abs(car.speed_mps)) * dt_s;
    const double by = std::clamp(*car.settle_to_m - car.spot.offset_m, -most, most);
    const bool forward = car.spot.with_s();
    const double angle = std::atan2(by, std::max(std::abs(car.speed_mps) * dt_s, small));
    const bool over = std::abs(*car.settle_to_m - car.spot.offset_m) <= most;
    car.spot = world.on_lane(car.spot.road, car.spot.lane, car.spot.s_m, car.spot.offset_m + by,
                             over ? (forward ? 0.0 : pi) : (forward ? angle : pi - angle));
    if (over)
        car.settle_to_m.reset();
}

/// What nothing else moved goes on along its lane; without a road straight on.
void move_on(const World& world, EntityState& car, unsigned moved, double dt_s) {
    if ((moved & longitudinal_domain) != 0 || std::abs(car.speed_mps) < small || dt_s <= 0.0)
        return;
    if (!car.spot.on_network) {
        car.spot.pose.position_m += car.spot.pose.forward() * (car.speed_mps * dt_s);
        return;
    }
    const Moved there = move_along(world, car.spot, car.speed_mps * dt_s, true, car.path ? &*car.path : nullptr);
    car.end_of_road = there.end_of_road;
    car.spot = there.spot;
    if ((moved & lateral_domain) == 0)
        glide(world, car, dt_s);
}

void keep_since(std::optional<double>& since_s, bool is, double time_s) {
    if (!is)
        since_s.reset();
    else if (!since_s)
        since_s = time_s;
}

void derive(const World& world, EntityState& car, const glm::dvec3& before, double dt_s) {
    if (dt_s > 0.0) {
        const glm::dvec3 by = car.spot.pose.position_m - before;
        car.travelled_m += glm::length(by);
        const glm::dvec3 velocity = car.spot.pose.forward() * car.speed_mps;
        car.acceleration = (velocity - car.velocity_mps) / dt_s;
        car.velocity_mps = velocity;
        if (car.end_of_road && glm::length(by) < 1e-9)
            car.speed_mps = 0.0; // nowhere to go
    } else {
        car.velocity_mps = car.spot.pose.forward() * car.speed_mps;
    }
    keep_since(car.still_since_s, std::abs(car.speed_mps) < still_mps, world.time_s);
    keep_since(car.end_of_road_since_s, car.end_of_road, world.time_s);
    const bool off = !car.spot.on_network || lane_at(world.network().roads[car.spot.road], car.spot.s_m, car.spot.t_m) == 0;
    keep_since(car.offroad_since_s, off, world.time_s);
}

EntitySample sample(const EntityState& car) {
    EntitySample out;
    const Pose& pose = car.spot.pose;
    out.position_m = pose.position_m;
    out.heading_rad = car.spot.heading_rad();
    out.pitch_rad = std::asin(std::clamp(pose.forward().z, -1.0, 1.0));
    // Roll as axes_from_angles has it: after yaw and pitch.
    const glm::dmat3 level = axes_from_angles(out.heading_rad, out.pitch_rad, 0.0);
    out.roll_rad = std::atan2(glm::dot(pose.left(), level[2]), glm::dot(pose.left(), level[1]));
    out.speed_mps = car.speed_mps;
    out.present = car.present;
    out.visible = car.visible;
    out.road = car.spot.road;
    out.lane = car.spot.on_network ? car.spot.lane : 0;
    out.s_m = car.spot.s_m;
    out.t_m = car.spot.t_m;
    return out;
}

/// Phases of the traffic lights' controllers at this time; a controller that an action set stays there.
void run_signals(const Storyboard& storyboard, World& world) {
    for (const TrafficController& controller : storyboard.signals) {
        double cycle = 0.0, begin = controller.delay_s;
        for (const TrafficPhase& phase : controller.phases)
            cycle += phase.duration_s;
        for (const TrafficController& other : storyboard.signals)
            if (!controller.reference.empty() && other.name == controller.reference)
                begin += other.delay_s;
        if (!(cycle > 0.0) || world.time_s < begin - small)
            continue;
        double at = std::fmod(world.time_s - begin + small, cycle);
        for (const TrafficPhase& phase : controller.phases) {
            if (at < phase.duration_s) {
                if (world.phases[controller.name] != phase.name) {
                    world.phases[controller.name] = phase.name;
                    for (const auto& [signal, state] : phase.states)
                        world.signals[signal] = state;
                }
                break;
            }
            at -= phase.duration_s;
        }
    }
}

} // namespace

PlayedStory play_story(const Storyboard& storyboard, const RoadNetwork& network, const PlayStoryOptions& options) {
    PlayedStory played;
    played.step_s = options.step_s;
    for (const Entity& entity : storyboard.entities)
        played.entities.push_back({entity, {}, {}});
    World world(storyboard, network);
    world.day_rate = options.day_rate;
    StoryTree tree(storyboard, world, played);
    tree.start();
    const auto steps = static_cast<std::size_t>(std::ceil(options.max_s / options.step_s - small));
    played.end = fmt::format("{:.6g} s were played", options.max_s);
    for (std::size_t k = 0; k <= steps; ++k) { // step 0 moves nothing: what begins at the start shows in the first row
        const double dt = k == 0 ? 0.0 : options.step_s;
        run_signals(storyboard, world);
        std::vector<unsigned> moved(world.entities().size(), 0);
        std::vector<glm::dvec3> before;
        for (const EntityState& car : world.entities())
            before.push_back(car.spot.pose.position_m);
        tree.step(dt, moved);
        if (tree.stopped()) {
            played.end = "the stop trigger";
            break;
        }
        world.time_s = static_cast<double>(k) * options.step_s;
        for (std::size_t i = 0; i < world.entities().size(); ++i) {
            EntityState& car = world.entities()[i];
            if (!car.present)
                continue;
            move_on(world, car, moved[i], dt);
            derive(world, car, before[i], dt);
        }
        for (std::size_t i = 0; i < world.entities().size(); ++i)
            played.entities[i].samples.push_back(sample(world.entities()[i]));
        if (tree.all_over() && !storyboard.stop) {
            played.end = "all stories are over";
            break;
        }
    }
    return played;
}

} // namespace fernlicht::osc
