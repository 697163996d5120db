// What editors check a file against: JSON schema, draft 7, of a described struct.
#pragma once

#include "scenarios/fields/group.h"

namespace fernlicht {

std::string schema_of(const Group& group);
/// Without the fields that `whole` does not hear; nullptr: a struct at its defaults.
std::string schema_as_heard(Group group, const void* whole);
/// A form for each word of the first field, with the fields that it makes heard, words with equal fields in one; commas between them.
/// `scratch` is a struct that may be changed.
std::string schemas_by_word(const Group& group, void* scratch);
std::string schema_of(const Field& field); ///< of its value

} // namespace fernlicht
