// Why a cell reads differently from the night before: its inputs, the program, or the machine.
#pragma once

#include "runner/history/history.h"

#include <string>
#include <vector>

namespace fernlicht {

enum class Cause { inputs, program, machine };
Cause cause_of(InputKind kind);
const char* cause_name(Cause cause); ///< "inputs", "program", "machine"

/// "lamp low-beam.ies (1f0c93a2b7d4 → 91bc03e8a5f0)", "sources in renderer", "driver Mesa 22.3.6 → Mesa 25.0.1".
std::string phrase_of(const InputChange& change);
/// "inputs: lamp low-beam.ies (1f0c93a2b7d4 → 91bc03e8a5f0); program: sources in renderer"; where nothing changed, that.
std::string phrase_of(const InputChanges& changes);
/// "inputs", "inputs and program"; "not known" of none.
std::string causes_of(const InputChanges& changes);
bool has_cause(const InputChanges& changes, Cause cause);

/// "CPU", "driver" and so on, as the night's context names it; "" where it does not.
std::string machine_in(const Night& night, const std::string& name);
/// What decides a cell's readings: its own inputs; where they were not kept, what the night's context tells of program and machine.
CellInputs deciding_inputs(const Night& night, const NightCell& cell);
/// The same with what decides over its time alone: CPU and system.
CellInputs timing_inputs(const Night& night, const NightCell& cell);
/// Of one cell in two nights; of program and machine alone where either night did not keep its inputs.
InputChanges changes_between(const Night& earlier, const NightCell& before, const Night& later, const NightCell& now);
/// Within one class readings are the same to the last bit as long as nothing else changes.
std::string device_class_of(const CellInputs& inputs);

} // namespace fernlicht
