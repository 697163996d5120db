// What of a struct is off its defaults, by the ids of its fields and the bits of their values: what hashes of inputs are taken over. Keys
// may be renamed, and fields added at their defaults, without a word of it changing. Only fields of a kind of their own that have no `bits`
// are told by their text.
#pragma once

#include "scenarios/fields/group.h"

#include <utility>
#include <vector>

namespace fernlicht {

/// A line each, by ascending ids: "17.2=4097700000000000". Unheard fields are left out. "" for a struct at its defaults.
std::string field_bits(const Group& group, const void* whole);
/// The same field by field, with their keys of today; those at their defaults are left out.
std::vector<std::pair<std::string, std::string>> field_bits_by_key(const Group& group, const void* whole);

} // namespace fernlicht
