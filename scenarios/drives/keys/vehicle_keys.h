// The car's and its actuators' part of a drive file. Throws InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

/// `vehicle`: the word single-track, or a map; what it does not give is a middle-class car's. None where the drive has none.
std::optional<VehicleParameters> read_vehicle(const YamlMap& drive);
/// `actuators` of the variant's keys, else of the drive: levelling and swivel. Refused in a drive without a vehicle.
void read_actuators(const YamlMap& drive, const YamlMap* keys, Variant& variant);

/// Keys of an actuator that `keys` has over `actuator`'s figures.
ActuatorParameters read_actuator(const YamlMap& keys, ActuatorParameters actuator);
/// `levelling`: none, static, dynamic, or a map. `own_period`: it may have a control period of its own.
std::optional<LevellingParameters> read_levelling(const YamlMap& keys, bool own_period = true);

} // namespace fernlicht
