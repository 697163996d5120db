// The reference of a file's keys: a table of each described struct, in Markdown.
#pragma once

#include "scenarios/fields/group.h"

namespace fernlicht {

/// A heading and a table of key, unit, what is allowed, default and meaning; then those of the structs within. `path` is that of the keys:
/// "measure.glare". `usual` is where defaults come from.
std::string key_tables(const std::string& path, const Group& group, const void* usual);

} // namespace fernlicht
