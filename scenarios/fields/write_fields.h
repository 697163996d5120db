// Writes a struct as YAML by its description; what is read back is the same to the bit.
#pragma once

#include "scenarios/fields/group.h"

namespace fernlicht {

template <class Struct> struct Fields;

/// "a: 1, b: 2", as it stands between braces.
std::string flow_text(const Group& group, const void* whole);
/// One key a line, at a depth of two spaces each.
std::string block_text(const Group& group, const void* whole, std::size_t depth);
/// The value of one field as it stands behind its key on one line; "" for what is not written.
std::string value_text(const Field& field, const void* whole);

template <class Struct> std::string write_fields(const Fields<Struct>& fields, const Struct& value, std::size_t depth) {
    return block_text(fields, &value, depth);
}

} // namespace fernlicht
