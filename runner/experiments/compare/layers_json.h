// The part of compare.json that pictures and the frames of runs share.
#pragma once

#include "runner/experiments/compare/picture_comparison.h"

#include <nlohmann/json.hpp>

namespace fernlicht {

nlohmann::ordered_json layers_json(const PictureComparison& comparison);

} // namespace fernlicht
