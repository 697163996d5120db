#include "scenarios/can/dbc/dbc_meaning.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

template <class Number> std::optional<Number> all_of(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.begin(), text.end(), value);
    return error == std::errc{} && end == text.end() ? std::optional(value) : std::nullopt;
}

/// Raw value of a label; nullopt for what is no whole number of 64 bits.
std::optional<std::int64_t> label_value(std::string_view text) {
    if (text.starts_with('+'))
        text.remove_prefix(1);
    if (const auto value = all_of<std::int64_t>(text))
        return value;
    if (const auto great = all_of<std::uint64_t>(text))
        return static_cast<std::int64_t>(*great);
    if (const auto number = all_of<double>(text); number && std::trunc(*number) == *number && std::abs(*number) < 0x1p63)
        return static_cast<std::int64_t>(*number); // "1.0", "1e3"
    return std::nullopt;
}

} // namespace

DbcMessage* DbcReading::message(std::uint32_t id) {
    const auto found = by_id.find(id);
    return found == by_id.end() ? nullptr : &statements.messages[found->second];
}

DbcSignal* DbcReading::signal(std::uint32_t id, const std::string& name) {
    DbcMessage* in = message(id);
    if (in == nullptr)
        return nullptr;
    Places& known = places[id];
    if (known.signals != in->signals.size()) {
        known = {in->signals.size(), {}};
        for (std::size_t i = 0; i < in->signals.size(); ++i)
            known.of.emplace(in->signals[i].signal.name, i);
    }
    const auto found = known.of.find(name);
    return found == known.of.end() ? nullptr : &in->signals[found->second];
}

void DbcReading::note(std::size_t line, const std::string& text) { notes.push_back(fmt::format("line {}: {}", line, text)); }

DbcMessage* DbcReading::message_of(const char* keyword, const DbcObject& on) {
    DbcMessage* const found = message(on.id);
    if (found == nullptr && !left_out.contains({on.id, on.name}))
        note(on.line, fmt::format("{} of message {}, which is not there", keyword, on.id));
    return found;
}

DbcSignal* DbcReading::signal_of(const char* keyword, const DbcObject& on) {
    DbcSignal* const found = signal(on.id, on.name);
    if (const DbcMessage* const in = found ? nullptr : message_of(keyword, on); in && !left_out.contains({on.id, on.name}))
        note(on.line, fmt::format("{} of {}, which message {} has not", keyword, printable(on.name), printable(in->message.name)));
    return found;
}

void DbcReading::refuse(std::size_t line, const std::string& found, const std::string& expected) const {
    throw InputError({file, line, 0, {}}, "found " + found, expected);
}

std::string dbc_signal_name(const DbcMessage& message, const DbcSignal& signal) {
    return printable(message.message.name) + "." + printable(signal.signal.name);
}

void apply_dbc_value_types(DbcReading& reading) {
    for (const auto& [on, type] : reading.statements.value_types)
        if (DbcSignal* const read = reading.signal_of("SIG_VALTYPE_", on))
            read->signal.kind = type == 1 ? CanValueKind::float32 : type == 2 ? CanValueKind::float64 : CanValueKind::whole;
}

void apply_dbc_labels(DbcReading& reading) {
    for (const auto& [on, labels] : reading.statements.labels) {
        DbcSignal* const read = reading.signal_of("VAL_", on);
        if (read == nullptr)
            continue;
        read->signal.labels.clear();
        for (const auto& [number, text] : labels) {
            const std::optional<std::int64_t> value = label_value(number);
            if (!value)
                reading.note(on.line, fmt::format("'{}' is not a whole number that {} could have; its text '{}' is left out", number,
                                                  printable(on.name), printable(text)));
            else if (const auto [at, is_new] = read->signal.labels.try_emplace(*value, text); !is_new && at->second != text)
                reading.note(on.line, fmt::format("{} of {} is both '{}' and '{}'; the first is taken", number, printable(on.name),
                                                  printable(at->second), printable(text)));
        }
    }
}

} // namespace fernlicht
