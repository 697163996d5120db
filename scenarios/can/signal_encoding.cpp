#include "scenarios/can/signal_bits.h"
#include "scenarios/can/signal_codec.h"
#include "scenarios/can/wide_whole.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

InputError::Where in_signal(const CanSignal& signal) { return {{}, 0, 0, signal.name}; }

WideWhole least_raw(const CanSignal& signal) { return signal.is_signed ? -(WideWhole{1} << (signal.length - 1)) : WideWhole{0}; }
WideWhole greatest_raw(const CanSignal& signal) { return (WideWhole{1} << (signal.is_signed ? signal.length - 1 : signal.length)) - 1; }

std::string raw_limit_text(const CanSignal& signal, WideWhole raw) {
    return exact_text(value_of_raw(signal, static_cast<std::uint64_t>(raw) & all_bits(signal)));
}

[[noreturn]] void refuse_size(const CanSignal& signal, const std::string& found) {
    std::string a = raw_limit_text(signal, least_raw(signal)), b = raw_limit_text(signal, greatest_raw(signal));
    if (signal.factor < 0.0)
        std::swap(a, b);
    throw InputError(in_signal(signal), "found " + found, fmt::format("{} to {}, which is what its {} bits hold", a, b, signal.length));
}

std::uint64_t fitted(const CanSignal& signal, WideWhole raw, const std::string& found) {
    if (raw < least_raw(signal) || raw > greatest_raw(signal))
        refuse_size(signal, found);
    return static_cast<std::uint64_t>(raw) & all_bits(signal);
}

// Nearest multiple, halves away from 0.
WideWhole rounded_quotient(WideWhole dividend, WideWhole divisor) {
    if (divisor < 0) {
        dividend = -dividend;
        divisor = -divisor;
    }
    const WideWhole half = divisor / 2;
    return dividend >= 0 ? (dividend + half) / divisor : -((-dividend + half) / divisor);
}

// Without rounding through doubles; nullopt where factor and offset are not whole.
std::optional<std::uint64_t> exact_raw(const CanSignal& signal, WideWhole physical, const std::string& found) {
    const auto factor = whole_below_62_bits(signal.factor), offset = whole_below_62_bits(signal.offset);
    if (signal.kind != CanValueKind::whole || !factor || !offset)
        return std::nullopt;
    return fitted(signal, rounded_quotient(physical - *offset, *factor), found);
}

std::uint64_t raw_of_floating(const CanSignal& signal, double physical) {
    const double unscaled = (physical - signal.offset) / signal.factor;
    if (signal.kind == CanValueKind::float64)
        return std::bit_cast<std::uint64_t>(unscaled);
    // Beyond halfway from the greatest float to the next there would be; a cast beyond the greatest is undefined.
    if (std::isfinite(unscaled) && std::abs(unscaled) >= 0x1.ffffffp127)
        throw InputError(in_signal(signal), fmt::format("found {}", physical), "a value that a float of 32 bits can hold");
    constexpr double greatest = std::numeric_limits<float>::max();
    if (std::isfinite(unscaled))
        return std::bit_cast<std::uint32_t>(static_cast<float>(std::clamp(unscaled, -greatest, greatest)));
    return std::bit_cast<std::uint32_t>(static_cast<float>(unscaled));
}

} // namespace

std::string exact_text(const CanValue& value) {
    const CanSignal& signal = *value.signal;
    if (const auto exact = exact_whole(signal, value.raw))
        return decimal_text(*exact);
    return fmt::format("{}", value.physical);
}

std::uint64_t raw_of(const CanSignal& signal, double physical) {
    if (signal.kind != CanValueKind::whole)
        return raw_of_floating(signal, physical);
    const std::string found = fmt::format("{}", physical);
    if (!std::isfinite(physical))
        throw InputError(in_signal(signal), "found " + found, "a number, because the signal is a whole one");
    if (std::trunc(physical) == physical && std::abs(physical) >= 0x1p53 && std::abs(physical) < 0x1p100)
        if (const auto exact = exact_raw(signal, static_cast<WideWhole>(physical), found))
            return *exact;
    const double raw = std::round((physical - signal.offset) / signal.factor);
    if (!(std::abs(raw) < 0x1p65))
        refuse_size(signal, found);
    return fitted(signal, static_cast<WideWhole>(raw), found);
}

} // namespace fernlicht
