#include "scenarios/drives/tolerance_parameters.h"

#include <array>

namespace fernlicht {

Tolerance usual_tolerance(ToleranceKind kind) {
    static constexpr std::array<double, tolerance_kinds> sigmas{0.1, 0.1, 0.1, 5.0, 10.0, 0.0};
    Tolerance usual;
    usual.sigma = sigmas[static_cast<std::size_t>(kind)];
    return usual;
}

Tolerance tolerance_of(const ToleranceParameters& parameters, ToleranceKind kind) {
    using Parameters = ToleranceParameters;
    static constexpr std::array members{&Parameters::pitch_deg,    &Parameters::yaw_deg,   &Parameters::roll_deg,
                                        &Parameters::flux_percent, &Parameters::height_mm, &Parameters::load_kg};
    return (parameters.*members[static_cast<std::size_t>(kind)]).value_or(usual_tolerance(kind));
}

const char* name_of(ToleranceKind kind) {
    static constexpr std::array<const char*, tolerance_kinds> names{"pitch", "yaw", "roll", "flux", "height", "load"};
    return names[static_cast<std::size_t>(kind)];
}

const char* unit_of(ToleranceKind kind) {
    static constexpr std::array<const char*, tolerance_kinds> units{"deg", "deg", "deg", "%", "mm", "kg"};
    return units[static_cast<std::size_t>(kind)];
}

} // namespace fernlicht
