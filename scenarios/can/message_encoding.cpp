#include "scenarios/can/signal_bits.h"
#include "scenarios/can/signal_codec.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
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

bool lets_in(const CanSignal& signal, std::uint64_t raw) {
    return std::ranges::any_of(signal.multiplexed_when, [&](const auto& range) { return raw >= range.first && raw <= range.second; });
}

// What the multiplexors must be so that all that was named is there; those that were named must let it in.
struct Chooser {
    const CanMessage& message;
    RawValues& values;

    void run(std::span<const std::uint8_t> before);
    void choose(const CanSignal& by, const std::vector<const CanSignal*>& wanted, std::span<const std::uint8_t> before);
};

void Chooser::choose(const CanSignal& by, const std::vector<const CanSignal*>& wanted, std::span<const std::uint8_t> before) {
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

void Chooser::run(std::span<const std::uint8_t> before) {
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
            choose(*by, those, before);
        }
        if (!more)
            return;
    }
}

} // namespace

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
    Chooser{message, values}.run(bytes);
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
