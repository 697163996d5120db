#include "scenarios/openscenario/reader/read_parts.h"

#include "scenarios/values/errors.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht::osc {
namespace {

Shape shape_of(const OscNode& node) { return static_cast<Shape>(node.choice("dynamicsShape", {"linear", "cubic", "sinusoidal", "step"})); }

Dynamics dynamics_of(const OscNode& node) {
    Dynamics out;
    out.shape = shape_of(node);
    out.dimension = static_cast<Dimension>(node.choice("dynamicsDimension", {"rate", "time", "distance"}));
    const double value = node.number_or("value", 0.0);
    if (!std::isfinite(value))
        node.refuse("value", fmt::format("found {}", value), "a finite value");
    if (value < 0.0 && out.dimension != Dimension::rate)
        node.refuse("value", fmt::format("found {}", value),
                    out.dimension == Dimension::time ? "a time not below 0" : "a distance not below 0");
    if (value < 0.0) // a rate's sign follows from start and target
        node.note(fmt::format("the rate {} in value is taken as {}: start and target say which way", value, -value));
    out.value = std::abs(value);
    if (out.dimension == Dimension::rate && out.value == 0.0 && out.shape != Shape::step)
        node.refuse("value", "found 0", "a rate above 0");
    return out;
}

SpeedAction speed_of(const OscNode& node) {
    SpeedAction out;
    out.dynamics = dynamics_of(node.require("SpeedActionDynamics"));
    const OscNode target = node.require("SpeedActionTarget");
    if (const auto absolute = target.find("AbsoluteTargetSpeed")) {
        out.target = absolute->number("value");
    } else {
        const OscNode relative = target.require("RelativeTargetSpeed");
        RelativeSpeed speed;
        speed.entity = relative.entity("entityRef");
        speed.value = relative.number("value");
        speed.factor = relative.choice("speedTargetValueType", {"delta", "factor"}) == 1;
        speed.continuous = relative.flag_or("continuous", false);
        out.target = speed;
    }
    return out;
}

SpeedProfileAction profile_of(const OscNode& node) {
    SpeedProfileAction out;
    out.relative_to = node.text_or("entityRef", "");
    if (const auto limits = node.find("DynamicConstraints"))
        out.limits = read_limits(*limits);
    for (const OscNode& entry : node.children("SpeedProfileEntry"))
        out.entries.push_back({entry.not_below_0_if("time", "a time not below 0"), entry.number("speed")});
    if (out.entries.empty())
        node.refuse("", "has no entry", "at least one SpeedProfileEntry");
    return out;
}

LongitudinalDistanceAction distance_of(const OscNode& node) {
    LongitudinalDistanceAction out;
    out.entity = node.entity("entityRef");
    out.distance_m = node.not_below_0_if("distance", "a distance not below 0");
    out.time_gap_s = node.not_below_0_if("timeGap", "a time not below 0");
    if (out.distance_m.has_value() == out.time_gap_s.has_value())
        node.refuse("", "has not exactly one of distance and timeGap", "one of the two");
    out.freespace = node.flag_or("freespace", false);
    out.continuous = node.flag_or("continuous", false);
    if (node.has("displacement")) {
        const std::size_t side = node.choice("displacement", {"trailingReferencedEntity", "leadingReferencedEntity", "any"});
        out.ahead = side == 1;
        out.any_side = side == 2;
    }
    if (const auto limits = node.find("DynamicConstraints"))
        out.limits = read_limits(*limits);
    return out;
}

LaneChangeAction lane_change_of(const OscNode& node) {
    LaneChangeAction out;
    out.dynamics = dynamics_of(node.require("LaneChangeActionDynamics"));
    out.target_offset_m = node.length_or_0("targetLaneOffset");
    const OscNode target = node.require("LaneChangeTarget");
    if (const auto absolute = target.find("AbsoluteTargetLane")) {
        out.target = absolute->whole("value");
    } else {
        const OscNode relative = target.require("RelativeTargetLane");
        out.target = RelativeLane{relative.entity("entityRef"), relative.whole("value")};
    }
    return out;
}

LaneOffsetAction lane_offset_of(const OscNode& node) {
    LaneOffsetAction out;
    out.continuous = node.flag_or("continuous", false);
    const OscNode dynamics = node.require("LaneOffsetActionDynamics");
    out.shape = shape_of(dynamics);
    out.max_lateral_acceleration = dynamics.not_below_0_if("maxLateralAcc", "an acceleration not below 0");
    const OscNode target = node.require("LaneOffsetTarget");
    if (const auto absolute = target.find("AbsoluteTargetLaneOffset")) {
        out.target = absolute->length("value");
    } else {
        const OscNode relative = target.require("RelativeTargetLaneOffset");
        out.target = RelativeOffset{relative.entity("entityRef"), relative.length("value")};
    }
    return out;
}

LateralDistanceAction lateral_distance_of(const OscNode& node) {
    LateralDistanceAction out;
    out.entity = node.entity("entityRef");
    out.distance_m = node.not_below_0_if("distance", "a distance not below 0").value_or(0.0);
    out.freespace = node.flag_or("freespace", false);
    out.continuous = node.flag_or("continuous", false);
    if (const auto limits = node.find("DynamicConstraints"))
        out.max_speed_mps = limits->not_below_0_if("maxSpeed", "a speed not below 0");
    return out;
}

FollowTrajectoryAction follow_of(const OscNode& node) {
    FollowTrajectoryAction out;
    const auto holder = node.find("TrajectoryRef");
    out.trajectory = read_trajectory(holder ? *holder : node);
    out.initial_offset_m = node.number_or("initialDistanceOffset", 0.0);
    if (const auto timing = node.require("TimeReference").find("Timing")) {
        out.timed = true;
        out.time_absolute = timing->choice("domainAbsoluteRelative", {"absolute", "relative"}) == 0;
        out.time_scale = timing->number("scale");
        out.time_offset_s = timing->number("offset");
        if (!(out.time_scale > 0.0))
            timing->refuse("scale", fmt::format("found {}", out.time_scale), "a factor above 0");
    }
    return out;
}

SynchronizeAction synchronize_of(const OscNode& node) {
    SynchronizeAction out;
    out.master = node.entity("masterEntityRef");
    out.master_target = read_position(node.find("TargetPositionMaster").value_or(node));
    out.target = read_position(node.require("TargetPosition"));
    out.master_tolerance_m = node.number_or("targetToleranceMaster", 0.0);
    out.tolerance_m = node.number_or("targetTolerance", 0.0);
    if (const auto final_speed = node.find("FinalSpeed")) {
        const OscNode given = final_speed->only("AbsoluteSpeed or RelativeSpeedToMaster");
        FinalSpeed speed;
        speed.relative = given.element() == "RelativeSpeedToMaster";
        speed.value = given.number("value");
        if (const auto steady = given.find("TargetDistanceSteadyState"))
            speed.steady_distance_m = steady->number("distance");
        if (const auto steady = given.find("TargetTimeSteadyState"))
            speed.steady_time_s = steady->number("time");
        out.final_speed = speed;
    }
    return out;
}

LightStateAction light_of(const OscNode& node) {
    LightStateAction out;
    out.transition_s = node.not_below_0_if("transitionTime", "a time not below 0").value_or(0.0);
    const OscNode type = node.require("LightType").only("VehicleLight or UserDefinedLight");
    if (type.element() == "VehicleLight") {
        static const std::initializer_list<std::string_view> known = {
            "brakeLights",     "daytimeRunningLights", "fogLights",      "fogLightsFront",           "fogLightsRear",
            "highBeam",        "indicatorLeft",        "indicatorRight", "licensePlateIllumination", "lowBeam",
            "reversingLights", "specialPurposeLights", "warningLights"};
        out.light = known.begin()[type.choice("vehicleLightType", known)];
    } else {
        out.light = type.text("userDefinedLightType");
    }
    const OscNode state = node.require("LightState");
    out.mode = static_cast<LightMode>(state.choice("mode", {"off", "on", "flashing"}));
    out.flash_on_s = state.number_or("flashingOnDuration", 0.5);
    if (!(out.flash_on_s > 0.0))
        state.refuse("flashingOnDuration", fmt::format("found {}", out.flash_on_s), "a time above 0");
    out.flash_off_s = state.not_below_0_if("flashingOffDuration", "a time not below 0").value_or(0.5);
    if (constexpr double shortest_s = 0.01; out.mode == LightMode::flashing && out.flash_on_s + out.flash_off_s < shortest_s)
        state.refuse("flashingOnDuration", fmt::format("found a light that flashes every {} s", out.flash_on_s + out.flash_off_s),
                     fmt::format("{} s at least: faster, it is seen as steady light", shortest_s));
    state.not_below_0_if("luminousIntensity", "candela not below 0");
    if (const auto colour = state.find("Color"))
        if (const auto rgb = colour->find("ColorRgb"))
            for (const char* channel : {"red", "green", "blue"})
                rgb->number(channel);
    return out;
}

ControllerAction controller_of(const OscNode& node) {
    std::string what = node.element();
    if (const auto inner = node.children(); node.element() == "ControllerAction" && !inner.empty()) {
        what.clear();
        for (const OscNode& part : inner)
            what += (what.empty() ? "" : ", ") + part.element();
    }
    node.note(fmt::format("controllers are not run: {} changes nothing, the entity goes on as the storyboard moves it", what));
    return {};
}

SetValueAction set_value_of(const OscNode& node, bool variable) {
    SetValueAction out;
    out.variable = variable;
    out.name = node.text(variable ? "variableRef" : "parameterRef");
    const OscNode how = node.only("SetAction or ModifyAction");
    if (how.element() == "SetAction" || how.element() == "SetParameterAction") {
        out.value = how.text("value");
        return out;
    }
    const OscNode rule = how.require("Rule").only("AddValue or MultiplyByValue");
    out.how = rule.element() == "AddValue" ? SetValueAction::How::add : SetValueAction::How::multiply;
    out.value = fmt::format("{}", rule.number("value"));
    return out;
}

} // namespace

SpeedLimits read_limits(const OscNode& node) {
    SpeedLimits out;
    out.speed_mps = node.number_if("maxSpeed");
    out.acceleration = node.number_if("maxAcceleration");
    out.deceleration = node.number_if("maxDeceleration");
    for (std::optional<double>* limit : {&out.speed_mps, &out.acceleration, &out.deceleration}) {
        if (*limit && !(**limit >= 0.0))
            node.refuse("", fmt::format("found a limit of {}", **limit), "limits not below 0");
        if (*limit && !std::isfinite(**limit))
            limit->reset();
    }
    return out;
}

std::optional<PrivateAction> read_private_action(const OscNode& node) {
    using A = PrivateAction;
    static const std::map<std::string, A (*)(const OscNode&)> known{
        {"LongitudinalAction/SpeedAction", [](const OscNode& n) -> A { return speed_of(n); }},
        {"LongitudinalAction/SpeedProfileAction", [](const OscNode& n) -> A { return profile_of(n); }},
        {"LongitudinalAction/LongitudinalDistanceAction", [](const OscNode& n) -> A { return distance_of(n); }},
        {"LateralAction/LaneChangeAction", [](const OscNode& n) -> A { return lane_change_of(n); }},
        {"LateralAction/LaneOffsetAction", [](const OscNode& n) -> A { return lane_offset_of(n); }},
        {"LateralAction/LateralDistanceAction", [](const OscNode& n) -> A { return lateral_distance_of(n); }},
        {"RoutingAction/AssignRouteAction", [](const OscNode& n) -> A { return AssignRouteAction{read_route(n)}; }},
        {"RoutingAction/AcquirePositionAction", [](const OscNode& n) -> A { return AcquirePositionAction{read_position(n)}; }},
        {"RoutingAction/FollowTrajectoryAction", [](const OscNode& n) -> A { return follow_of(n); }},
        {"AppearanceAction/LightStateAction", [](const OscNode& n) -> A { return light_of(n); }},
        {"TeleportAction", [](const OscNode& n) -> A { return TeleportAction{read_position(n)}; }},
        {"VisibilityAction", [](const OscNode& n) -> A { return VisibilityAction{n.flag_or("graphics", true)}; }},
        {"SynchronizeAction", [](const OscNode& n) -> A { return synchronize_of(n); }},
        {"ControllerAction", [](const OscNode& n) -> A { return controller_of(n); }},
        {"ActivateControllerAction", [](const OscNode& n) -> A { return controller_of(n); }},
        {"AssignControllerAction", [](const OscNode& n) -> A { return controller_of(n); }},
        {"OverrideControllerValueAction", [](const OscNode& n) -> A { return controller_of(n); }}};
    OscNode kind = node.only("an action");
    std::string name = kind.element();
    if (name == "LongitudinalAction" || name == "LateralAction" || name == "RoutingAction" || name == "AppearanceAction") {
        kind = kind.only("an action");
        name += '/' + kind.element();
    }
    if (const auto reader = known.find(name); reader != known.end())
        return reader->second(kind);
    kind.unsupported(fmt::format("the action {}", printable(kind.element())));
    return {};
}

std::optional<GlobalAction> read_global_action(const OscNode& node) {
    const OscNode kind = node.only("an action");
    const std::string name = kind.element();
    if (name == "EnvironmentAction") {
        if (const auto environment = own_or_catalog(kind, "Environment"))
            return EnvironmentAction{read_environment(*environment)};
        kind.refuse("", "has no environment", "an Environment or a CatalogReference");
    }
    if (name == "EntityAction") {
        EntityAction out{kind.entity("entityRef"), {}};
        if (const auto add = kind.find("AddEntityAction"))
            out.add_at = read_position(*add);
        else
            kind.require("DeleteEntityAction");
        return out;
    }
    if (name == "ParameterAction")
        return set_value_of(kind, false);
    if (name == "VariableAction")
        return set_value_of(kind, true);
    if (name == "InfrastructureAction") {
        const OscNode signal = kind.require("TrafficSignalAction").only("an action");
        if (signal.element() == "TrafficSignalStateAction")
            return TrafficSignalAction{signal.text("name"), signal.text("state"), false};
        if (signal.element() == "TrafficSignalControllerAction")
            return TrafficSignalAction{signal.text("trafficSignalControllerRef"), signal.text("phase"), true};
        signal.unsupported(fmt::format("the action {}", printable(signal.element())));
        return {};
    }
    kind.unsupported(fmt::format("the action {}", printable(name)));
    return {};
}

} // namespace fernlicht::osc
