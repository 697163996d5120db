#include "scenarios/lamps/mounted_lamp.h"

#include <cmath>

namespace fernlicht {

Turn turn_of(const glm::dmat3& axes) {
    constexpr double least = 1e-9;
    const glm::dvec3 &forward = axes[0], &left = axes[1], &up = axes[2];
    const double level = std::hypot(forward.x, forward.y);
    const auto angle = [](double sine, double cosine) {
        const double rad = std::atan2(sine, cosine);
        return std::abs(rad) < least ? 0.0 : rad;
    };
    if (level < least)
        return {0.0, angle(forward.z, level), angle(-up.y, left.y)};
    return {angle(forward.y, forward.x), angle(forward.z, level), angle(left.z, up.z)};
}

double filament_flux_factor(double voltage_v, double reference_v) {
    constexpr double flux_exponent = 3.4;
    return std::pow(voltage_v / reference_v, flux_exponent);
}

double MountedLamp::intensity_factor() const {
    // The ballast of an arc and the driver of a LED keep their current.
    if (source != SourceKind::filament)
        return level * flux_factor;
    return level * flux_factor * filament_flux_factor(voltage_v, reference_voltage_v.value_or(un_voltage_v));
}

void apply(const LampChange& change, MountedLamp& lamp) {
    lamp.level = change.level.value_or(lamp.level);
    lamp.pitch_rad = change.pitch_rad.value_or(lamp.pitch_rad);
    lamp.yaw_rad = change.yaw_rad.value_or(lamp.yaw_rad);
    lamp.roll_rad = change.roll_rad.value_or(lamp.roll_rad);
    lamp.file = change.file ? change.file : lamp.file;
    lamp.colour = change.colour.value_or(lamp.colour);
    lamp.source = change.source.value_or(lamp.source);
    lamp.aligned = change.aligned.value_or(lamp.aligned);
}

} // namespace fernlicht
