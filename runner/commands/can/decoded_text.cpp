#include "runner/commands/can/decoded_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>

namespace fernlicht {

void append_readable(std::string& out, const CanValue& value) {
    if (std::trunc(value.physical) == value.physical) // of factors such as 0.5, too, as long as nothing is behind the point
        out += exact_text(value);
    else
        fmt::format_to(std::back_inserter(out), "{:.{}g}", value.physical, value.signal->kind == CanValueKind::float32 ? 7 : 12);
}

void append_decoded(std::string& out, const CanMessage& message, std::span<const CanValue> values, bool single_line, bool numbers) {
    out += single_line ? " :: " : " ::\n";
    out += message.name;
    out += single_line ? "(" : "(\n";
    bool first = true;
    for (const CanValue& value : values) {
        if (!first)
            out += single_line ? ", " : ",\n";
        first = false;
        out += single_line ? "" : "    ";
        out += value.signal->name;
        out += ": ";
        if (value.label != nullptr && !numbers) {
            out += *value.label;
            continue;
        }
        append_readable(out, value);
        if (!value.signal->unit.empty()) {
            out += ' ';
            out += value.signal->unit;
        }
    }
    out += single_line || first ? ")" : "\n)";
}

void append_csv_text(std::string& out, const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) {
        out += text;
        return;
    }
    out += '"';
    for (const char c : text) {
        if (c == '"')
            out += '"';
        out += c;
    }
    out += '"';
}

namespace {

void append_seconds(std::string& out, std::int64_t ns, int digits) {
    const std::string fraction = fmt::format("{:09}", ns % 1'000'000'000);
    fmt::format_to(std::back_inserter(out), "{}", ns / 1'000'000'000);
    if (digits > 0)
        out += "." + fraction.substr(0, static_cast<std::size_t>(digits));
}

void append_hexadecimal(std::string& out, std::span<const std::uint8_t> bytes) {
    constexpr const char* digits = "0123456789ABCDEF";
    for (const std::uint8_t byte : bytes) {
        out += digits[byte >> 4];
        out += digits[byte & 15];
    }
}

void append_signal_value(std::string& out, const CanValue& value) {
    if (!std::isfinite(value.physical)) // JSON has no such numbers
        append_json_text(out, exact_text(value));
    else
        out += exact_text(value);
}

template <class Take, class Write>
void append_json_object(std::string& out, const char* name, std::span<const CanValue> values, Take take, Write write) {
    bool first = true;
    for (const CanValue& value : values) {
        if (!take(value))
            continue;
        out += first ? fmt::format(",\"{}\":{{", name) : ",";
        first = false;
        append_json_text(out, value.signal->name);
        out += ':';
        write(value);
    }
    if (!first)
        out += '}';
}

void append_flags_json(std::string& out, const CanFrame& frame, const CandumpStyle& style) {
    for (const auto& [set, name] :
         {std::pair{frame.fd, "fd"}, std::pair{frame.bit_rate_switch, "brs"}, std::pair{frame.error_state_indicator, "esi"},
          std::pair{frame.remote, "remote"}, std::pair{frame.error, "error"}})
        if (set)
            fmt::format_to(std::back_inserter(out), ",\"{}\":true", name);
    if (style.more_fd_flags != 0)
        fmt::format_to(std::back_inserter(out), ",\"more_fd_flags\":{}", style.more_fd_flags);
    if (frame.raw_dlc > 8)
        fmt::format_to(std::back_inserter(out), ",\"dlc\":{}", frame.raw_dlc);
    if (style.sent)
        fmt::format_to(std::back_inserter(out), ",\"sent\":{}", *style.sent);
}

} // namespace

void append_json_text(std::string& out, std::string_view text) {
    const bool plain = std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; });
    if (plain) {
        out += '"';
        out += text;
        out += '"';
    } else
        out += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void append_frame_json(std::string& out, const CandumpLine& line, const CanMessage* message, std::span<const CanValue> values) {
    const CanFrame& frame = line.frame;
    out += '{';
    if (line.style.stamp_digits > 0) {
        out += "\"time\":";
        append_seconds(out, frame.time_ns, line.style.stamp_digits);
        out += ',';
    }
    out += "\"channel\":";
    append_json_text(out, frame.channel);
    const bool long_id = frame.extended || frame.error;
    fmt::format_to(std::back_inserter(out), ",\"id\":\"{:0{}X}\"", frame.id | (frame.error ? 0x20000000U : 0U), long_id ? 8 : 3);
    append_flags_json(out, frame, line.style);
    if (frame.remote)
        fmt::format_to(std::back_inserter(out), ",\"length\":{}", frame.length);
    else {
        out += ",\"data\":\"";
        append_hexadecimal(out, frame.bytes());
        out += '"';
    }
    if (message != nullptr) {
        out += ",\"message\":";
        append_json_text(out, message->name);
        const auto all = [](const CanValue&) { return true; };
        append_json_object(out, "signals", values, all, [&](const CanValue& value) { append_signal_value(out, value); });
        out += values.empty() ? ",\"signals\":{}" : "";
        append_json_object(
            out, "labels", values, [](const CanValue& value) { return value.label != nullptr; },
            [&](const CanValue& value) { append_json_text(out, *value.label); });
        append_json_object(
            out, "units", values, [](const CanValue& value) { return !value.signal->unit.empty(); },
            [&](const CanValue& value) { append_json_text(out, value.signal->unit); });
        bool first = true;
        for (const CanValue& value : values) {
            if (!value.out_of_limits())
                continue;
            out += first ? ",\"out_of_limits\":[" : ",";
            append_json_text(out, value.signal->name);
            first = false;
        }
        out += first ? "" : "]";
    }
    out += '}';
}

} // namespace fernlicht
