#include "scenarios/can/dbc/dbc_meaning.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

// Raw value of a label; nullopt for what is no whole number of 64 bits.
std::optional<std::int64_t> label_value(std::string_view text) {
    if (text.starts_with('+'))
        text.remove_prefix(1);
    std::int64_t value = 0;
    if (const auto [end, error] = std::from_chars(text.begin(), text.end(), value); error == std::errc{} && end == text.end())
        return value;
    std::uint64_t great = 0;
    if (const auto [end, error] = std::from_chars(text.begin(), text.end(), great); error == std::errc{} && end == text.end())
        return static_cast<std::int64_t>(great);
    double number = 0.0; // "1.0", "1e3"
    if (const auto [end, error] = std::from_chars(text.begin(), text.end(), number);
        error == std::errc{} && end == text.end() && std::trunc(number) == number && std::abs(number) < 0x1p63)
        return static_cast<std::int64_t>(number);
    return std::nullopt;
}

void apply_labels(DbcReading& reading) {
    for (const DbcLabels& said : reading.statements.labels) {
        if (said.on.kind != DbcObject::Kind::signal)
            continue;
        DbcSignal* read = reading.signal(said.on.id, said.on.name);
        if (read == nullptr) {
            reading.note_absent("VAL_", said.on);
            continue;
        }
        read->signal.labels.clear();
        for (const auto& [number, text] : said.labels) {
            const std::optional<std::int64_t> value = label_value(number);
            if (!value)
                reading.note(said.on.line, fmt::format("'{}' is not a whole number that {} could have; its text '{}' is left out", number,
                                                       printable(said.on.name), printable(text)));
            else if (const auto [at, is_new] = read->signal.labels.try_emplace(*value, text); !is_new && at->second != text)
                reading.note(said.on.line, fmt::format("{} of {} is both '{}' and '{}'; the first is taken", number,
                                                       printable(said.on.name), printable(at->second), printable(text)));
        }
    }
}

void apply_comments(DbcReading& reading) {
    for (const DbcComment& said : reading.statements.comments) {
        if (said.on.kind == DbcObject::Kind::network)
            reading.comment += (reading.comment.empty() ? "" : "\n") + said.text;
        else if (said.on.kind == DbcObject::Kind::message) {
            if (DbcMessage* message = reading.message(said.on.id))
                message->message.comment = said.text;
            else
                reading.note_absent("CM_", said.on);
        } else if (said.on.kind == DbcObject::Kind::signal) {
            if (DbcSignal* signal = reading.signal(said.on.id, said.on.name))
                signal->signal.comment = said.text;
            else
                reading.note_absent("CM_", said.on);
        }
    }
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

void DbcReading::note_absent(const char* keyword, const DbcObject& on) {
    if (left_out.contains({on.id, on.name}))
        return;
    note(on.line,
         on.kind == DbcObject::Kind::signal && message(on.id) != nullptr
             ? fmt::format("{} of {}, which message {} has not", keyword, printable(on.name), printable(message(on.id)->message.name))
             : fmt::format("{} of message {}, which is not there", keyword, on.id));
}

void DbcReading::refuse(std::size_t line, const std::string& found, const std::string& expected) const {
    throw InputError({file, line, 0, {}}, "found " + found, expected);
}

std::string dbc_signal_name(const DbcMessage& message, const DbcSignal& signal) {
    return printable(message.message.name) + "." + printable(signal.signal.name);
}

void apply_dbc_value_types(DbcReading& reading) {
    for (const DbcValueType& said : reading.statements.value_types) {
        DbcSignal* signal = reading.signal(said.on.id, said.on.name);
        if (signal == nullptr)
            reading.note_absent("SIG_VALTYPE_", said.on);
        else
            signal->signal.kind = said.type == 1 ? CanValueKind::float32 : said.type == 2 ? CanValueKind::float64 : CanValueKind::whole;
    }
}

void apply_dbc_texts(DbcReading& reading) {
    apply_labels(reading);
    apply_comments(reading);
    for (const DbcSenders& said : reading.statements.senders) {
        DbcMessage* message = reading.message(said.on.id);
        if (message == nullptr) {
            reading.note_absent("BO_TX_BU_", said.on);
            continue;
        }
        for (const std::string& name : said.names)
            if (name != "Vector__XXX" && std::ranges::find(message->message.senders, name) == message->message.senders.end())
                message->message.senders.push_back(name);
    }
}

} // namespace fernlicht
