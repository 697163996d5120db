// Entities: vehicles, pedestrians and objects, with their boxes and limits.
#pragma once

#include "scenarios/openscenario/osc_node.h"

namespace fernlicht::osc {

/// Reads all entities and makes their names known to the reading. Selections (EntitySelection) come out as name and members.
struct ReadEntities {
    std::vector<Entity> entities;
    std::map<std::string, std::vector<std::string>> selections;
};
ReadEntities read_entities(const OscNode& scenario);

} // namespace fernlicht::osc
