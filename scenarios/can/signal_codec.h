// From the bytes of a message to the values of its signals and back.
#pragma once

#include "scenarios/can/can_database.h"

#include <map>
#include <span>

namespace fernlicht {

struct CanValue {
    const CanSignal* signal = nullptr;
    std::uint64_t raw = 0;              ///< bits as they stood there, sign not extended
    double physical = 0.0;              ///< with sign, factor and offset; of whole numbers beyond 53 bits the nearest double
    const std::string* label = nullptr; ///< of the raw value, nullptr: none

    bool out_of_limits() const; ///< beyond the signal's limits, or not a number
};

/// The signals that the bytes hold, in the message's order, those that the multiplexors do not choose left out. A signal that reaches
/// beyond the bytes that came is left out, too: shorter frames than the message are usual.
std::vector<CanValue> decode(const CanMessage& message, std::span<const std::uint8_t> bytes);

/// One signal of a message; nullopt where it is not there (multiplexor, short frame).
std::optional<CanValue> decode(const CanMessage& message, const CanSignal& signal, std::span<const std::uint8_t> bytes);

/// Bytes of the message's length with these physical values; signals not named take their start value, else 0; a value is rounded to the
/// nearest raw one. Throws InputError for a name that no signal of the message has and a value that its bits cannot hold, and names the
/// signal.
std::vector<std::uint8_t> encode(const CanMessage& message, const std::map<std::string, double>& physical);

} // namespace fernlicht
