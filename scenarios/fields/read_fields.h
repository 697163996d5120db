// Reads a struct from YAML by its description. Refusals are those of yaml_entry.h.
#pragma once

#include "scenarios/fields/group.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

template <class Struct> struct Fields;

/// The fields that `keys` gives; the others stay.
void read_group(const Group& group, const YamlMap& keys, void* whole);
/// A map with the group's keys and no others.
void read_group(const Group& group, const YamlEntry& entry, void* whole);
/// A field's value, whatever its key.
void read_value(const Field& field, const YamlEntry& entry, void* whole);
/// One field of it, where `keys`, which may know others, gives it.
void read_field(const Group& group, std::string_view key, const YamlMap& keys, void* whole);

template <class Struct> Struct read_fields(const Fields<Struct>& fields, const YamlEntry& entry, Struct value = {}) {
    read_group(fields, entry, &value);
    return value;
}

} // namespace fernlicht
