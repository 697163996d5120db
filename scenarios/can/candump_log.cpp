#include "scenarios/can/candump_log.h"

#include "scenarios/can/candump_stream.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <iterator>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr char upper_hex[] = "0123456789ABCDEF";

void append_byte(std::string& out, std::uint8_t byte) {
    out += upper_hex[byte >> 4];
    out += upper_hex[byte & 15];
}

void append_padded(std::string& out, std::int64_t value, int digits) { fmt::format_to(std::back_inserter(out), "{:0{}}", value, digits); }

void append_date(std::string& out, std::int64_t seconds) {
    using namespace std::chrono;
    const std::int64_t days_since = seconds / 86400, rest = seconds % 86400;
    const year_month_day date{sys_days{days{static_cast<int>(days_since)}}};
    fmt::format_to(std::back_inserter(out), "{:04}-{:02}-{:02} {:02}:{:02}:{:02}", static_cast<int>(date.year()),
                   static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), rest / 3600, rest / 60 % 60, rest % 60);
}

void append_stamp(std::string& out, std::int64_t time_ns, const CandumpStyle& style) {
    const std::int64_t seconds = time_ns / 1'000'000'000, fraction = time_ns % 1'000'000'000;
    out += '(';
    style.date ? append_date(out, seconds) : append_padded(out, seconds, style.second_digits);
    out += '.';
    append_padded(out, style.stamp_digits == 9 ? fraction : fraction / 1000, style.stamp_digits == 9 ? 9 : 6);
    out += ')';
}

void append_channel(std::string& out, const std::string& channel, const CandumpStyle& style) {
    if (style.channel_columns > channel.size())
        out.append(style.channel_columns - channel.size(), ' ');
    out += channel;
}

void append_identifier(std::string& out, const CanFrame& frame) {
    const std::uint32_t id = frame.error ? frame.id | 0x20000000U : frame.id;
    for (int shift = frame.error || frame.extended ? 28 : 8; shift >= 0; shift -= 4)
        out += upper_hex[id >> shift & 15];
}

void append_log_form(std::string& out, const CanFrame& frame, const CandumpStyle& style) {
    append_stamp(out, frame.time_ns, style.stamp_digits == 0 ? CandumpStyle{} : style);
    out += ' ';
    append_channel(out, frame.channel, style);
    out += ' ';
    append_identifier(out, frame);
    out += '#';
    if (frame.remote) {
        out += 'R';
        if (frame.length > 0)
            out += upper_hex[frame.length & 15];
    } else {
        if (frame.fd) {
            out += '#';
            out += upper_hex[(style.more_fd_flags & 12) | (frame.error_state_indicator ? 2 : 0) | (frame.bit_rate_switch ? 1 : 0)];
        }
        bool dot = frame.fd && style.dotted;
        for (const std::uint8_t byte : frame.bytes()) {
            if (dot)
                out += '.';
            append_byte(out, byte);
            dot = style.dotted;
        }
    }
    if (!frame.fd && frame.length == 8 && frame.raw_dlc > 8) {
        out += '_';
        out += upper_hex[frame.raw_dlc & 15];
    }
    if (style.sent)
        out += *style.sent ? " T" : " R";
}

void append_screen_data(std::string& out, const CanFrame& frame, const CandumpStyle& style) {
    const std::size_t columns = style.binary ? 9 : 3;
    for (std::size_t i = 0; i < frame.length; ++i) {
        const std::uint8_t byte = frame.data[style.swapped ? frame.length - 1 - i : i];
        out += style.swapped && i > 0 ? '`' : ' ';
        if (!style.binary) {
            append_byte(out, byte);
            continue;
        }
        for (int bit = 7; bit >= 0; --bit)
            out += byte >> bit & 1 ? '1' : '0';
    }
    if (frame.length > 8)
        return;
    const std::size_t free = columns * (8U - frame.length);
    if (frame.error) {
        out.append(free + 3, ' ');
        out += "ERRORFRAME";
    } else if (style.ascii) {
        const char quote = style.swapped ? '`' : '\'';
        out.append(free + 3, ' ');
        out += quote;
        for (std::size_t i = 0; i < frame.length; ++i) {
            const std::uint8_t byte = frame.data[style.swapped ? frame.length - 1 - i : i];
            out += byte > 0x1f && byte < 0x7f ? static_cast<char>(byte) : '.';
        }
        out += quote;
    }
}

void append_screen_form(std::string& out, const CanFrame& frame, const CandumpStyle& style) {
    const std::string_view colour = candump_colours[std::min<std::size_t>(style.colour, candump_colours.size() - 1)];
    if (!style.narrow)
        out += ' ';
    if (style.colour_mode > 2)
        out += colour;
    if (style.stamp_digits > 0) {
        append_stamp(out, frame.time_ns, style);
        out += ' ';
    }
    out += ' ';
    if (style.colour_mode == 1 || style.colour_mode == 2)
        out += colour;
    append_channel(out, frame.channel, style);
    if (style.sent) {
        out += *style.sent ? "  TX " : "  RX ";
        out += frame.bit_rate_switch ? 'B' : '-';
        out += ' ';
        out += frame.error_state_indicator ? 'E' : '-';
    }
    if (style.colour_mode == 1)
        out += candump_colour_off;
    out += "  ";
    const bool wide = frame.extended || frame.error;
    if (!wide && style.indented)
        out.append(5, ' ');
    append_identifier(out, frame);
    if (frame.fd) {
        out += "  [";
        append_padded(out, frame.length, 2);
        out += "] ";
    } else if (style.shows_dlc) {
        out += "   {";
        out += upper_hex[frame.length == 8 && frame.raw_dlc > 8 ? frame.raw_dlc & 15 : frame.length & 15];
        out += "} ";
    } else {
        out += "   [";
        out += upper_hex[frame.length & 15];
        out += "] ";
    }
    if (frame.remote)
        out += " remote request";
    else
        append_screen_data(out, frame, style);
    if (style.colour_mode > 1 && !style.colour_stays_on)
        out += candump_colour_off;
}

} // namespace

void append_candump_line(std::string& out, const CanFrame& frame, const CandumpStyle& style) {
    if (frame.time_ns < 0)
        throw std::invalid_argument("append_candump_line: time before 0");
    style.form == CandumpStyle::Form::log ? append_log_form(out, frame, style) : append_screen_form(out, frame, style);
}

std::string candump_line(const CanFrame& frame, const CandumpStyle& style) {
    std::string out;
    append_candump_line(out, frame, style);
    return out;
}

std::vector<CanFrame> read_candump(const std::filesystem::path& path, FilesRead& opened) {
    const std::string text = read_file(path, opened);
    CandumpStream stream(path, text);
    std::vector<CanFrame> frames;
    frames.reserve(text.size() / 45);
    for (CandumpStream::What what; (what = stream.next()) != CandumpStream::What::end;)
        if (what == CandumpStream::What::frame)
            frames.push_back(stream.line().frame);
    return frames;
}

} // namespace fernlicht
