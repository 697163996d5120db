// From the bytes of a message to the values of its signals and back.
#pragma once

#include "scenarios/can/can_database.h"

#include <map>
#include <span>
#include <string>

namespace fernlicht {

struct CanValue {
    const CanSignal* signal = nullptr;
    std::uint64_t raw = 0;              ///< bits as they stood there, sign not extended
    double physical = 0.0;              ///< with sign, factor and offset; of whole numbers beyond 53 bits the nearest double
    const std::string* label = nullptr; ///< of the raw value, nullptr: none

    bool out_of_limits() const; ///< beyond the signal's limits by more than half a raw step, or not a finite number
};

/// The signals that the bytes hold, in the message's order, those that the multiplexors do not choose left out. A signal that reaches
/// beyond the bytes that came is left out, too: shorter frames than the message are usual.
std::vector<CanValue> decode(const CanMessage& message, std::span<const std::uint8_t> bytes);
/// The same into a list that keeps its memory, for many frames.
void decode_into(const CanMessage& message, std::span<const std::uint8_t> bytes, std::vector<CanValue>& values);

/// One signal of a message; nullopt where it is not there (multiplexor, short frame).
std::optional<CanValue> decode(const CanMessage& message, const CanSignal& signal, std::span<const std::uint8_t> bytes);

/// The value in decimals: whole numbers exactly, all others so that they come back by reading; "nan", "inf", "-inf".
std::string exact_text(const CanValue& value);

/// Bits of the raw value nearest to a physical one (halves away from 0). Throws InputError with the signal's name where its bits cannot
/// hold it; not a number and infinities fit floating-point signals only.
std::uint64_t raw_of(const CanSignal& signal, double physical);

/// Bytes of the message's length with these physical values, by raw_of(). Signals not named take their start value, else 0; a multiplexor
/// not named takes its start value if that lets the named signals be there, else the least value that does.
/// Throws InputError for a name that no signal of the message has, values that a multiplexor does not let be in one frame, a signal beyond
/// the message's length, and signals that overlap and differ.
std::vector<std::uint8_t> encode(const CanMessage& message, const std::map<std::string, double>& physical);

} // namespace fernlicht
