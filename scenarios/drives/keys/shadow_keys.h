// Shadows in a drive file. Readers throw InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/shadow_settings.h"
#include "scenarios/yaml/yaml_entry.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fernlicht {

template <class Struct> struct Fields;

/// The keys of the map; those that the method does not use are refused.
const Fields<ShadowSettings>& shadow_fields();
/// `shadows`: true, false, a method's name, or a map with `method` and what that method uses.
void read_shadows(const YamlEntry& given, ShadowSettings& shadows);
std::string shadows_text(const ShadowSettings& shadows); ///< read back to the same
std::string shadows_schema();

/// The keys beside `method` that the method uses, and their values as drives have them: "map_texels", "[1024, 512]".
std::vector<std::pair<std::string_view, std::string>> used_shadow_keys(const ShadowSettings& shadows);

} // namespace fernlicht
