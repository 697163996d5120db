// Where two YAML documents say different things.
#pragma once

#include "scenarios/yaml/yaml_tree.h"

#include <string>
#include <vector>

namespace fernlicht {

struct YamlChange {
    std::string key;                  ///< the way to it: "lamps.left.file", "views.driver.pitch_deg"
    std::string old_value, new_value; ///< on one line; "" where the document has no such key
};

/// The member of a map, or nullptr: no map, no such key.
const YamlValue* member_of(const YamlValue& map, const std::string& key);
inline const YamlValue* member_of(const YamlValue* map, const std::string& key) { return map ? member_of(*map, key) : nullptr; }

/// Maps are compared member by member, whatever their order; lists of one length item by item; all else as a whole. Appends to `changes`.
void add_changes(const YamlValue* before, const YamlValue* now, const std::string& key, std::vector<YamlChange>& changes);

} // namespace fernlicht
