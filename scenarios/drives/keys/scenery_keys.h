// Models in a drive file.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

/// `scenery`: a list of models with their places. Each file is read once; what of it is left out goes to the drive's notes. Throws
/// InputError.
void read_scenery(const YamlMap& keys, Drive& drive);

} // namespace fernlicht
