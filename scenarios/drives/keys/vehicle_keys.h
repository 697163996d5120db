// The car's and its actuators' part of a drive file. Readers throw InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

struct Group;
template <class Struct> struct Fields;

const Fields<VehicleParameters>& vehicle_fields();
const Fields<ActuatorParameters>& actuator_fields();
const Fields<LevellingParameters>& levelling_fields();
/// Of a variant: levelling and swivel.
const Group& actuators_fields();

/// `actuators` of the variant's keys, else of the drive: levelling and swivel. Refused in a drive without a vehicle.
void read_actuators(const YamlMap& drive, const YamlMap* keys, Variant& variant);
/// none, static, dynamic, or a map. `own_period`: it may have a control period of its own.
std::optional<LevellingParameters> read_levelling(const YamlEntry& given, bool own_period = true);
std::string levelling_schema();

} // namespace fernlicht
