// The part of a drive file that ties lamp control to a bus. Throws InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

struct BusMapping;
struct SignalKind;
template <class Struct> struct Fields;

const Fields<BusMapping>& can_fields();

/// `can`, with what `edits` say of its recording, after read_lamp_sets(): lamps and signals that are named must be there in all of them.
/// Lamp sets without control get one that has no laws, so that switches and commands from the bus reach their lamps.
void read_can(const YamlMap& keys, const DriveEdits& edits, Drive& drive);

/// Whether a bus may give it: all but the laws' own signals and what follows from others. Commands, levels and measured angles of lamps
/// may.
bool may_come_from_bus(const SignalKind& kind);

/// A stamp as candump writes it, "1436509052.249713", in ns; nullopt for anything else.
std::optional<std::int64_t> stamp_from_text(const std::string& text);

} // namespace fernlicht
