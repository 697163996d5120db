#include "runner/can/encode_command.h"

#include "runner/can/databases.h"
#include "runner/can/frame_json.h"
#include "runner/can/line_output.h"
#include "runner/can/log_flags.h"
#include "runner/can/text_lines.h"
#include "runner/flag_values.h"
#include "runner/interruption.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

struct EncodeFlags {
    std::vector<std::string> words; ///< message, then SIGNAL=VALUE; or - for JSON
    std::string channel, stamp, data, out;
    DatabaseFlags databases;
    bool force = false, lenient = false;
};

// Raw values of what was named; what the bytes before already mean keeps its bits, whichever of several they are (not a number, -0).
std::map<std::string, std::uint64_t> raw_values(const CanMessage& message, const FrameJson& from, std::span<const std::uint8_t> before) {
    std::map<std::string, std::uint64_t> raw;
    for (const auto& [name, text] : from.signals) {
        const CanSignal* signal = message.signal(name);
        if (signal == nullptr) {
            raw[name] = 0; // encode_raw says what is wrong
            continue;
        }
        const auto now = from.has_data ? decode(message, *signal, before) : std::nullopt;
        if (now && exact_text(*now) == text)
            continue;
        const std::uint64_t value = raw_of(*signal, text);
        if (!now || now->raw != value)
            raw[name] = value;
    }
    return raw;
}

// The next length that CAN FD knows; of more than 64 bytes as it is.
std::size_t fd_length(std::size_t bytes) {
    for (const std::size_t length : {12U, 16U, 20U, 24U, 32U, 48U, 64U})
        if (bytes > 8 && bytes <= length)
            return length;
    return bytes;
}

void fill_frame(CanFrame& frame, const CanMessage& message, const FrameJson& from) {
    if (frame.remote || frame.error)
        throw InputError({{}, 0, 0, message.name}, "found a remote or error frame with signals", "a data frame");
    if (from.has_data) {
        const std::span<std::uint8_t> bytes(frame.data.data(), frame.length);
        encode_raw_into(message, raw_values(message, from, bytes), bytes);
        return;
    }
    const std::vector<std::uint8_t> bytes = encode_raw(message, raw_values(message, from, {}));
    if (bytes.size() > 64)
        throw InputError({{}, 0, 0, message.name}, fmt::format("found a message of {} bytes", bytes.size()),
                         "at most 64, what a frame holds");
    frame.fd = frame.fd || message.fd || bytes.size() > 8;
    frame.bit_rate_switch = frame.bit_rate_switch || message.bit_rate_switch;
    std::ranges::copy(bytes, frame.data.begin());
    frame.length = static_cast<std::uint8_t>(frame.fd ? fd_length(bytes.size()) : bytes.size());
}

CandumpLine encoded(const FrameJson& from, const Databases& databases) {
    CandumpLine line = from.line;
    CanFrame& frame = line.frame;
    if (from.message.empty() && !from.signals.empty())
        throw InputError({{}, 0, 0, "message"}, "found none", "the message that the signals belong to");
    if (from.message.empty() && !from.has_id)
        throw InputError({{}, 0, 0, "id"}, "found none", "an identifier, or a message with signals");
    if (from.message.empty() && !from.has_data && !frame.remote)
        throw InputError({{}, 0, 0, "data"}, "found none", "bytes, or a message with signals");
    if (from.message.empty() || (from.has_data && from.signals.empty() && from.has_id))
        return line;
    const CanMessage* by_id = from.has_id ? databases.message(frame) : nullptr;
    const CanMessage& message = by_id != nullptr && by_id->name == from.message ? *by_id : databases.named(from.message);
    if (!from.has_id) {
        frame.id = message.id;
        frame.extended = message.extended;
    }
    fill_frame(frame, message, from);
    return line;
}

// What a frame cannot be would be read back as something else.
void check_frame(const CanFrame& frame) {
    const auto refuse = [](const std::string& found, const std::string& expected) {
        throw InputError({{}, 0, 0, "data"}, "found " + found, expected);
    };
    if (frame.fd ? fd_length(frame.length) != frame.length : frame.length > 8)
        refuse(fmt::format("{} bytes", frame.length),
               frame.fd ? "a length of CAN FD: 0 to 8, 12, 16, 20, 24, 32, 48 or 64" : "at most 8, or \"fd\": true");
    if (frame.fd && (frame.remote || frame.error))
        refuse("CAN FD", "no CAN FD in remote and error frames");
    if (frame.error && frame.length != 8)
        refuse(fmt::format("{} bytes", frame.length), "8 of an error frame");
    const auto in_name = [](char c) { return c > ' ' && c <= '~'; };
    if (frame.channel.size() > 15 || !std::ranges::all_of(frame.channel, in_name))
        throw InputError({{}, 0, 0, "channel"}, "found '" + printable(frame.channel) + "'", "a name of at most 15 letters without blanks");
}

void write_line(std::string& out, CandumpLine line, const EncodeFlags& flags, const FrameJson& from) {
    if (!flags.channel.empty())
        line.frame.channel = flags.channel;
    if (!flags.stamp.empty()) {
        line.frame.time_ns = nanoseconds_of("--stamp", flags.stamp);
        const std::size_t point = flags.stamp.find('.');
        line.style.stamp_digits = point != std::string::npos && flags.stamp.size() - point > 7 ? 9 : 6;
    }
    check_frame(line.frame);
    const bool bare = line.frame.channel.empty() && !from.has_time && flags.stamp.empty();
    if (line.frame.channel.empty())
        line.frame.channel = "can0";
    if (!bare) {
        append_candump_line(out, line.frame, line.style);
    } else { // as cansend takes it
        line.style.sent.reset();
        const std::string text = candump_line(line.frame, line.style);
        out += text.substr(text.find(' ', text.find(' ') + 1) + 1);
    }
    out += '\n';
}

FrameJson from_words(const EncodeFlags& flags) {
    FrameJson from;
    from.message = flags.words.front();
    for (auto word = flags.words.begin() + 1; word != flags.words.end(); ++word) {
        const std::size_t equals = word->find('=');
        if (equals == std::string::npos || equals == 0)
            throw InputError({}, "found '" + printable(*word) + "'", "SIGNAL=VALUE");
        from.signals.emplace_back(word->substr(0, equals), word->substr(equals + 1));
    }
    for (const auto& [name, value] : from.signals)
        if (std::ranges::count(from.signals, name, &std::pair<std::string, std::string>::first) > 1)
            throw InputError({}, "found '" + printable(name) + "' twice", "each signal once");
    return from;
}

void take_data_flag(FrameJson& from, const EncodeFlags& flags, const Databases& databases) {
    if (flags.data.empty())
        return;
    std::string json = "{\"data\":";
    append_json_text(json, flags.data);
    const FrameJson data = parse_frame_json(json + "}", {"--data", 0, 0, {}});
    const CanMessage& message = databases.named(from.message);
    from.line.frame.data = data.line.frame.data;
    from.line.frame.length = data.line.frame.length;
    from.line.frame.fd = message.fd;
    from.line.frame.bit_rate_switch = message.bit_rate_switch;
    from.has_data = true;
}

void encode_line(std::string& out, std::string_view text, const InputError::Where& where, const Databases& databases,
                 const EncodeFlags& flags) {
    const FrameJson from = parse_frame_json(text, where);
    if (!from.is_frame)
        return;
    try {
        write_line(out, encoded(from, databases), flags, from);
    } catch (const InputError& error) { // what does not fit knows its signal, not the line
        throw InputError(where, error.what());
    }
}

int encode_frames(const EncodeFlags& flags) {
    const Databases databases(flags.databases);
    LineOutput out(flags.out, flags.force);
    if (!flags.words.empty() && flags.words.front() != "-") {
        FrameJson from = from_words(flags);
        take_data_flag(from, flags, databases);
        write_line(out.text(), encoded(from, databases), flags, from);
        out.finish();
        return 0;
    }
    if (flags.words.size() > 1)
        throw InputError({}, "found '" + printable(flags.words[1]) + "' behind -", "JSON lines alone");
    if (!flags.data.empty())
        throw InputError({{}, 0, 0, "--data"}, "found it with JSON lines", "\"data\" in each of them");
    const Interruption interruption;
    TextLines lines;
    while (lines.next()) {
        if (lines.text().find_first_not_of(" \t\r") == std::string_view::npos)
            continue;
        try {
            encode_line(out.text(), lines.text(), {"standard input", lines.number(), 0, {}}, databases, flags);
        } catch (const InputError& error) {
            if (!flags.lenient)
                throw;
            fmt::print(stderr, "fernlicht: skipped: {}\n", error.what());
        }
        if (lines.may_wait() ? !out.flush() : !out.written())
            return 0;
    }
    out.finish();
    return Interruption::asked() ? 1 : 0;
}

} // namespace

void add_can_encode(CLI::App& can, std::function<int()>& chosen) {
    const auto flags = std::make_shared<EncodeFlags>();
    CLI::App* sub =
        can.add_subcommand("encode", "a frame from the values of signals, by DBC files; or frames from the lines of `can decode --json`");
    sub->add_option("MESSAGE", flags->words,
                    "message, then SIGNAL=VALUE of those that do not take their start values; a label is a value, too. - (or nothing): "
                    "JSON lines from standard input");
    add_database_flags(*sub, flags->databases);
    sub->add_option("--channel", flags->channel, "writes a line of a log with this channel, in place of 123#1122 as cansend takes it");
    sub->add_option("--stamp", flags->stamp, "time of the line in a log, in s");
    sub->add_option("--data", flags->data, "bytes in which the signals are changed, in place of the message's start values");
    sub->add_flag("--lenient", flags->lenient, "skip JSON lines of which no frame can be made, and tell them");
    sub->add_option("-o,--out", flags->out, "file in place of standard output");
    sub->add_flag("--force", flags->force, "lets --out replace a file that is there");
    sub->callback([flags, &chosen] { chosen = [flags] { return encode_frames(*flags); }; });
}

} // namespace fernlicht
