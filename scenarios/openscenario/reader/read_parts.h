// The parts of a storyboard, each from its element.
#pragma once

#include "scenarios/openscenario/osc_node.h"

namespace fernlicht::osc {

/// From PrivateAction or GlobalAction. nullopt: not supported, which the reading notes. Throws InputError.
std::optional<PrivateAction> read_private_action(const OscNode& node);
std::optional<GlobalAction> read_global_action(const OscNode& node);
SpeedLimits read_limits(const OscNode& node);

/// Reads all entities and makes their names known to the reading. Selections (EntitySelection) come out as name and members.
struct ReadEntities {
    std::vector<Entity> entities;
    std::map<std::string, std::vector<std::string>> selections;
};
ReadEntities read_entities(const OscNode& scenario);

Environment read_environment(const OscNode& node);

/// From an element that holds a Position (its child of that name), or from the Position itself. Throws InputError.
Position read_position(const OscNode& node);
/// From an element that holds a Route or Trajectory, or a CatalogReference to one. Throw InputError.
std::shared_ptr<const Route> read_route(const OscNode& holder);
std::shared_ptr<const Trajectory> read_trajectory(const OscNode& holder);

/// nullopt when `element` ("StartTrigger", "StopTrigger") is not there. One without groups is there and never true. Throws InputError.
std::optional<Trigger> read_trigger(const OscNode& holder, const char* element);

} // namespace fernlicht::osc
