#include "scenarios/can/signal_codec.h"

#include "scenarios/can/signal_bits.h"
#include "scenarios/can/wide_whole.h"

#include <bit>
#include <cmath>

namespace fernlicht {
namespace {

// A multiplexor of the message being decoded.
struct Switch {
    const CanSignal* signal = nullptr;
    std::uint64_t raw = 0;
    bool there = false;
};

bool chosen_by(const CanSignal& signal, std::uint64_t raw) {
    for (const auto& [first, last] : signal.multiplexed_when)
        if (raw >= first && raw <= last)
            return true;
    return false;
}

const Switch* switch_of(const CanSignal& signal, std::span<const Switch> switches) {
    for (const Switch& one : switches)
        if (one.signal->name == signal.multiplexed_by)
            return &one;
    return nullptr;
}

// Up the chain of multiplexors; `left` ends a ring, which no reader lets through.
bool switched_on(const CanSignal& signal, std::span<const Switch> switches, std::size_t left) {
    if (signal.multiplexed_by.empty())
        return true;
    const Switch* by = switch_of(signal, switches);
    return by != nullptr && left > 0 && by->there && chosen_by(signal, by->raw) && switched_on(*by->signal, switches, left - 1);
}

std::vector<Switch> switches_of(const CanMessage& message, std::span<const std::uint8_t> bytes) {
    std::vector<Switch> switches;
    for (const CanSignal& signal : message.signals) {
        if (!signal.multiplexor)
            continue;
        const bool whole = bytes_to_hold(signal) <= bytes.size();
        switches.push_back({&signal, whole ? read_bits(signal, bytes) : 0, whole});
    }
    return switches;
}

const std::string* label_of(const CanSignal& signal, std::uint64_t raw, double unscaled) {
    if (signal.labels.empty())
        return nullptr;
    std::int64_t key = 0;
    if (signal.kind == CanValueKind::whole)
        key = signal.is_signed ? signed_raw(signal, raw) : static_cast<std::int64_t>(raw);
    else if (std::trunc(unscaled) == unscaled && std::abs(unscaled) < 0x1p63)
        key = static_cast<std::int64_t>(unscaled);
    else
        return nullptr;
    const auto found = signal.labels.find(key);
    return found == signal.labels.end() ? nullptr : &found->second;
}

double unscaled_value(const CanSignal& signal, std::uint64_t raw) {
    if (signal.kind == CanValueKind::float32)
        return std::bit_cast<float>(static_cast<std::uint32_t>(raw));
    if (signal.kind == CanValueKind::float64)
        return std::bit_cast<double>(raw);
    return signal.is_signed ? static_cast<double>(signed_raw(signal, raw)) : static_cast<double>(raw);
}

} // namespace

CanValue value_of_raw(const CanSignal& signal, std::uint64_t raw) {
    const double unscaled = unscaled_value(signal, raw);
    CanValue value{&signal, raw, unscaled * signal.factor + signal.offset, label_of(signal, raw, unscaled)};
    // Beyond 53 bits a double rounds before it multiplies; whole factors and offsets give the exact product, rounded once.
    if (signal.kind == CanValueKind::whole && std::abs(unscaled) >= 0x1p53)
        if (const auto exact = exact_whole(signal, raw))
            value.physical = static_cast<double>(*exact);
    return value;
}

bool CanValue::out_of_limits() const {
    if (!std::isfinite(physical))
        return true;
    if (!signal->has_limits())
        return false;
    const auto slack = [&](double limit) {
        return signal->kind == CanValueKind::whole ? std::abs(signal->factor) / 2.0 : std::abs(limit) * 0x1p-23;
    };
    return physical < signal->minimum - slack(signal->minimum) || physical > signal->maximum + slack(signal->maximum);
}

void decode_into(const CanMessage& message, std::span<const std::uint8_t> bytes, std::vector<CanValue>& values) {
    values.clear();
    const std::vector<Switch> switches = switches_of(message, bytes);
    for (const CanSignal& signal : message.signals)
        if (bytes_to_hold(signal) <= bytes.size() && switched_on(signal, switches, switches.size()))
            values.push_back(value_of_raw(signal, read_bits(signal, bytes)));
}

std::vector<CanValue> decode(const CanMessage& message, std::span<const std::uint8_t> bytes) {
    std::vector<CanValue> values;
    decode_into(message, bytes, values);
    return values;
}

std::optional<CanValue> decode(const CanMessage& message, const CanSignal& signal, std::span<const std::uint8_t> bytes) {
    if (bytes_to_hold(signal) > bytes.size())
        return std::nullopt;
    if (!signal.multiplexed_by.empty()) {
        const std::vector<Switch> switches = switches_of(message, bytes);
        if (!switched_on(signal, switches, switches.size()))
            return std::nullopt;
    }
    return value_of_raw(signal, read_bits(signal, bytes));
}

} // namespace fernlicht
