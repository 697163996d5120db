// Shadows in a drive file. Readers throw InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/shadow_settings.h"
#include "scenarios/yaml/yaml_entry.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fernlicht {

/// `shadows`: true, false, a method's name, or a map with `method` and what that method uses; other keys are refused.
ShadowSettings read_shadows(const YamlMap& drive);
/// YAML that is read back to the same.
/// What `read_shadows` reads; keys that the method does not use are left out.
std::string write_shadows(const ShadowSettings& shadows);

/// The keys beside `method` that the method uses, and their values as drives have them: "map_texels", "[1024, 512]".
std::vector<std::pair<std::string_view, std::string>> used_shadow_keys(const ShadowSettings& shadows);

} // namespace fernlicht
