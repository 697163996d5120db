// Lamps of others where they are hardest.
#pragma once

#include "runner/experiments/stability/stability_case.h"

namespace fernlicht {

std::vector<StabilityCase> traffic_cases();

} // namespace fernlicht
