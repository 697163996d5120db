// Shadows in a drive file. Readers throw InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/shadow_settings.h"
#include "scenarios/drives/yaml_entry.h"

namespace fernlicht {

/// `shadows`: true, false, a method's name, or a map with `method` and what that method uses; other keys are refused.
ShadowSettings read_shadows(const YamlMap& drive);
/// YAML that is read back to the same.
/// What `read_shadows` reads; keys that the method does not use are left out.
std::string write_shadows(const ShadowSettings& shadows);

} // namespace fernlicht
