#include "scenarios/can/signal_codec.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

// A signal of 64 bits that does not begin at a byte's border lies in 9 bytes; the ninth is taken apart.
std::uint64_t read_bits(const CanSignal& signal, std::span<const std::uint8_t> bytes) {
    const std::size_t first = first_bit(signal), last = first + signal.length - 1;
    const std::size_t begin = first / 8, end = last / 8;
    std::uint64_t value = 0;
    if (signal.big_endian) {
        const unsigned below = 7 - last % 8;
        const std::size_t from = end - begin > 7 ? end - 7 : begin;
        for (std::size_t i = from; i <= end; ++i)
            value = value << 8 | bytes[i];
        value >>= below;
        if (from > begin)
            value |= std::uint64_t{bytes[begin]} << (64 - below);
    } else {
        const unsigned below = first % 8;
        const std::size_t to = std::min(end, begin + 7);
        for (std::size_t i = to + 1; i-- > begin;)
            value = value << 8 | bytes[i];
        value >>= below;
        if (to < end)
            value |= std::uint64_t{bytes[end]} << (64 - below);
    }
    return value & all_bits(signal);
}

void write_bits(const CanSignal& signal, std::uint64_t raw, std::span<std::uint8_t> bytes) {
    const std::size_t first = first_bit(signal);
    for (std::size_t k = 0; k < signal.length; ++k) {
        const std::size_t bit = first + k;
        const unsigned shift = signal.big_endian ? 7 - bit % 8 : bit % 8;
        const std::uint64_t one = raw >> (signal.big_endian ? signal.length - 1 - k : k) & 1U;
        std::uint8_t& byte = bytes[bit / 8];
        byte = static_cast<std::uint8_t>((byte & ~(1U << shift)) | one << shift);
    }
}

std::optional<WideWhole> whole_below_62_bits(double value) {
    if (std::trunc(value) != value || !(std::abs(value) < 0x1p62))
        return std::nullopt;
    return static_cast<WideWhole>(value);
}

std::optional<WideWhole> exact_whole(const CanSignal& signal, std::uint64_t raw) {
    if (signal.kind != CanValueKind::whole)
        return std::nullopt;
    const auto factor = whole_below_62_bits(signal.factor), offset = whole_below_62_bits(signal.offset);
    if (!factor || !offset)
        return std::nullopt;
    const WideWhole unscaled = signal.is_signed ? WideWhole{signed_raw(signal, raw)} : WideWhole{raw};
    return unscaled * *factor + *offset;
}

std::string decimal_text(WideWhole value) {
    std::string digits;
    const bool negative = value < 0;
    do {
        const int digit = static_cast<int>(value % 10);
        digits += static_cast<char>('0' + (digit < 0 ? -digit : digit));
        value /= 10;
    } while (value != 0);
    if (negative)
        digits += '-';
    std::ranges::reverse(digits);
    return digits;
}

} // namespace fernlicht
