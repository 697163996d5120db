// Cases of all shadow methods; shadow_cases.cpp has those of the default one.
#pragma once

#include "runner/experiments/stability/stability_case.h"

namespace fernlicht {

std::vector<StabilityCase> shadow_volume_cases();
std::vector<StabilityCase> shadow_map_cases();
std::vector<StabilityCase> shadow_plane_cases();

} // namespace fernlicht
