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
inline Verdict read_verdict(const CheckedJson& json) { return from_json<Verdict>(json, verdict_members); }
inline nlohmann::ordered_json counts_json(const VerdictCounts& counts) { return as_json(counts, count_members); }
inline nlohmann::ordered_json repeats_json(const Repeats& repeats) { return as_json(repeats, repeats_members); }

/// An entry of the report's `drives`: all results of one drive with one lamp set, no times (report_json.cpp).
nlohmann::ordered_json played_json(const PlayedVariant& played);

} // namespace fernlicht
