#include "scenarios/openscenario/osc_conditions.h"

#include "scenarios/openscenario/osc_distances.h"
#include "scenarios/openscenario/osc_judge.h"
#include "scenarios/openscenario/osc_mover.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::osc {
namespace {

struct Asked {
    const World& world;
    const EntityState& self;

    bool lasting(const std::optional<double>& since_s, double duration_s) const {
        return since_s && world.time_s - *since_s >= duration_s - small;
    }
    const EntityState* other(const std::string& name) const {
        const EntityState& found = world.entity(name);
        return found.present ? &found : nullptr;
    }
    /// In the entity's own axes; total without sign.
    static double along(const glm::dvec3& vector, Direction direction, const Spot& spot) {
        if (direction == Direction::total)
            return glm::length(vector);
        return (vector * spot.pose.axes)[static_cast<int>(direction) - 1];
    }

    bool operator()(const EndOfRoadCondition& c) const { return lasting(self.end_of_road_since_s, c.duration_s); }
    bool operator()(const OffroadCondition& c) const { return lasting(self.offroad_since_s, c.duration_s); }
    bool operator()(const StandStillCondition& c) const { return lasting(self.still_since_s, c.duration_s); }
    bool operator()(const CollisionCondition& c) const {
        for (const EntityState& one : world.entities()) {
            if (&one == &self || !one.present)
                continue;
            const char* type = one.entity->kind == EntityKind::vehicle      ? "vehicle"
                               : one.entity->kind == EntityKind::pedestrian ? "pedestrian"
                                                                            : "miscellaneous";
            if ((c.entity.empty() ? c.type == type : c.entity == one.entity->name) && touching(self, one))
                return true;
        }
        return false;
    }
    bool operator()(const TimeHeadwayCondition& c) const {
        const EntityState* ahead = other(c.entity);
        const auto gap = ahead ? distance(world, self, *ahead, c.measure) : std::nullopt;
        return gap && *gap >= 0.0 && self.speed_mps >= small && holds(*gap / self.speed_mps, c.value_s, c.rule);
    }
    /// Undefined, and false, while they do not close in.
    bool operator()(const TimeToCollisionCondition& c) const {
        std::optional<double> gap;
        double closing = self.speed_mps;
        if (const auto* name = std::get_if<std::string>(&c.target)) {
            const EntityState* there = other(*name);
            if (!there)
                return false;
            gap = distance(world, self, *there, c.measure);
            const glm::dvec3 apart = there->spot.pose.position_m - self.spot.pose.position_m;
            if (c.measure.span == Span::straight && glm::length(apart) > small)
                closing = -glm::dot(there->velocity_mps - self.velocity_mps, apart) / glm::length(apart);
            else
                closing = along(self.velocity_mps - there->velocity_mps, Direction::longitudinal, self.spot);
        } else {
            gap = distance(world, self, world.spot(std::get<Position>(c.target)), c.measure);
        }
        return gap && closing > small && *gap >= 0.0 && holds(*gap / closing, c.value_s, c.rule);
    }
    bool operator()(const AccelerationCondition& c) const {
        return holds(along(self.acceleration, c.direction, self.spot), c.value, c.rule);
    }
    bool operator()(const SpeedCondition& c) const {
        const auto speed_of = [&](const EntityState& one) {
            return c.direction == Direction::total ? one.speed_mps : along(one.velocity_mps, c.direction, self.spot);
        };
        if (c.relative_to.empty())
            return holds(speed_of(self), c.value_mps, c.rule);
        const EntityState* there = other(c.relative_to);
        return there && holds(speed_of(self) - speed_of(*there), c.value_mps, c.rule);
    }
    bool operator()(const TraveledDistanceCondition& c) const { return self.travelled_m >= c.value_m - small; }
    bool operator()(const ReachPositionCondition& c) const {
        const glm::dvec3 apart = world.spot(c.position).pose.position_m - self.spot.pose.position_m;
        return std::hypot(apart.x, apart.y) < c.tolerance_m;
    }
    bool operator()(const DistanceCondition& c) const {
        const auto gap = distance(world, self, world.spot(c.position), c.measure);
        return holds(gap ? std::abs(*gap) : HUGE_VAL, c.value_m, c.rule);
    }
    bool operator()(const RelativeDistanceCondition& c) const {
        const EntityState* there = other(c.entity);
        if (!there)
            return false;
        const auto gap = distance(world, self, *there, c.measure);
        return holds(gap ? std::abs(*gap) : HUGE_VAL, c.value_m, c.rule);
    }
    /// No other stands on the lanes beside within the distances ahead and behind.
    bool operator()(const RelativeClearanceCondition& c) const {
        for (const EntityState& one : world.entities()) {
            if (&one == &self || !one.present ||
                (!c.entities.empty() && std::find(c.entities.begin(), c.entities.end(), one.entity->name) == c.entities.end()))
                continue;
            const auto gap = distance(world, self, one, {Frame::road, Span::longitudinal, c.freespace});
            if (!gap || *gap > c.ahead_m || *gap < -c.behind_m)
                continue;
            if (!c.opposite && std::cos(one.spot.heading_rad() - self.spot.heading_rad()) < 0.0)
                continue;
            const int beside = (one.spot.lane - self.spot.lane) * (self.spot.with_s() ? 1 : -1);
            const bool meant = c.lanes.empty() || std::any_of(c.lanes.begin(), c.lanes.end(), [&](const LaneRange& range) {
                                   return beside >= range.from.value_or(beside) && beside <= range.to.value_or(beside);
                               });
            if (meant)
                return false;
        }
        return true;
    }
    bool operator()(const AngleCondition& c) const {
        const auto angle_of = [&](const EntityState& one) {
            if (c.pitch)
                return -std::asin(std::clamp(one.spot.pose.forward().z, -1.0, 1.0));
            if (c.roll)
                return std::asin(std::clamp(one.spot.pose.left().z, -1.0, 1.0));
            return c.to_lane ? one.spot.relative_heading_rad : one.spot.heading_rad();
        };
        double wanted = c.angle_rad;
        if (!c.relative_to.empty()) {
            const EntityState* there = other(c.relative_to);
            if (!there)
                return false;
            wanted += angle_of(*there);
        }
        return std::abs(std::remainder(angle_of(self) - wanted, 2.0 * pi)) <= c.tolerance_rad + small;
    }
};

} // namespace

bool entity_condition(const EntityCondition& condition, std::size_t entity, const World& world) {
    return std::visit(Asked{world, world.entities()[entity]}, condition);
}

} // namespace fernlicht::osc
