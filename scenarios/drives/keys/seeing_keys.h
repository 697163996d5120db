// `measure`'s keys of seeing and glare: sensors, glare, visibility, homogeneity and places.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

SeeingParameters read_seeing(const YamlMap& measure);
/// The lines below `measure:` that read_seeing reads back to the same; "" where nothing is asked for.
std::string write_seeing(const SeeingParameters& seeing);

} // namespace fernlicht
