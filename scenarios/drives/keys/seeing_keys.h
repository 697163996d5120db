// `measure`'s keys of seeing and glare: sensors, glare, visibility, homogeneity and places.
#pragma once

#include "scenarios/drives/seeing_parameters.h"

namespace fernlicht {

template <class Struct> struct Fields;

class YamlEntry;

const Fields<SeeingParameters>& seeing_fields();
SeeingParameters read_seeing(const YamlEntry& measure);

} // namespace fernlicht
