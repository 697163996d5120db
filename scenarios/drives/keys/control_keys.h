// Lamp control's part of a drive file. Throws InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/keys/lamp_sets.h"

namespace fernlicht {

/// `control` of the variant's keys, else of the drive: the laws that move and dim the variant's lamps. `none`: nothing is controlled. Lamps
/// and signals that are named must be there.
void read_control(const YamlMap& drive, const YamlMap* keys, Variant& variant, LampShelf& shelf);

/// YAML of it, as a block below a variant, that read_control reads back to the same; "" without control.
std::string write_control(const Drive& drive, const Variant& variant);
/// What hashes of it are taken over (fields/field_bits.h).
std::string control_bits(const Drive& drive, const Variant& variant);

} // namespace fernlicht
