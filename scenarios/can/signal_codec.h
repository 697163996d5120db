// From the bytes of a message to the values of its signals and back.
// Where the bits of a signal lie, and those bits as a number.
// Whole numbers of more than 64 bits: values of signals exactly, where a double would round.
#pragma once

#include "scenarios/can/can_database.h"

#include <cstddef>
#include <map>
#include <optional>
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

/// Place of the signal's first bit, counted so that the signal's bits follow each other: Intel from the least significant bit of byte 0
/// upwards, Motorola from the most significant bit of byte 0 downwards.
inline std::size_t first_bit(const CanSignal& signal) {
    return signal.big_endian ? std::size_t{signal.start_bit} / 8 * 8 + 7 - signal.start_bit % 8U : signal.start_bit;
}

/// Least number of bytes of a frame that holds the whole signal.
inline std::size_t bytes_to_hold(const CanSignal& signal) { return (first_bit(signal) + signal.length + 7) / 8; }

/// All ones in the signal's length, 1 to 64 bits.
inline std::uint64_t all_bits(const CanSignal& signal) { return ~std::uint64_t{0} >> (64U - signal.length); }

/// The signal's bits; `bytes` must hold it (bytes_to_hold).
std::uint64_t read_bits(const CanSignal& signal, std::span<const std::uint8_t> bytes);
/// Puts the lower bits of `raw` there and leaves all others as they are; `bytes` must hold the signal.
void write_bits(const CanSignal& signal, std::uint64_t raw, std::span<std::uint8_t> bytes);

/// Raw value of a whole signal with its sign.
inline std::int64_t signed_raw(const CanSignal& signal, std::uint64_t raw) {
    const unsigned unused = 64U - signal.length;
    return static_cast<std::int64_t>(raw << unused) >> unused;
}

__extension__ using WideWhole = __int128;

/// A double that is a whole number below 2^62, as a whole number.
std::optional<WideWhole> whole_below_62_bits(double value);
/// raw * factor + offset of a whole signal whose factor and offset are whole and below 2^62.
std::optional<WideWhole> exact_whole(const CanSignal& signal, std::uint64_t raw);
std::string decimal_text(WideWhole value);

} // namespace fernlicht
