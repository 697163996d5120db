// Conditions by entity, at one moment.
#pragma once

#include "scenarios/openscenario/osc_world.h"

namespace fernlicht::osc {

/// Of the entity with this index, which is present. Conditions about others that are not present are false.
bool entity_condition(const EntityCondition& condition, std::size_t entity, const World& world);

} // namespace fernlicht::osc
