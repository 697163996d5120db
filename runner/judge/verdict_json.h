// Verdicts and repeats as parts of report.json.
#pragma once

#include "runner/files/checked_json.h"
#include "runner/findings/report.h"

#include <nlohmann/json.hpp>

namespace fernlicht {

/// `listed` stands only where the list of known failures names the verdict.
nlohmann::ordered_json verdicts_json(const std::vector<Verdict>& verdicts);
/// Back again. Throws InputError for what is none.
Verdict read_verdict(const CheckedJson& json);
nlohmann::ordered_json counts_json(const VerdictCounts& counts);
nlohmann::ordered_json repeats_json(const Repeats& repeats);

/// An entry of the report's `drives`: all results of one drive with one lamp set, no times (report_json.cpp).
nlohmann::ordered_json played_json(const PlayedVariant& played);

} // namespace fernlicht
