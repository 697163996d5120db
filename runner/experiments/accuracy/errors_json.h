// Errors of pixels as JSON, the same in every file that holds them.
#pragma once

#include "metrics/images/pixel_errors.h"
#include "runner/findings/reach_error.h"

#include <nlohmann/json.hpp>

namespace fernlicht {

/// `frames`: the tick of each picture. Without pixels: why not.
nlohmann::ordered_json errors_json(const std::optional<PixelErrors>& errors, const std::string& why_not, const std::vector<int>& frames);
nlohmann::ordered_json reach_json(const std::vector<ReachError>& reach);

} // namespace fernlicht
