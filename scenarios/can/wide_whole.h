// Whole numbers of more than 64 bits: values of signals exactly, where a double would round.
#pragma once

#include "scenarios/can/can_database.h"

#include <optional>
#include <string>

namespace fernlicht {

__extension__ using WideWhole = __int128;

/// A double that is a whole number below 2^62, as a whole number.
std::optional<WideWhole> whole_below_62_bits(double value);
/// raw * factor + offset of a whole signal whose factor and offset are whole and below 2^62.
std::optional<WideWhole> exact_whole(const CanSignal& signal, std::uint64_t raw);
std::string decimal_text(WideWhole value);

} // namespace fernlicht
