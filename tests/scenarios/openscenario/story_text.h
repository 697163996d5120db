// Small scenarios on a straight road of our own, for tests.
#pragma once

#include "scenarios/openscenario/play_story.h"
#include "scenarios/openscenario/reader/read_storyboard.h"
#include "tests/trial.h"

#include <gtest/gtest.h>

namespace fernlicht::osc {

inline const std::string straight_road = std::string(FERNLICHT_SOURCE_DIR) + "/scenarios/library/roads/straight.xodr";

inline std::filesystem::path story_file(const std::string& text) { return tests::written("story.xosc", text); }

/// Two cars; `init` inside Actions, `story` inside Storyboard behind Init.
inline std::string scenario_text(const std::string& init, const std::string& story, const std::string& declarations = {}) {
    return R"(<?xml version="1.0"?>
<OpenSCENARIO>
<FileHeader revMajor="1" revMinor="2" date="2024-01-01T00:00:00" description="test" author="fernlicht"/>
<ParameterDeclarations>)" +
           declarations + R"(</ParameterDeclarations>
<CatalogLocations/>
<RoadNetwork><LogicFile filepath=")" +
           straight_road + R"("/></RoadNetwork>
<Entities>
<ScenarioObject name="Ego"><Vehicle name="car" vehicleCategory="car"><BoundingBox><Center x="1.4" y="0" z="0.75"/><Dimensions length="4" width="2" height="1.5"/></BoundingBox></Vehicle></ScenarioObject>
<ScenarioObject name="Other"><Vehicle name="car" vehicleCategory="car"/></ScenarioObject>
</Entities>
<Storyboard><Init><Actions>)" +
           init + R"(</Actions></Init>)" + story + R"(</Storyboard></OpenSCENARIO>)";
}

inline std::string teleport(const std::string& position) {
    return "<PrivateAction><TeleportAction><Position>" + position + "</Position></TeleportAction></PrivateAction>";
}
inline std::string on_lane(int lane, double s) {
    return "<LanePosition roadId=\"1\" laneId=\"" + std::to_string(lane) + "\" s=\"" + std::to_string(s) + "\"/>";
}
inline std::string speed(const std::string& value,
                         const std::string& dynamics = R"(dynamicsShape="step" dynamicsDimension="time" value="0")") {
    return "<PrivateAction><LongitudinalAction><SpeedAction><SpeedActionDynamics " + dynamics +
           "/><SpeedActionTarget><AbsoluteTargetSpeed value=\"" + value +
           "\"/></SpeedActionTarget></SpeedAction></LongitudinalAction></PrivateAction>";
}
inline std::string of(const std::string& entity, const std::string& actions) {
    return "<Private entityRef=\"" + entity + "\">" + actions + "</Private>";
}
inline std::string by_value(const std::string& condition, const std::string& more = R"(delay="0" conditionEdge="none")") {
    return "<ConditionGroup><Condition name=\"c\" " + more + "><ByValueCondition>" + condition +
           "</ByValueCondition></Condition></ConditionGroup>";
}
inline std::string at_time(double value, const std::string& rule = "greaterOrEqual") {
    return by_value("<SimulationTimeCondition value=\"" + std::to_string(value) + "\" rule=\"" + rule + "\"/>");
}
inline std::string event(const std::string& name, const std::string& action, const std::string& trigger, const std::string& more = "") {
    return "<Event name=\"" + name + "\" priority=\"parallel\" " + more + "><Action name=\"a\">" + action + "</Action><StartTrigger>" +
           trigger + "</StartTrigger></Event>";
}
inline std::string story(const std::string& events, const std::string& actor = "Ego") {
    return "<Story name=\"s\"><Act name=\"act\"><ManeuverGroup name=\"g\" maximumExecutionCount=\"1\"><Actors "
           "selectTriggeringEntities=\"false\">"
           "<EntityRef entityRef=\"" +
           actor + "\"/></Actors><Maneuver name=\"m\">" + events + "</Maneuver></ManeuverGroup><StartTrigger>" + at_time(0.0) +
           "</StartTrigger></Act></Story>";
}
inline std::string stop_at(double time) { return "<StopTrigger>" + at_time(time) + "</StopTrigger>"; }

inline PlayedStory play_text(const std::string& text, double max_s = 20.0) {
    const Storyboard storyboard = read_storyboard(story_file(text));
    return play_story(storyboard, read_opendrive(storyboard.road_file), {.step_s = 0.01, .max_s = max_s});
}

} // namespace fernlicht::osc
