// From the units that databases write to those of the signal table.
#pragma once

#include "scenarios/can/can_database.h"

#include <string_view>

namespace fernlicht {

struct UnitConversion {
    double factor = 1.0, offset = 0.0; ///< value = physical * factor + offset
    double divisor = 1.0;              ///< by which it is divided then: km/h to m/s as x / 3.6, which rounds as drive files' speeds do

    double to_table(double physical) const { return (physical * factor + offset) / divisor; }
    double to_physical(double value) const { return (value * divisor - offset) / factor; }
};

/// nullopt: units that do not fit, or that are not known. `table_unit` is one of known_signals(); `written` the database's, blanks and
/// degree signs as people write them ("km/h", "kph", "m/s^2", "deg", "°", "deg/s", "%", "lx", "").
std::optional<UnitConversion> conversion_between(std::string_view written, std::string_view table_unit);

/// The unit texts that are known for a unit of the table, for messages: "m/s, km/h, kph, mph".
std::string known_units(std::string_view table_unit);

} // namespace fernlicht
