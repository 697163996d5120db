// A folder of `fernlicht reference`: one picture by rays, each pixel with its variance.
#pragma once

#include "runner/judge/baseline.h"

namespace fernlicht {

/// Whether the folder holds one, and no run.
bool is_reference_folder(const std::filesystem::path& folder);

/// Its technique is "reference-" and the integrator; its device class is Embree's. Seed, samples and the error asked for are no inputs:
/// two pictures of the same light may differ in them. Throws InputError for one that is not whole or damaged.
Baseline read_ray_folder(const std::filesystem::path& folder);

} // namespace fernlicht
