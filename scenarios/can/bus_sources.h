// Where a mapping's names lead to in the databases.
#pragma once

#include "scenarios/can/bus_mapping.h"
#include "scenarios/can/bus_units.h"
#include "scenarios/can/can_database.h"

#include <span>

namespace fernlicht {

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
