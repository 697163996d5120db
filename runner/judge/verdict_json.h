// Verdicts and repeats as parts of reports' JSON.
#pragma once

#include "runner/files/described_json.h"
#include "runner/findings/report.h"

namespace fernlicht {

JsonPart verdict_kind_part(VerdictKind& kind); ///< by name
/// `listed` stands only where the list of known failures names the verdict.
JsonMembers verdict_members(Verdict& verdict);
JsonMembers count_members(VerdictCounts& counts);
JsonMembers repeats_members(Repeats& repeats);

} // namespace fernlicht
