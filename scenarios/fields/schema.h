// What editors check a file against: JSON schema, draft 7, of a described struct.
#pragma once

#include "scenarios/fields/group.h"

namespace fernlicht {

std::string schema_of(const Group& group);
std::string schema_of(const Field& field); ///< of its value

} // namespace fernlicht
