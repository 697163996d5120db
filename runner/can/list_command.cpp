#include "runner/can/list_command.h"

#include "runner/can/frame_json.h"
#include "scenarios/can/can_database.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <memory>

namespace fernlicht {
namespace {

struct ListFlags {
    std::string file, message;
    bool json = false, notes = false, comments = false;
};

std::string listed_id(const CanMessage& message) { return fmt::format("{:0{}X}", message.id, message.extended ? 8 : 3); }

// "7|16@0-": where and how the bits lie, as in the file
std::string listed_bits(const CanSignal& signal) {
    const char* kind = signal.kind == CanValueKind::float32 ? " float" : signal.kind == CanValueKind::float64 ? " double" : "";
    return fmt::format("{}|{}@{}{}{}", signal.start_bit, signal.length, signal.big_endian ? 0 : 1, signal.is_signed ? '-' : '+', kind);
}

std::string listed_switch(const CanSignal& signal) {
    std::string out;
    if (!signal.multiplexed_by.empty()) {
        out = "  if " + signal.multiplexed_by + " = ";
        bool first = true;
        for (const auto& [least, greatest] : signal.multiplexed_when) {
            out += first ? "" : ", ";
            out += least == greatest ? fmt::format("{}", least) : fmt::format("{}-{}", least, greatest);
            first = false;
        }
    }
    return signal.multiplexor ? out + "  multiplexor" : out;
}

void print_signal(const CanSignal& signal, std::size_t columns, bool comments) {
    std::string out = fmt::format("    {:{}}  {}", signal.name, columns, listed_bits(signal));
    if (signal.factor != 1.0 || signal.offset != 0.0)
        fmt::format_to(std::back_inserter(out), "  * {} {} {}", signal.factor, signal.offset < 0.0 ? '-' : '+', std::abs(signal.offset));
    if (signal.has_limits())
        fmt::format_to(std::back_inserter(out), "  {} to {}", signal.minimum, signal.maximum);
    if (!signal.unit.empty())
        out += "  " + signal.unit;
    out += listed_switch(signal);
    if (signal.start_value)
        fmt::format_to(std::back_inserter(out), "  starts raw {}", *signal.start_value);
    fmt::print("{}\n", out);
    if (comments && !signal.comment.empty())
        fmt::print("        {}\n", printable(signal.comment, 400));
    for (const auto& [raw, label] : signal.labels)
        fmt::print("        {} {}\n",
                   signal.is_signed || signal.length < 64 ? fmt::format("{}", raw) : fmt::format("{}", static_cast<std::uint64_t>(raw)),
                   printable(label, 200));
}

void print_message(const CanMessage& message, const ListFlags& flags) {
    std::string out = fmt::format("{}  {}  {} byte{}", listed_id(message), message.name, message.length, message.length == 1 ? "" : "s");
    if (message.fd)
        out += message.bit_rate_switch ? ", CAN FD with BRS" : ", CAN FD";
    if (message.cycle_s && *message.cycle_s > 0.0)
        fmt::format_to(std::back_inserter(out), ", every {:g} ms", *message.cycle_s * 1000.0);
    if (!message.send_type.empty())
        out += ", " + message.send_type;
    for (std::size_t i = 0; i < message.senders.size(); ++i)
        out += (i == 0 ? ", from " : ", ") + message.senders[i];
    fmt::print("{}\n", out);
    if (flags.comments && !message.comment.empty())
        fmt::print("    {}\n", printable(message.comment, 400));
    std::size_t columns = 0;
    for (const CanSignal& signal : message.signals)
        columns = std::max(columns, signal.name.size());
    for (const CanSignal& signal : message.signals)
        print_signal(signal, columns, flags.comments);
}

void append_signal_json(std::string& out, const CanSignal& signal) {
    out += "{\"name\":";
    append_json_text(out, signal.name);
    fmt::format_to(std::back_inserter(out),
                   ",\"start_bit\":{},\"length\":{},\"byte_order\":\"{}\",\"signed\":{},\"kind\":\"{}\",\"factor\":{},\"offset\":{}",
                   signal.start_bit, signal.length, signal.big_endian ? "motorola" : "intel", signal.is_signed,
                   signal.kind == CanValueKind::whole     ? "whole"
                   : signal.kind == CanValueKind::float32 ? "float"
                                                          : "double",
                   signal.factor, signal.offset);
    if (signal.has_limits())
        fmt::format_to(std::back_inserter(out), ",\"minimum\":{},\"maximum\":{}", signal.minimum, signal.maximum);
    for (const auto& [name, text] :
         {std::pair{"unit", &signal.unit}, std::pair{"comment", &signal.comment}, std::pair{"multiplexed_by", &signal.multiplexed_by}})
        if (!text->empty()) {
            fmt::format_to(std::back_inserter(out), ",\"{}\":", name);
            append_json_text(out, *text);
        }
    if (!signal.multiplexed_when.empty()) {
        out += ",\"multiplexed_when\":[";
        for (const auto& [least, greatest] : signal.multiplexed_when)
            fmt::format_to(std::back_inserter(out), "{}[{},{}]", out.back() == '[' ? "" : ",", least, greatest);
        out += ']';
    }
    out += signal.multiplexor ? ",\"multiplexor\":true" : "";
    if (signal.start_value)
        fmt::format_to(std::back_inserter(out), ",\"start_raw\":{}", *signal.start_value);
    if (!signal.labels.empty()) {
        out += ",\"labels\":{";
        for (const auto& [raw, label] : signal.labels) {
            fmt::format_to(std::back_inserter(out), "{}\"{}\":", out.back() == '{' ? "" : ",", raw);
            append_json_text(out, label);
        }
        out += '}';
    }
    out += '}';
}

void print_message_json(const CanMessage& message) {
    std::string out = "{\"id\":\"" + listed_id(message) + "\",\"name\":";
    append_json_text(out, message.name);
    fmt::format_to(std::back_inserter(out), ",\"length\":{}", message.length);
    out += message.fd ? ",\"fd\":true" : "";
    out += message.bit_rate_switch ? ",\"brs\":true" : "";
    if (message.cycle_s)
        fmt::format_to(std::back_inserter(out), ",\"cycle_s\":{}", *message.cycle_s);
    for (const auto& [name, text] : {std::pair{"send_type", &message.send_type}, std::pair{"comment", &message.comment}})
        if (!text->empty()) {
            fmt::format_to(std::back_inserter(out), ",\"{}\":", name);
            append_json_text(out, *text);
        }
    out += ",\"signals\":[";
    for (const CanSignal& signal : message.signals) {
        out += out.back() == '[' ? "" : ",";
        append_signal_json(out, signal);
    }
    fmt::print("{}]}}\n", out);
}

int list_database(const ListFlags& flags) {
    FilesRead opened;
    const CanDatabase database = read_dbc(flags.file, opened);
    std::vector<std::string> names;
    bool found = flags.message.empty();
    std::size_t signals = 0;
    for (const CanMessage& message : database.messages) {
        names.push_back(message.name);
        signals += message.signals.size();
        if (!flags.message.empty() && message.name != flags.message)
            continue;
        found = true;
        flags.json ? print_message_json(message) : print_message(message, flags);
    }
    if (!found)
        throw InputError({database.file, 0, 0, {}}, fmt::format("found no message '{}' among {}", printable(flags.message), names.size()),
                         nearest_name(flags.message, names));
    if (flags.notes)
        for (const std::string& note : database.notes)
            fmt::print(stderr, "fernlicht: {}: {}\n", printable(database.file.string(), 400), note);
    if (!flags.json && flags.message.empty())
        fmt::print("{} messages with {} signals{}\n", database.messages.size(), signals,
                   database.notes.empty() || flags.notes ? "" : fmt::format(", {} notes (--notes shows them)", database.notes.size()));
    return 0;
}

} // namespace

void add_can_list(CLI::App& can, std::function<int()>& chosen) {
    const auto flags = std::make_shared<ListFlags>();
    CLI::App* sub = can.add_subcommand("list", "messages and signals of a DBC file, and what was odd about it");
    sub->add_option("FILE", flags->file, "DBC file")->required();
    sub->add_option("MESSAGE", flags->message, "this one alone");
    sub->add_flag("--notes", flags->notes, "what was odd and how it was taken, on standard error");
    sub->add_flag("--comments", flags->comments, "comments of messages and signals, too");
    sub->add_flag("--json", flags->json, "one JSON object a message and line");
    sub->callback([flags, &chosen] { chosen = [flags] { return list_database(*flags); }; });
}

} // namespace fernlicht
