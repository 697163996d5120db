#include "scenarios/openscenario/osc_judge.h"

#include "scenarios/values/xml_file.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

namespace fernlicht::osc {
namespace {

/// Of an entity that is present. Conditions about others that are not present are false.
struct Asked {
    const World& world;
    const EntityState& self;

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

    bool operator()(const LastingCondition& c) const {
        const auto& since_s = c.state == LastingCondition::State::end_of_road ? self.end_of_road_since_s
                              : c.state == LastingCondition::State::offroad   ? self.offroad_since_s
                                                                              : self.still_since_s;
        return since_s && world.time_s - *since_s >= c.duration_s - small;
    }
    bool operator()(const CollisionCondition& c) const {
        for (const EntityState& one : world.entities()) {
            if (&one == &self || !one.present)
                continue;
            if ((c.entity.empty() ? c.type == type_of(one.entity->kind) : c.entity == one.entity->name) && touching(self, one))
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
        const auto* position = std::get_if<Position>(&c.target);
        const EntityState* there = position ? nullptr : other(std::get<std::string>(c.target));
        if (!position && !there)
            return false;
        const auto gap = there ? distance(world, self, *there, c.measure) : distance(world, self, world.spot(*position), c.measure);
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

bool texts_hold(const std::string& a, const std::string& b, Rule rule) {
    const auto left = to_number(a), right = to_number(b);
    if (left && right)
        return holds(*left, *right, rule);
    return std::array{a > b, a < b, a == b, a >= b, a <= b, a != b}[static_cast<std::size_t>(rule)];
}

bool named_value(const NamedValueCondition& condition, const World& world) {
    const auto& values = condition.variable ? world.variables : world.parameters;
    const auto value = values.find(condition.name);
    return value != values.end() && texts_hold(value->second, condition.value, condition.rule);
}

bool signal_is(const TrafficSignalCondition& condition, const World& world) {
    const auto& values = condition.controller ? world.phases : world.signals;
    const auto value = values.find(condition.name);
    return value != values.end() && value->second == condition.state;
}

bool time_of_day(const TimeOfDayCondition& condition, const World& world) {
    const auto wanted = seconds_of(condition.date_time);
    if (!wanted || !world.environment || !world.environment->date_time)
        return false;
    const auto given = seconds_of(*world.environment->date_time);
    const double now =
        given.value_or(0.0) + (world.environment->time_runs ? world.day_rate * (world.time_s - world.environment_since_s) : 0.0);
    return given && holds(now, *wanted, condition.rule);
}

} // namespace

bool holds(double a, double b, Rule rule) {
    return std::array{a > b + small, a < b - small, std::abs(a - b) < small, a >= b - small, a <= b + small, std::abs(a - b) >= small}
        [static_cast<std::size_t>(rule)];
}

std::optional<double> seconds_of(const std::string& text) {
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, read = 0;
    double second = 0.0;
    if (std::sscanf(text.c_str(), "%d-%d-%dT%d:%d:%lf%n", &year, &month, &day, &hour, &minute, &second, &read) != 6) // NOLINT(cert-err34-c)
        return {};
    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok() || hour < 0 || hour > 24 || minute < 0 || minute > 59 || !(second >= 0.0 && second < 61.0))
        return {};
    double offset_s = 0.0;
    int oh = 0, om = 0;
    const std::string rest = text.substr(static_cast<std::size_t>(read));
    if (std::sscanf(rest.c_str(), "%3d:%2d", &oh, &om) >= 1) // NOLINT(cert-err34-c)
        offset_s = 3600.0 * oh + (oh < 0 || rest.starts_with('-') ? -60.0 : 60.0) * om;
    const auto days = std::chrono::sys_days(date).time_since_epoch().count();
    return 86400.0 * static_cast<double>(days) + 3600.0 * hour + 60.0 * minute + second - offset_s;
}

JudgedTrigger::JudgedTrigger(const Trigger& trigger, const FindElement& find) {
    for (const auto& group : trigger.groups) {
        groups_.emplace_back();
        for (const TimedCondition& condition : group) {
            Judged judged{};
            judged.condition = &condition;
            if (const auto* state = std::get_if<ElementStateCondition>(&condition.condition))
                judged.elements = find(*state);
            judged.seen.assign(judged.elements.size(), 0);
            groups_.back().push_back(std::move(judged));
        }
    }
}

bool JudgedTrigger::state_is(Judged& judged, const ElementStateCondition& condition) {
    bool is = false, changed = false;
    for (std::size_t i = 0; i < judged.elements.size(); ++i)
        for (std::size_t& at = judged.seen[i]; at < judged.elements[i]->size(); ++at) {
            const ElementChange& change = (*judged.elements[i])[at];
            is = is || change.state == condition.state || change.transition == condition.state;
            judged.last_state = change.state;
            changed = true;
        }
    return changed ? is : judged.last_state == condition.state;
}

bool JudgedTrigger::by_entity(const ByEntity& condition, const World& world) {
    bool any = false, all = true;
    std::vector<std::size_t> by;
    for (const std::string& name : condition.entities) {
        const std::size_t entity = world.index_of(name);
        const EntityState& self = world.entities()[entity];
        bool is = false;
        try {
            is = self.present && std::visit(Asked{world, self}, condition.condition);
        } catch (const NoPlaceYet&) { // false, as a condition about an entity that is not there
        }
        any = any || is;
        all = all && is;
        if (is)
            by.push_back(entity);
    }
    const bool result = condition.all ? all : any;
    if (result)
        triggered_by_.insert(triggered_by_.end(), by.begin(), by.end());
    return result;
}

bool JudgedTrigger::value(Judged& judged, const World& world) {
    const Condition& condition = judged.condition->condition;
    if (const auto* entity = std::get_if<ByEntity>(&condition))
        return by_entity(*entity, world);
    if (const auto* time = std::get_if<SimulationTimeCondition>(&condition))
        return holds(world.time_s, time->value_s, time->rule);
    if (const auto* day = std::get_if<TimeOfDayCondition>(&condition))
        return time_of_day(*day, world);
    if (const auto* named = std::get_if<NamedValueCondition>(&condition))
        return named_value(*named, world);
    if (const auto* signal = std::get_if<TrafficSignalCondition>(&condition))
        return signal_is(*signal, world);
    return state_is(judged, std::get<ElementStateCondition>(condition));
}

/// True if the value was true at any time since it was last asked, a delay ago.
bool JudgedTrigger::delayed(Judged& judged, bool value, double time_s) {
    auto& history = judged.history;
    if (history.empty() || history.back().second != value)
        history.emplace_back(time_s, value);
    const double then = time_s - judged.condition->delay_s;
    bool is = judged.past > 0 && history[judged.past - 1].second;
    if (judged.past < history.size() && then > history[judged.past].first - small) {
        is = false;
        for (; judged.past < history.size() && then > history[judged.past].first - small; ++judged.past)
            is = is || history[judged.past].second;
    }
    return is;
}

bool JudgedTrigger::judge(const World& world) {
    triggered_by_.clear();
    bool any = false;
    for (auto& group : groups_) {
        bool all = !group.empty();
        for (Judged& judged : group) {
            if (!all && judged.condition->delay_s <= 0.0)
                continue;
            const bool now = placed(world.file(), judged.condition->line, "Condition", [&] { return value(judged, world); });
            const bool before = judged.last, known = judged.evaluated;
            judged.last = now;
            judged.evaluated = true;
            bool edge = now;
            if (judged.condition->edge == Edge::rising)
                edge = known && now && !before;
            else if (judged.condition->edge == Edge::falling)
                edge = known && !now && before;
            else if (judged.condition->edge == Edge::either)
                edge = known && now != before;
            all = delayed(judged, edge, world.time_s) && all;
        }
        any = any || all;
    }
    if (any)
        for (auto& group : groups_)
            for (Judged& judged : group)
                judged.evaluated = false;
    return any;
}

void JudgedTrigger::reset() {
    for (auto& group : groups_)
        for (Judged& judged : group) {
            judged.history.clear();
            judged.past = 0;
            for (std::size_t i = 0; i < judged.elements.size(); ++i)
                judged.seen[i] = judged.elements[i]->size();
        }
}

} // namespace fernlicht::osc
