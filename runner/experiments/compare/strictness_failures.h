// What a strictness asked for and did not get.
#pragma once

#include "runner/experiments/compare/picture_comparison.h"

namespace fernlicht {

/// A sentence a demand that was not kept: channel, demand, found, limit, margin, and the pixel that is farthest off. Empty where all were.
std::vector<std::string> strictness_failures(const PictureComparison& comparison);

} // namespace fernlicht
