#include "metrics/readings/left_open.h"

#include "metrics/readings/significance.h"

#include <cmath>
#include <initializer_list>
#include <string_view>

namespace fernlicht {
namespace {

/// Calculated from the lamps' tables in double precision, on places and by definitions that leave no choice.
constexpr double double_precision = 1e-6;
/// The own lane's grid of evenness (docs/seeing.md): patches begin and end at its points.
constexpr double evenness_step_m = 0.5;

/// Without its unit: "probe_kerb" of "probe_kerb_lx".
std::string without_unit(const Reading& reading) {
    const std::string end = "_" + name_part(reading.unit);
    return reading.name.ends_with(end) ? reading.name.substr(0, reading.name.size() - end.size()) : reading.name;
}

bool begins_with(const std::string& name, std::initializer_list<std::string_view> stems) {
    for (const std::string_view stem : stems)
        if (name.starts_with(stem))
            return true;
    return false;
}

/// Reach on a lane's centre or edges, length without light: the grid's error there and the difference between drawing and double precision.
std::optional<double> of_reach(const PlayedReadings& played, const std::string& name) {
    const std::string unlit = "unlit_before_";
    const std::string subject = extent_subject(name.starts_with(unlit) ? name.substr(unlit.size()) : name);
    const auto centre = value_of(played, subject + "_grid_error_m"), twin = value_of(played, subject + "_twin_difference_m");
    auto grid = centre;
    if (name.starts_with(unlit))
        grid = value_of(played, unlit + subject + "_grid_error_m");
    else if (name.find("_left_edge", subject.size()) != std::string::npos || name.find("_right_edge", subject.size()) != std::string::npos)
        grid = value_of(played, subject + "_edge_grid_error_m");
    grid = grid ? grid : centre;
    return grid && twin ? std::optional(*grid + *twin) : std::nullopt;
}

/// Lengths and times of glare begin and end between two moments: half their distance at either end.
std::optional<double> between_moments(const PlayedReadings& played, const Reading& reading) {
    const double step = reading.unit == "m" ? played.step_m : played.step_s;
    return step > 0.0 ? std::optional(step) : std::nullopt;
}

} // namespace

std::string extent_subject(const std::string& name) {
    std::size_t at = std::string::npos;
    for (const std::string_view plane : {"lx_road_", "lx_target_"})
        if (const std::size_t found = name.find(plane); found != std::string::npos)
            at = found + plane.size();
    if (at == std::string::npos)
        return {};
    for (const std::string_view lane : {"own", "all"})
        if (name.compare(at, lane.size(), lane) == 0)
            return name.substr(0, at + lane.size());
    for (const std::string_view side : {"left_", "right_"})
        if (name.compare(at, side.size(), side) == 0)
            return name.substr(0, name.find_first_not_of("0123456789", at + side.size()));
    return {};
}

std::optional<double> left_open(const PlayedReadings& played, const Reading& reading) {
    const std::string& name = reading.name;
    if (!reading.value.measured())
        return std::nullopt;
    const double size = std::abs(*reading.value.figure());
    if (const auto stated = value_of(played, without_unit(reading) + "_standard_error_" + name_part(reading.unit)))
        return stated;
    if (begins_with(name, {"reach_", "unlit_before_reach_"}))
        return of_reach(played, name);
    if (name.starts_with("area_"))
        return value_of(played, extent_subject(name) + "_grid_error_m2");
    if (name.starts_with("width_"))
        return 2.0 * played.grid_cell_m / 4.0; // either edge to a column of the grid
    if (name.starts_with("probe_")) {
        const auto twin = value_of(played, without_unit(reading) + "_twin_lx");
        return twin ? std::optional(std::abs(*twin - *reading.value.figure())) : std::nullopt;
    }
    if (name.starts_with("glare_") && (reading.unit == "m" || reading.unit == "s"))
        return between_moments(played, reading);
    if (name.starts_with("sensor_") && reading.unit == "m") // between moments illuminance is interpolated
        return between_moments(played, reading);
    if (begins_with(name, {"detection_", "undetected_before_"}) && played.look_step_m > 0.0) // the next place is a step farther
        return name.starts_with("detection_") ? played.look_step_m : 2.0 * played.look_step_m;
    if (name.starts_with("patch_"))
        return 2.0 * evenness_step_m;
    if (begins_with(name, {"glare_", "sensor_", "mirror_", "board_", "kerb_", "marking_", "visibility_level_", "background_luminance_",
                           "mesopic_luminance_", "gradient_", "foreground_ratio_"}))
        return double_precision * size;
    return std::nullopt;
}

} // namespace fernlicht
