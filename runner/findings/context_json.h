// What results were made with, as a part of every JSON that holds some.
#pragma once

#include "runner/findings/report.h"

#include <nlohmann/json.hpp>

namespace fernlicht {

/// Of fernlicht, its compiler and its libraries, by name.
nlohmann::ordered_json versions_json(const RunContext& context);
/// Path, size and hash of every file that was opened.
nlohmann::ordered_json inputs_json(const RunContext& context);
/// Command, time, seed, backend and driver, CPU, system, versions and inputs.
nlohmann::ordered_json context_json(const RunContext& context);

} // namespace fernlicht
