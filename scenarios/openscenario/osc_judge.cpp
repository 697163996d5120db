#include "scenarios/openscenario/osc_judge.h"

#include "scenarios/openscenario/osc_conditions.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/xml_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace fernlicht::osc {
namespace {

bool texts_hold(const std::string& a, const std::string& b, Rule rule) {
    const auto left = to_number(a), right = to_number(b);
    if (left && right)
        return holds(*left, *right, rule);
    switch (rule) {
    case Rule::greater:
        return a > b;
    case Rule::less:
        return a < b;
    case Rule::greater_or_equal:
        return a >= b;
    case Rule::less_or_equal:
        return a <= b;
    case Rule::not_equal:
        return a != b;
    case Rule::equal:
        break;
    }
    return a == b;
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
    switch (rule) {
    case Rule::greater:
        return a > b + small;
    case Rule::less:
        return a < b - small;
    case Rule::greater_or_equal:
        return a >= b - small;
    case Rule::less_or_equal:
        return a <= b + small;
    case Rule::not_equal:
        return std::abs(a - b) >= small;
    case Rule::equal:
        break;
    }
    return std::abs(a - b) < small;
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
        const bool is = world.entities()[entity].present && entity_condition(condition.condition, entity, world);
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

bool JudgedTrigger::placed_value(Judged& judged, const World& world) {
    try {
        return value(judged, world);
    } catch (const PlaceError& error) {
        throw InputError({world.file(), judged.condition->line, 0, "Condition"}, error.found, error.expected);
    }
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
            const bool now = placed_value(judged, world), before = judged.last, known = judged.evaluated;
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
