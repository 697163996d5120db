#include "runner/commands/log_flags.h"

#include "runner/commands/flag_values.h"
#include "runner/play/interruption.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr const char* offset_form = "hours and minutes as +02:00 or -0330";

std::int64_t utc_offset_of(const std::string& text) {
    std::string digits;
    for (const char c : text.substr(text.empty() ? 0 : 1))
        if (c != ':')
            digits += c;
    const bool shaped = !text.empty() && (text[0] == '+' || text[0] == '-') && digits.size() == 4 && (text.size() == 5 || text[3] == ':');
    if (!shaped || digits.find_first_not_of("0123456789") != std::string::npos)
        refuse_flag("--utc-offset", text, offset_form);
    const int hours = std::stoi(digits.substr(0, 2)), minutes = std::stoi(digits.substr(2));
    if (hours > 14 || minutes > 59)
        refuse_flag("--utc-offset", text, offset_form);
    return (text[0] == '-' ? -1 : 1) * (hours * 3600 + minutes * 60);
}

} // namespace

void add_log_flags(CLI::App& command, LogFlags& flags) {
    command.add_option("--stamps", flags.stamps,
                       "what timestamps count from: absolute, zero (-tz) or delta (-td); detected where possible");
    command.add_option("--start", flags.start, "time of the first frame in s, where timestamps are zero or delta (default: 0)");
    command.add_option("--utc-offset", flags.utc_offset, "UTC offset of dates in timestamps (-tA), e.g. +02:00 (default: UTC)");
    command.add_flag("--lenient", flags.lenient, "skip lines that are not frames, and report how many");
}

std::int64_t nanoseconds_of(const char* flag, const std::string& text, bool negative) {
    const char* expected =
        negative ? "seconds, at most nine digits behind the point" : "seconds from 0 up, at most nine digits behind the point";
    const bool minus = negative && text.starts_with('-');
    const std::string digits = text.substr(minus || (negative && text.starts_with('+')) ? 1 : 0);
    const std::size_t point = std::min(digits.find('.'), digits.size());
    const std::string whole = digits.substr(0, point), fraction = point < digits.size() ? digits.substr(point + 1) : "0";
    const auto is_number = [](const std::string& number, std::size_t most) {
        return !number.empty() && number.size() <= most && number.find_first_not_of("0123456789") == std::string::npos;
    };
    if (!is_number(whole, 10) || !is_number(fraction, 9) || std::stoll(whole) > 9223372035)
        refuse_flag(flag, text, expected);
    const std::int64_t value = std::stoll(whole) * 1'000'000'000 + std::stoll(fraction + std::string(9 - fraction.size(), '0'));
    return minus ? -value : value;
}

CandumpReading reading_of(const LogFlags& flags) {
    CandumpReading reading;
    if (flags.stamps == "absolute")
        reading.stamps = CandumpStamps::absolute;
    else if (flags.stamps == "zero")
        reading.stamps = CandumpStamps::zero;
    else if (flags.stamps == "delta")
        reading.stamps = CandumpStamps::delta;
    else if (!flags.stamps.empty())
        refuse_flag("--stamps", flags.stamps, "absolute, zero or delta");
    if (!flags.start.empty())
        reading.first_ns = nanoseconds_of("--start", flags.start);
    if (!flags.utc_offset.empty())
        reading.utc_offset_s = utc_offset_of(flags.utc_offset);
    reading.stopped = Interruption::asked;
    return reading;
}

LenientStream::LenientStream(const std::filesystem::path& path, const LogFlags& flags)
    : log_(path, reading_of(flags)), lenient_(flags.lenient) {}

CandumpStream::What LenientStream::next() {
    for (;;) {
        try {
            const CandumpStream::What what = log_.next();
            if (what == CandumpStream::What::end && skipped_ > 1)
                fmt::print(stderr, "fernlicht: {}: {} lines skipped that are no frames\n", printable(log_.path().string(), 400), skipped_);
            return what;
        } catch (const InputError& error) {
            if (!lenient_ || error.where().line == 0)
                throw;
            if (skipped_++ == 0)
                fmt::print(stderr, "fernlicht: skipped: {}\n", error.what());
        }
    }
}

} // namespace fernlicht
