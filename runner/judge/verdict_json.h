// Verdicts and repeats as parts of report.json.
#pragma once

#include "runner/files/described_json.h"
#include "runner/findings/report.h"

namespace fernlicht {

/// `listed` stands only where the list of known failures names the verdict.
JsonMembers verdict_members(Verdict& verdict);
JsonMembers count_members(VerdictCounts& counts);
JsonMembers repeats_members(Repeats& repeats);

inline nlohmann::ordered_json verdicts_json(const std::vector<Verdict>& verdicts) { return as_json(verdicts, verdict_members); }

} // namespace fernlicht
