// What `fernlicht stability` found, and what is told of it.
#pragma once

#include "runner/experiments/stability/stability_case.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"

namespace fernlicht {

struct StabilityResult : Findings {
    std::vector<StabilityRow> rows;
    std::string device; ///< "" when nothing was drawn
};

/// One case, as soon as it is judged.
Document document(const StabilityRow& row);
/// The table of docs/accuracy.md, and how many passed. No times: the same on every run of one machine.
Document document(const StabilityResult& result);
std::string stability_json(const StabilityResult& result);

} // namespace fernlicht
