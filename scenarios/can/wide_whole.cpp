#include "scenarios/can/wide_whole.h"

#include "scenarios/can/signal_bits.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

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
