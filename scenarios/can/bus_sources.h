// What a mapping's names refer to in the databases.
// From the units that databases write to those of the signal table.
#pragma once

#include "scenarios/can/bus_mapping.h"
#include "scenarios/can/can_database.h"

#include <span>
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

struct FoundSource {
    const CanMessage* message = nullptr;
    const CanSignal* signal = nullptr;
};

/// Throws InputError at `where` for a message or signal that none of them has, with the nearest name, and for one that two have.
FoundSource find_source(const std::vector<CanDatabase>& databases, const BusSource& source, const InputError::Where& where);

/// Labels and digits of a mapping's `values` as the signal's physical values. Throws InputError for a text that is neither.
std::vector<std::pair<double, double>> resolve_values(const std::vector<std::pair<std::string, double>>& values, const CanSignal& signal,
                                                      const InputError::Where& where);

/// By the mapping's factor or offset, else by the units of both. Throws InputError where they do not fit.
UnitConversion resolve_units(const std::optional<double>& factor, const std::optional<double>& offset, const CanSignal& signal,
                             std::string_view table_unit, const InputError::Where& where);

/// Physical values that a signal can carry: its limits where it has some, within its bits. Of 64-bit signals the doubles inside.
std::pair<double, double> physical_range(const CanSignal& signal);

} // namespace fernlicht
