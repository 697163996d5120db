#include "scenarios/openscenario/reader/read_parts.h"

#include "scenarios/values/errors.h"

#include <fmt/format.h>

namespace fernlicht::osc {
namespace {

Rule rule_of(const OscNode& node) {
    return static_cast<Rule>(node.choice("rule", {"greaterThan", "lessThan", "equalTo", "greaterOrEqual", "lessOrEqual", "notEqualTo"}));
}

Measure measure_of(const OscNode& node) {
    Measure measure;
    measure.freespace = node.flag_or("freespace", node.flag_or("freeSpace", false));
    const bool along_route = node.flag_or("alongRoute", false); // 1.0
    if (node.has("coordinateSystem"))
        measure.frame = static_cast<Frame>(node.choice("coordinateSystem", {"entity", "lane", "road", "trajectory", "world"}));
    else if (along_route)
        measure.frame = Frame::road;
    if (measure.frame == Frame::trajectory)
        node.unsupported("distances along a trajectory");
    if (node.has("relativeDistanceType")) {
        const std::size_t kind = node.choice("relativeDistanceType", {"euclidianDistance", "longitudinal", "lateral", "cartesianDistance"});
        measure.span = kind == 1 ? Span::longitudinal : kind == 2 ? Span::lateral : Span::straight;
    } else if (along_route) {
        measure.span = Span::longitudinal;
    }
    if (node.has("routingAlgorithm"))
        node.choice("routingAlgorithm", {"undefined", "shortest", "fastest", "leastIntersections", "assignedRoute", "random"});
    return measure;
}

Direction direction_of(const OscNode& node) {
    return node.has("direction") ? static_cast<Direction>(1 + node.choice("direction", {"longitudinal", "lateral", "vertical"}))
                                 : Direction::total;
}

double not_negative(const OscNode& node, const char* attribute) {
    const double value = node.number(attribute);
    if (!(value >= 0.0))
        node.refuse(attribute, fmt::format("found {}", value), "a value not below 0");
    return value;
}

RelativeClearanceCondition clearance_of(const OscNode& node) {
    RelativeClearanceCondition out;
    out.ahead_m = node.number_or("distanceForward", 0.0);
    out.behind_m = node.number_or("distanceBackward", 0.0);
    out.freespace = node.flag_or("freeSpace", false);
    out.opposite = node.flag_or("oppositeLanes", false);
    for (const OscNode& lane : node.children("RelativeLaneRange"))
        out.lanes.push_back({lane.has("from") ? std::optional(lane.whole("from")) : std::nullopt,
                             lane.has("to") ? std::optional(lane.whole("to")) : std::nullopt});
    for (const OscNode& entity : node.children("EntityRef"))
        out.entities.push_back(entity.entity("entityRef"));
    return out;
}

CollisionCondition collision_of(const OscNode& node) {
    if (const auto entity = node.find("EntityRef"))
        return {entity->entity("entityRef"), {}};
    return {{}, node.require("ByType").text("type")};
}

TimeToCollisionCondition ttc_of(const OscNode& node) {
    TimeToCollisionCondition out;
    const OscNode target = node.require("TimeToCollisionConditionTarget");
    if (const auto entity = target.find("EntityRef"))
        out.target = entity->entity("entityRef");
    else
        out.target = read_position(target);
    out.value_s = node.number("value");
    out.rule = rule_of(node);
    out.measure = measure_of(node);
    return out;
}

AngleCondition angle_of(const OscNode& node) {
    AngleCondition out;
    const std::size_t kind = node.choice("angleType", {"heading", "pitch", "roll"});
    out.pitch = kind == 1;
    out.roll = kind == 2;
    out.angle_rad = node.number("angle");
    out.tolerance_rad = node.number_or("angleTolerance", 0.0);
    out.to_lane = node.has("coordinateSystem") && node.choice("coordinateSystem", {"entity", "lane", "road", "trajectory", "world"}) != 4;
    if (node.element() == "RelativeAngleCondition")
        out.relative_to = node.entity("entityRef");
    return out;
}

/// What stands in a table under the element's name makes of it; others are not supported.
template <class Read, class Table> std::optional<Read> read_listed(const OscNode& node, const Table& table) {
    const auto reader = table.find(node.element());
    if (reader != table.end())
        return reader->second(node);
    node.unsupported(fmt::format("the condition {}", printable(node.element())));
    return {};
}

std::optional<EntityCondition> read_entity_condition(const OscNode& node) {
    using C = EntityCondition;
    using Lasting = LastingCondition::State;
    static const std::map<std::string, C (*)(const OscNode&)> known{
        {"EndOfRoadCondition",
         [](const OscNode& n) -> C {
             return LastingCondition{Lasting::end_of_road, n.number("duration")};
         }},
        {"OffroadCondition",
         [](const OscNode& n) -> C {
             return LastingCondition{Lasting::offroad, n.number("duration")};
         }},
        {"StandStillCondition",
         [](const OscNode& n) -> C {
             return LastingCondition{Lasting::standing, n.number("duration")};
         }},
        {"CollisionCondition", [](const OscNode& n) -> C { return collision_of(n); }},
        {"TimeHeadwayCondition",
         [](const OscNode& n) -> C {
             return TimeHeadwayCondition{n.entity("entityRef"), n.number("value"), rule_of(n), measure_of(n)};
         }},
        {"TimeToCollisionCondition", [](const OscNode& n) -> C { return ttc_of(n); }},
        {"AccelerationCondition",
         [](const OscNode& n) -> C {
             return AccelerationCondition{n.number("value"), rule_of(n), direction_of(n)};
         }},
        {"SpeedCondition",
         [](const OscNode& n) -> C {
             return SpeedCondition{n.number("value"), rule_of(n), direction_of(n), {}};
         }},
        {"RelativeSpeedCondition",
         [](const OscNode& n) -> C {
             return SpeedCondition{n.number("value"), rule_of(n), direction_of(n), n.entity("entityRef")};
         }},
        {"TraveledDistanceCondition", [](const OscNode& n) -> C { return TraveledDistanceCondition{not_negative(n, "value")}; }},
        {"ReachPositionCondition",
         [](const OscNode& n) -> C {
             return ReachPositionCondition{read_position(n), not_negative(n, "tolerance")};
         }},
        {"DistanceCondition",
         [](const OscNode& n) -> C {
             return DistanceCondition{read_position(n), n.number("value"), rule_of(n), measure_of(n)};
         }},
        {"RelativeDistanceCondition",
         [](const OscNode& n) -> C {
             return DistanceCondition{n.entity("entityRef"), n.number("value"), rule_of(n), measure_of(n)};
         }},
        {"RelativeClearanceCondition", [](const OscNode& n) -> C { return clearance_of(n); }},
        {"AngleCondition", [](const OscNode& n) -> C { return angle_of(n); }},
        {"RelativeAngleCondition", [](const OscNode& n) -> C { return angle_of(n); }}};
    return read_listed<C>(node, known);
}

std::optional<Condition> read_by_entity(const OscNode& node) {
    ByEntity out;
    const OscNode who = node.require("TriggeringEntities");
    out.all = who.choice(who.has("triggeringEntitiesRule") ? "triggeringEntitiesRule" : "rule", {"any", "all"}) == 1;
    for (const OscNode& entity : who.children("EntityRef"))
        out.entities.push_back(entity.entity("entityRef"));
    if (out.entities.empty())
        who.refuse("", "names no entity", "at least one EntityRef");
    const auto condition = read_entity_condition(node.require("EntityCondition").only("a condition"));
    if (!condition)
        return {};
    out.condition = *condition;
    return out;
}

std::optional<Condition> read_by_value(const OscNode& node) {
    using C = Condition;
    static const std::map<std::string, C (*)(const OscNode&)> known{
        {"SimulationTimeCondition",
         [](const OscNode& n) -> C {
             return SimulationTimeCondition{n.number("value"), rule_of(n)};
         }},
        {"TimeOfDayCondition",
         [](const OscNode& n) -> C {
             return TimeOfDayCondition{n.text("dateTime"), rule_of(n)};
         }},
        {"ParameterCondition",
         [](const OscNode& n) -> C {
             return NamedValueCondition{false, n.text("parameterRef"), n.text("value"), rule_of(n)};
         }},
        {"VariableCondition",
         [](const OscNode& n) -> C {
             return NamedValueCondition{true, n.text("variableRef"), n.text("value"), rule_of(n)};
         }},
        {"TrafficSignalCondition",
         [](const OscNode& n) -> C {
             return TrafficSignalCondition{n.text("name"), n.text("state"), false};
         }},
        {"TrafficSignalControllerCondition",
         [](const OscNode& n) -> C {
             return TrafficSignalCondition{n.text("trafficSignalControllerRef"), n.text("phase"), true};
         }},
        {"StoryboardElementStateCondition", [](const OscNode& n) -> C {
             return ElementStateCondition{n.text("storyboardElementType"), n.text("storyboardElementRef"), n.text("state")};
         }}};
    return read_listed<C>(node, known);
}

std::optional<TimedCondition> read_condition(const OscNode& node) {
    TimedCondition out;
    out.line = node.line();
    out.delay_s = node.has("delay") ? not_negative(node, "delay") : 0.0;
    out.edge = static_cast<Edge>(node.choice("conditionEdge", {"none", "rising", "falling", "risingOrFalling"}));
    const auto by_entity = node.find("ByEntityCondition"), by_value = node.find("ByValueCondition");
    if (!by_entity && !by_value)
        node.refuse("", "is neither by entity nor by value", "ByEntityCondition or ByValueCondition");
    auto condition = by_entity ? read_by_entity(*by_entity) : read_by_value(by_value->only("a condition"));
    if (!condition)
        return {};
    out.condition = std::move(*condition);
    return out;
}

} // namespace

std::optional<Trigger> read_trigger(const OscNode& holder, const char* element) {
    const auto node = holder.find(element);
    if (!node)
        return {};
    if (std::string_view(element) == "StartTrigger" && !node->find("ConditionGroup"))
        return {}; // without conditions nothing is waited for
    Trigger trigger;
    for (const OscNode& group : node->children("ConditionGroup")) {
        std::vector<TimedCondition> conditions;
        bool whole = true; // a group that lost a condition cannot become true
        for (const OscNode& condition : group.children("Condition")) {
            if (auto read = read_condition(condition))
                conditions.push_back(std::move(*read));
            else
                whole = false;
        }
        if (whole && !conditions.empty())
            trigger.groups.push_back(std::move(conditions));
    }
    return trigger;
}

} // namespace fernlicht::osc
