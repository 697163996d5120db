// How results were made, which moments they are of and how times spread: the parts that every JSON of results has.
#pragma once

#include "metrics/statistics/statistics.h"
#include "runner/files/described_json.h"
#include "runner/findings/findings.h"

namespace fernlicht {

/// Command, time, seed, backend and driver, CPU, system, versions and inputs.
JsonMembers context_members(RunContext& context);
JsonMembers spread_members(Spread& spread);
/// Path, size and hash of a file that was opened.
JsonMembers file_members(FileRead& file);
/// Tick and time of a moment.
JsonMembers moment_members(std::pair<int, double>& moment);

inline nlohmann::ordered_json context_json(const RunContext& context) { return as_json(context, context_members); }

} // namespace fernlicht
