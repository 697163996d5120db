#include "scenarios/can/signal_codec.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

// A multiplexor of the message being decoded.
struct Switch {
    const CanSignal* signal = nullptr;
    std::uint64_t raw = 0;
    bool there = false;
};

bool lets_in(const CanSignal& signal, std::uint64_t raw) {
    return std::ranges::any_of(signal.multiplexed_when, [&](const auto& range) { return raw >= range.first && raw <= range.second; });
}

// Up the chain of multiplexors; `left` ends a ring, which no reader lets through.
bool switched_on(const CanSignal& signal, std::span<const Switch> switches, std::size_t left) {
    if (signal.multiplexed_by.empty())
        return true;
    const auto by = std::ranges::find_if(switches, [&](const Switch& one) { return one.signal->name == signal.multiplexed_by; });
    return by != switches.end() && left > 0 && by->there && lets_in(signal, by->raw) && switched_on(*by->signal, switches, left - 1);
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

CanValue value_of_raw(const CanSignal& signal, std::uint64_t raw) {
    const double unscaled = unscaled_value(signal, raw);
    CanValue value{&signal, raw, unscaled * signal.factor + signal.offset, label_of(signal, raw, unscaled)};
    // Beyond 53 bits a double rounds before it multiplies; whole factors and offsets give the exact product, rounded once.
    if (signal.kind == CanValueKind::whole && std::abs(unscaled) >= 0x1p53)
        if (const auto exact = exact_whole(signal, raw))
            value.physical = static_cast<double>(*exact);
    return value;
}

} // namespace

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

namespace {

InputError::Where in_signal(const CanSignal& signal) { return {{}, 0, 0, signal.name}; }

WideWhole min_raw(const CanSignal& signal) { return signal.is_signed ? -(WideWhole{1} << (signal.length - 1)) : WideWhole{0}; }
WideWhole greatest_raw(const CanSignal& signal) { return (WideWhole{1} << (signal.is_signed ? signal.length - 1 : signal.length)) - 1; }

std::string raw_limit_text(const CanSignal& signal, WideWhole raw) {
    return exact_text(value_of_raw(signal, static_cast<std::uint64_t>(raw) & all_bits(signal)));
}

[[noreturn]] void refuse_size(const CanSignal& signal, const std::string& found) {
    std::string a = raw_limit_text(signal, min_raw(signal)), b = raw_limit_text(signal, greatest_raw(signal));
    if (signal.factor < 0.0)
        std::swap(a, b);
    throw InputError(in_signal(signal), "found " + found, fmt::format("{} to {}, which is what its {} bits hold", a, b, signal.length));
}

std::uint64_t fitted(const CanSignal& signal, WideWhole raw, const std::string& found) {
    if (raw < min_raw(signal) || raw > greatest_raw(signal))
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

namespace {

using RawValues = std::map<std::string, std::uint64_t>;

InputError::Where in_message(const CanMessage& message, const std::string& signal) { return {{}, 0, 0, message.name + "." + signal}; }

std::uint64_t start_raw(const CanSignal& signal) {
    const double start = signal.start_value.value_or(0.0);
    if (signal.kind == CanValueKind::float32)
        return std::bit_cast<std::uint32_t>(static_cast<float>(start));
    if (signal.kind == CanValueKind::float64)
        return std::bit_cast<std::uint64_t>(start);
    return (start < 0.0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(start)) : static_cast<std::uint64_t>(start)) &
           all_bits(signal);
}

// What a multiplexor must be so that all that is wanted of it is there; one that was named must let it in.
void choose(const CanMessage& message, const CanSignal& by, const std::vector<const CanSignal*>& wanted,
            std::span<const std::uint8_t> before, RawValues& values) {
    const auto lets_all_in = [&](std::uint64_t raw) {
        return std::ranges::all_of(wanted, [&](const CanSignal* one) { return lets_in(*one, raw); });
    };
    if (const auto named = values.find(by.name); named != values.end()) {
        for (const CanSignal* one : wanted)
            if (!lets_in(*one, named->second))
                throw InputError(in_message(message, one->name),
                                 fmt::format("found a value, although {} = {} leaves the signal out", by.name, named->second),
                                 fmt::format("{} = {}", by.name, one->multiplexed_when.empty() ? 0 : one->multiplexed_when.front().first));
        return;
    }
    const std::uint64_t usual = bytes_to_hold(by) <= before.size() ? read_bits(by, before) : 0;
    if (lets_all_in(usual)) {
        values[by.name] = usual;
        return;
    }
    std::optional<std::uint64_t> least; // the least common value is the begin of some range
    for (const CanSignal* one : wanted)
        for (const auto& range : one->multiplexed_when)
            if (range.first <= all_bits(by) && lets_all_in(range.first))
                least = std::min(least.value_or(range.first), range.first);
    if (!least) {
        std::string names;
        for (const CanSignal* one : wanted)
            names += (names.empty() ? "" : ", ") + one->name;
        throw InputError(in_message(message, by.name), fmt::format("found no value that lets {} be in one frame", names),
                         "signals that go together");
    }
    values[by.name] = *least;
}

void choose_multiplexors(const CanMessage& message, std::span<const std::uint8_t> before, RawValues& values) {
    // From the innermost outwards: a multiplexor that was chosen is itself wanted by the one above it.
    for (std::size_t round = 0; round <= message.signals.size(); ++round) {
        std::map<const CanSignal*, std::vector<const CanSignal*>> wanted;
        for (const auto& entry : values) {
            const CanSignal* one = message.signal(entry.first);
            if (!one->multiplexed_by.empty())
                if (const CanSignal* by = message.signal(one->multiplexed_by))
                    wanted[by].push_back(one);
        }
        bool more = false;
        for (const auto& [by, those] : wanted) {
            more |= !values.contains(by->name);
            choose(message, *by, those, before, values);
        }
        if (!more)
            return;
    }
}

/// Upon bytes that were there before: only the named signals change.
void encode_raw_into(const CanMessage& message, const RawValues& raw, std::span<std::uint8_t> bytes) {
    for (const auto& [name, value] : raw) {
        const CanSignal* signal = message.signal(name);
        if (signal == nullptr) {
            std::vector<std::string> names;
            for (const CanSignal& one : message.signals)
                names.push_back(one.name);
            const std::string near = nearest_name(name, names);
            throw InputError({{}, 0, 0, message.name}, fmt::format("found no signal '{}' in this message", printable(name)),
                             near.empty() ? fmt::format("one of its {}", names.size()) : near);
        }
        if (bytes_to_hold(*signal) > bytes.size())
            throw InputError(in_message(message, name), fmt::format("found a signal that needs {} bytes", bytes_to_hold(*signal)),
                             fmt::format("at most {}, the message's length", bytes.size()));
        if ((value & ~all_bits(*signal)) != 0)
            throw InputError(in_message(message, name), fmt::format("found raw value {:#x}", value),
                             fmt::format("at most {} bits", signal->length));
    }
    RawValues values = raw;
    choose_multiplexors(message, bytes, values);
    for (const auto& [name, value] : values)
        if (const CanSignal* signal = message.signal(name); bytes_to_hold(*signal) <= bytes.size())
            write_bits(*signal, value, bytes);
    for (const auto& [name, value] : raw)
        if (const CanSignal* signal = message.signal(name); read_bits(*signal, bytes) != value)
            throw InputError(in_message(message, name), "found a signal whose bits another one of these values needs, too",
                             "signals that do not overlap, or agree");
}

std::vector<std::uint8_t> encode_raw(const CanMessage& message, const RawValues& raw) {
    std::vector<std::uint8_t> bytes(message.length);
    // Start values first, of signals that are always there and then of those that the multiplexors let in.
    for (const CanSignal& signal : message.signals)
        if (signal.multiplexed_by.empty() && bytes_to_hold(signal) <= bytes.size() && signal.start_value)
            write_bits(signal, start_raw(signal), bytes);
    encode_raw_into(message, raw, bytes);
    bool more = false;
    for (const CanSignal& signal : message.signals)
        if (!signal.multiplexed_by.empty() && signal.start_value && !raw.contains(signal.name) && decode(message, signal, bytes)) {
            write_bits(signal, start_raw(signal), bytes);
            more = true;
        }
    if (more)
        encode_raw_into(message, raw, bytes);
    return bytes;
}

} // namespace

std::vector<std::uint8_t> encode(const CanMessage& message, const std::map<std::string, double>& physical) {
    RawValues raw;
    for (const auto& [name, value] : physical)
        if (const CanSignal* signal = message.signal(name))
            raw[name] = raw_of(*signal, value);
        else
            raw[name] = 0; // refused below
    return encode_raw(message, raw);
}

} // namespace fernlicht
