// CSV of what a luxmeter read in a light tunnel or on a track, one line a reading (docs/fit.md).
#pragma once

#include "scenarios/values/files.h"

#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <utility>

namespace fernlicht {

/// A line of the file, in the frame of the car as it stands on its wheels.
struct LuxReading {
    std::size_t line = 0;
    std::string name;                                  ///< "" without one
    double time_s = 0.0;                               ///< in the drive
    double ahead_m = 0.0, left_m = 0.0, above_m = 0.0; ///< of the front bumper, of the car's middle, of the road under its wheels
    std::string facing; ///< "lamp", "car", "up", or a direction: "normal 0 0 1", ahead, left and up, of length 1
    std::string lamps;  ///< "left+right"; "": all that shine then
    double lux = 0.0, uncertainty_percent = 0.0, uncertainty_lx = 0.0, place_uncertainty_m = 0.0; ///< standard uncertainties
};

/// Names of the columns and what they hold. One that is not there takes its default.
const std::vector<std::pair<std::string_view, std::string_view>>& lux_point_columns();

/// Unit, in axes ahead, left and up; nullopt for "lamp".
std::optional<glm::dvec3> normal_of(const LuxReading& reading);
/// The names in `lamps`.
std::vector<std::string> lamps_named(const LuxReading& reading);

/// Throws InputError with file, line and column: for an unknown, missing or repeated column, what is no number or out of range, a reading
/// without uncertainty, more than 20 000 readings or none.
std::vector<LuxReading> read_lux_points(const std::filesystem::path& path, FilesRead& opened);

} // namespace fernlicht
