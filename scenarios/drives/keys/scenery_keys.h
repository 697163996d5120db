// Models in a drive file.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

template <class Struct> struct Fields;

inline constexpr std::size_t most_models = 10'000;

const Fields<PlacedModel>& body_fields(); ///< a car's body, in its frame
const Fields<PlacedModel>& scenery_fields();
/// A list of models with their places. Each file is read once; what of it is left out goes to the drive's notes. Throws InputError.
void read_scenery(const YamlEntry& given, Drive& drive);

} // namespace fernlicht
