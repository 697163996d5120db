#include "scenarios/lamps/mounted_lamp.h"

#include <cmath>

namespace fernlicht {

double MountedLamp::intensity_factor() const {
    // Luminous flux of a filament goes with the 3.4th power of its voltage near the rated one (law of the lamp makers, within
    // about 10 % of the rated voltage); the ballast of an arc and the driver of a LED keep their current.
    constexpr double flux_exponent = 3.4;
    if (source != SourceKind::filament)
        return level;
    return level * std::pow(voltage_v / reference_voltage_v, flux_exponent);
}

} // namespace fernlicht
