// The table of cases as text, Markdown and JSON.
#pragma once

#include "runner/experiments/stability/stability_case.h"
#include "runner/findings/document.h"

namespace fernlicht {

/// For a terminal: a block a case.
std::string stability_text(const StabilityRow& row);
/// "51 cases: 50 pass, 1 not_measured (road/x: reason)".
std::string stability_summary(const std::vector<StabilityRow>& rows);
/// One table, as in docs/accuracy.md. No times: the same on every run of one machine.
Table stability_table(const std::vector<StabilityRow>& rows);
/// `device`: "" when nothing was drawn.
std::string stability_json(const std::vector<StabilityRow>& rows, const std::string& device);

} // namespace fernlicht
