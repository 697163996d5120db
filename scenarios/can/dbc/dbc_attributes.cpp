#include "scenarios/can/dbc/dbc_meaning.h"
#include "scenarios/can/signal_codec.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::optional<double> attribute_number(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// A choice may be written by its number.
std::string attribute_choice(const DbcReading& reading, const std::string& name, const std::string& value, bool quoted) {
    const auto choices = reading.statements.choices.find(name);
    const std::optional<double> number = attribute_number(value);
    if (quoted || choices == reading.statements.choices.end() || !number)
        return value;
    const auto& known = choices->second;
    return *number >= 0.0 && *number < static_cast<double>(known.size()) ? known[static_cast<std::size_t>(*number)] : value;
}

// Frame formats by number where the attribute is a number.
bool says_fd(const std::string& format) { return format.ends_with("_FD") || format == "14" || format == "15"; }
bool says_transport(const std::string& format) { return format == "J1939PG" || format == "3"; }

void set_cycle(DbcReading& reading, const DbcAttribute& said, CanMessage& message) {
    const std::optional<double> ms = attribute_number(said.value);
    if (!ms || !std::isfinite(*ms) || *ms < 0.0)
        reading.note(said.on.line, fmt::format("GenMsgCycleTime '{}' of {} is not a time in milliseconds; it counts as not cyclic",
                                               printable(said.value), printable(message.name)));
    else
        message.cycle_s = *ms / 1000.0;
}

// Can the signal hold this raw value?
bool holds_raw(const CanSignal& signal, double raw) {
    if (signal.kind != CanValueKind::whole)
        return std::isfinite(raw);
    const int bits = signal.length;
    const double least = signal.is_signed ? -std::ldexp(1.0, bits - 1) : 0.0;
    const double beyond = std::ldexp(1.0, signal.is_signed ? bits - 1 : bits);
    return std::trunc(raw) == raw && raw >= least && raw < beyond;
}

void set_start(DbcReading& reading, const DbcAttribute& said, DbcSignal& read) {
    const std::optional<double> raw = attribute_number(said.value);
    if (raw && holds_raw(read.signal, *raw))
        read.signal.start_value = *raw;
    else
        reading.note(said.on.line, fmt::format("GenSigStartValue '{}' of {} is not a raw value that its {} bits hold; left out",
                                               printable(said.value), printable(read.signal.name), read.signal.length));
}

void apply_defaults(DbcReading& reading) {
    const auto& defaults = reading.statements.defaults;
    const auto text = [&](const char* name) {
        const auto found = defaults.find(name);
        return found == defaults.end() ? std::string() : attribute_choice(reading, name, found->second, false);
    };
    const std::optional<double> cycle_ms = attribute_number(text("GenMsgCycleTime")), start = attribute_number(text("GenSigStartValue"));
    for (DbcMessage& read : reading.statements.messages) {
        if (cycle_ms && *cycle_ms > 0.0 && std::isfinite(*cycle_ms))
            read.message.cycle_s = *cycle_ms / 1000.0;
        read.frame_format = text("VFrameFormat");
        read.message.bit_rate_switch = text("CANFD_BRS") == "1";
        for (DbcSignal& signal : read.signals)
            if (start && *start != 0.0 && holds_raw(signal.signal, *start))
                signal.signal.start_value = *start;
    }
}

void apply_to_message(DbcReading& reading, const DbcAttribute& said) {
    DbcMessage* const read = reading.message_of("BA_", said.on);
    if (read == nullptr)
        return;
    const std::string value = attribute_choice(reading, said.name, said.value, said.quoted);
    if (said.name == "GenMsgCycleTime")
        set_cycle(reading, said, read->message);
    else if (said.name == "VFrameFormat")
        read->frame_format = value;
    else if (said.name == "CANFD_BRS")
        read->message.bit_rate_switch = value == "1";
    else if (said.name == "SystemMessageLongSymbol" && !value.empty())
        read->long_name = value;
}

void apply_to_signal(DbcReading& reading, const DbcAttribute& said) {
    DbcSignal* const read = reading.signal_of("BA_", said.on);
    if (read == nullptr)
        return;
    if (said.name == "GenSigStartValue")
        set_start(reading, said, *read);
    else if (said.name == "SystemSignalLongSymbol" && !said.value.empty())
        read->long_name = said.value;
}

void settle_frame_format(DbcReading& reading, DbcMessage& read) {
    CanMessage& message = read.message;
    const bool transported = says_transport(read.frame_format) && message.length > 8;
    message.fd = says_fd(read.frame_format) || (message.length > 8 && !transported);
    message.bit_rate_switch = message.bit_rate_switch && message.fd;
    if (transported)
        reading.note(read.line, fmt::format("{} has {} bytes, which J1939 sends in several frames; these are not put together",
                                            printable(message.name), message.length));
    else if (message.length > 64)
        reading.note(read.line, fmt::format("{} has {} bytes, more than a frame holds", printable(message.name), message.length));
    else if (message.length > 8 && message.length % 4 != 0)
        reading.note(read.line, fmt::format("{} has {} bytes, which CAN FD fills up to the next length that it knows",
                                            printable(message.name), message.length));
}

// Each long name must lead to one thing, as the short one did; where it does not, all keep their short ones.
void give_long_names(DbcReading& reading, DbcMessage& message) {
    std::map<std::string, int> count;
    for (const DbcSignal& read : message.signals)
        ++count[read.long_name.empty() ? read.signal.name : read.long_name];
    std::map<std::string, std::string> renamed;
    for (DbcSignal& read : message.signals) {
        if (read.long_name.empty() || read.long_name == read.signal.name)
            continue;
        if (count[read.long_name] > 1)
            reading.note(read.line, fmt::format("the long name {} is in {} twice; {} keeps its short one", printable(read.long_name),
                                                printable(message.message.name), printable(read.signal.name)));
        else
            renamed[read.signal.name] = read.long_name;
    }
    for (DbcSignal& read : message.signals) {
        if (const auto to = renamed.find(read.signal.name); to != renamed.end())
            read.signal.name = to->second;
        if (const auto to = renamed.find(read.signal.multiplexed_by); to != renamed.end())
            read.signal.multiplexed_by = to->second;
    }
}

} // namespace

void apply_dbc_attributes(DbcReading& reading) {
    apply_defaults(reading);
    for (const DbcAttribute& said : reading.statements.attributes) {
        if (said.on.kind == DbcObject::Kind::message)
            apply_to_message(reading, said);
        else if (said.on.kind == DbcObject::Kind::signal)
            apply_to_signal(reading, said);
    }
    for (DbcMessage& message : reading.statements.messages) {
        settle_frame_format(reading, message);
        give_long_names(reading, message);
        if (!message.long_name.empty())
            message.message.name = message.long_name;
    }
}

} // namespace fernlicht
