// Where the bits of a signal lie, and those bits as a number.
// Whole numbers of more than 64 bits: values of signals exactly, where a double would round.
#pragma once

#include "scenarios/can/can_database.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace fernlicht {

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
