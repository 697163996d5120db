#include "scenarios/can/candump_cursor.h"
#include "scenarios/can/candump_log.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::uint32_t error_flag = 0x20000000U; ///< CAN_ERR_FLAG
constexpr std::int64_t max_seconds = 9223372035;  ///< so that nanoseconds fit 64 bits

class CandumpParser : private CandumpCursor {
  public:
    CandumpParser(std::string_view line, const InputError::Where& where, CandumpLine& out)
        : CandumpCursor(line, where), frame_(out.frame), style_(out.style) {}

    void parse() {
        if (!line_.empty() && line_.back() == '\r')
            line_.remove_suffix(1);
        if (peek() == '(') { // most lines
            seconds_stamp();
        } else {
            style_.form = CandumpStyle::Form::screen;
            style_.stamp_digits = 0;
            expect(" ", "a stamp '(seconds.digits)', or a blank as candump's screen form begins with");
            if (take_colour())
                style_.colour_mode = 3;
            if (peek() == '(')
                seconds_stamp();
        }
        channel_name();
        // Only the log form has '#' within the word that follows.
        const std::size_t word_end = std::min(line_.find(' ', at_), line_.size());
        const std::size_t mark = line_.substr(at_, word_end - at_).find('#');
        if (mark != std::string_view::npos) {
            if (style_.form == CandumpStyle::Form::screen)
                refuse(at_, "an identifier and a length, as the screen form has; the log form begins with '('");
            log_frame(mark);
        } else {
            screen_frame();
        }
        if (at_ != line_.size())
            refuse(at_, "the end of the line");
    }

  private:
    void seconds_stamp() {
        const std::size_t start = at_++;
        std::int64_t seconds = 0;
        const std::size_t digits = decimal(seconds, 18);
        if (digits == 4 && peek() == '-') {
            seconds = date_stamp(seconds);
            style_.date = true;
        } else {
            if (digits == 0)
                refuse(at_, "seconds since 1970 or since the log's beginning, or a date as 2026-11-22 12:38:19");
            style_.second_digits = static_cast<std::uint8_t>(digits);
        }
        if (seconds > max_seconds)
            refuse(start + 1, "seconds up to 9223372035 (April 2262)");
        expect(".", "a point between seconds and their fraction");
        std::int64_t fraction = 0;
        const std::size_t places = decimal(fraction, 10);
        if (places != 6 && places != 9)
            refuse(at_ - places, "6 or 9 digits behind the point, as candump writes");
        expect(")", "')' behind the stamp");
        style_.stamp_digits = static_cast<std::uint8_t>(places);
        frame_.time_ns = seconds * 1'000'000'000 + fraction * (places == 6 ? 1000 : 1);
    }

    bool take_colour() {
        if (peek() != '\33')
            return false;
        // Longest first: the fourth code begins all others.
        for (const std::uint8_t i : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{4}, std::uint8_t{5}, std::uint8_t{3}})
            if (take(candump_colours[i])) {
                style_.colour = i;
                return true;
            }
        refuse(at_, "one of candump's colours");
    }

    /// From the stamp's end, or behind the first blank, to behind the blanks that follow the name.
    void channel_name() {
        const bool stamped = style_.stamp_digits > 0;
        std::size_t blanks = take_blanks();
        if (blanks == 0)
            refuse(at_, stamped ? "a blank between stamp and channel" : "two blanks before the channel");
        if (style_.colour_mode == 0 && take_colour()) {
            style_.colour_mode = 2; // or 1, which ends before the identifier
            blanks += take_blanks();
        }
        const std::size_t from = at_;
        while (static_cast<unsigned char>(peek()) > ' ' && peek() != '\x7f')
            ++at_;
        const std::size_t length = at_ - from;
        if (length == 0)
            refuse(at_, "the name of a channel, as can0");
        if (length > 15)
            refuse(from, "the name of a channel, at most 15 bytes");
        frame_.channel.assign(line_, from, length);
        blanks_before_channel_ = blanks;
        if (take_screen_columns())
            return;
        blanks_behind_channel_ = take_blanks();
        if (blanks_behind_channel_ == 0)
            refuse(at_, "a blank and a frame behind the channel");
    }

    /// -x: "  TX B E", and the end of colour that comes only there. True when the identifier follows at once.
    bool take_screen_columns() {
        bool told = false;
        if (take("  TX ") || take("  RX ")) {
            style_.sent = line_[at_ - 3] == 'T';
            const char brs = peek(), esi = peek(2);
            if ((brs != '-' && brs != 'B') || peek(1) != ' ' || (esi != '-' && esi != 'E'))
                refuse(at_, "the flags of CAN FD, '- -' to 'B E'");
            frame_.bit_rate_switch = brs == 'B';
            frame_.error_state_indicator = esi == 'E';
            at_ += 3;
            told = true;
        }
        if (style_.colour_mode == 2 && take(candump_colour_off)) {
            style_.colour_mode = 1;
            told = true;
        }
        if (told)
            blanks_behind_channel_ = take_blanks();
        return told;
    }

    /// Identifier of `digits` hexadecimal digits.
    void identifier(std::size_t digits) {
        const std::size_t from = at_;
        if (digits == 5)
            refuse(from, "found a CAN XL frame, which is not supported",
                   "classic CAN or CAN FD: an identifier of 3 or 8 hexadecimal digits");
        bool is_one = digits == 3 || digits == 8;
        std::uint32_t id = 0;
        for (std::size_t i = 0; is_one && i < digits; ++i) {
            const std::uint8_t nibble = nibble_of(line_[from + i]);
            is_one = nibble <= 15;
            id = id << 4 | nibble;
        }
        if (!is_one)
            refuse(from, "an identifier of 3 or 8 hexadecimal digits");
        at_ += digits;
        if (digits == 3) {
            if (id > 0x7ff)
                refuse(from, "an identifier of 11 bits, up to 7FF");
        } else if (id > 0x3fffffffU) {
            refuse(from, "an identifier of 29 bits, up to 1FFFFFFF, or an error frame's, 20000000 to 3FFFFFFF");
        } else if (id & error_flag) {
            frame_.error = true;
        } else {
            frame_.extended = true;
        }
        frame_.id = id & 0x1fffffffU;
    }

    static bool is_fd_length(std::size_t length) {
        return length <= 8 || length == 12 || length == 16 || length == 20 || length == 24 || length == 32 || length == 48 || length == 64;
    }

    void raw_dlc() {
        const std::uint8_t dlc = nibble_of(peek());
        if (dlc < 9 || dlc > 15)
            refuse(at_, "a data length code from 9 to F");
        frame_.raw_dlc = dlc;
        ++at_;
    }

    void log_frame(std::size_t id_digits) {
        style_.form = CandumpStyle::Form::log;
        if (blanks_before_channel_ > 1)
            style_.channel_columns =
                static_cast<std::uint8_t>(std::min<std::size_t>(blanks_before_channel_ - 1 + frame_.channel.size(), 255));
        if (style_.colour_mode != 0 || style_.sent)
            refuse(at_, "an identifier and a length, as the screen form has");
        identifier(id_digits);
        ++at_; // #
        if (peek() == 'R' || peek() == 'r')
            log_remote();
        else
            log_data();
        if (take(" T"))
            style_.sent = true;
        else if (take(" R"))
            style_.sent = false;
    }

    void log_remote() {
        if (frame_.error)
            refuse(at_, "data: an error frame is no remote request");
        frame_.remote = true;
        ++at_;
        const std::uint8_t length = nibble_of(peek());
        if (length > 15)
            return;
        if (length > 8)
            refuse(at_, "a length from 0 to 8");
        frame_.length = length;
        ++at_;
        if (length == 8 && take("_"))
            raw_dlc();
    }

    void log_data() {
        const std::size_t from = at_;
        if (take("#")) {
            const std::uint8_t flags = nibble_of(peek());
            if (flags > 15)
                refuse(at_, "the flags of CAN FD, a hexadecimal digit");
            if (frame_.error)
                refuse(from - 1, "one '#': an error frame is classic CAN");
            ++at_;
            frame_.fd = true;
            frame_.bit_rate_switch = flags & 1;
            frame_.error_state_indicator = flags & 2;
            style_.more_fd_flags = flags & 12;
        }
        const std::size_t most = frame_.fd ? 64 : 8;
        std::size_t length = 0;
        while (at_ < line_.size()) {
            const bool dot = peek() == '.' && (length > 0 || frame_.fd);
            const std::uint8_t high = nibble_of(peek(dot)), low = nibble_of(peek(dot ? 2 : 1));
            if (high > 15 && !dot)
                break;
            if (high > 15 || low > 15)
                refuse(at_, "bytes of two hexadecimal digits each");
            if (length == most)
                refuse(from, frame_.fd ? "at most 64 bytes" : "at most 8 bytes, or '##' and flags for CAN FD");
            style_.dotted |= dot;
            frame_.data[length++] = static_cast<std::uint8_t>(high << 4 | low);
            at_ += dot ? 3 : 2;
        }
        if (peek() == '#' || peek() == ':')
            refuse(from, "found a CAN XL frame, which is not supported", "classic CAN or CAN FD");
        if (at_ < line_.size() && peek() != ' ' && !(peek() == '_' && length == 8 && !frame_.fd))
            refuse(at_, "bytes of two hexadecimal digits each");
        if (frame_.fd && !is_fd_length(length))
            refuse(from, fmt::format("found {} bytes", length), "0 to 8, 12, 16, 20, 24, 32, 48 or 64, as CAN FD has");
        frame_.length = static_cast<std::uint8_t>(length);
        if (take("_"))
            raw_dlc();
    }

    void screen_frame() {
        if (style_.form == CandumpStyle::Form::log)
            style_.narrow = true;
        style_.form = CandumpStyle::Form::screen;
        // candump: blank, stamp, two blanks, channel; or two blanks, channel. The rest pads the channel.
        const std::size_t usual = style_.stamp_digits > 0 ? 2 : 1;
        if (blanks_before_channel_ > usual)
            style_.channel_columns =
                static_cast<std::uint8_t>(std::min<std::size_t>(blanks_before_channel_ - usual + frame_.channel.size(), 255));
        std::size_t digits = 0;
        while (peek(digits) != ' ' && at_ + digits < line_.size())
            ++digits;
        const std::size_t from = at_;
        identifier(digits);
        style_.indented = digits == 3 && blanks_behind_channel_ >= 7;
        take_blanks();
        std::size_t length = screen_length();
        if (frame_.fd && frame_.error)
            refuse(from, "a length of one digit: an error frame is classic CAN");
        if (!frame_.fd) { // its columns said nothing of it
            frame_.bit_rate_switch = false;
            frame_.error_state_indicator = false;
        }
        frame_.length = static_cast<std::uint8_t>(length);
        const std::size_t blanks = take_blanks();
        if (take("remote request")) {
            if (frame_.fd || frame_.error)
                refuse(at_ - 14, "data: only classic CAN has remote requests");
            frame_.remote = true;
        } else {
            style_.binary = length == 0 && blanks > 40; // text stands behind the columns of 8 bytes, 3 or 9 each
            screen_data(length);
        }
        if (style_.colour_mode >= 2 && !take(candump_colour_off))
            style_.colour_stays_on = true;
    }

    /// "[8]", "{F}" or of CAN FD "[08]".
    std::size_t screen_length() {
        const std::size_t from = at_;
        const char open = peek();
        if (open == '{') {
            const std::uint8_t dlc = nibble_of(peek(1));
            if (dlc > 15 || peek(2) != '}')
                refuse(from, "a data length code, as {8}");
            at_ += 3;
            style_.shows_dlc = true;
            frame_.raw_dlc = dlc > 8 ? dlc : std::uint8_t{0};
            return std::min<std::size_t>(dlc, 8);
        }
        if (take("[")) {
            std::int64_t length = 0;
            const std::size_t digits = decimal(length, 4);
            const bool closed = take("]");
            if (closed && digits == 1 && length > 8)
                refuse(from, "a length from 0 to 8, or of CAN FD with two digits");
            if (closed && digits == 2 && !is_fd_length(static_cast<std::size_t>(length)))
                refuse(from, "a length of CAN FD: 00 to 08, 12, 16, 20, 24, 32, 48 or 64");
            if (closed && digits == 4)
                refuse(from, "found a CAN XL frame, which is not supported", "classic CAN or CAN FD");
            frame_.fd = digits == 2;
            if (closed && digits > 0 && digits < 3)
                return static_cast<std::size_t>(length);
        }
        refuse(from, "the length, as [8], or of CAN FD [08]");
    }

    void screen_data(std::size_t length) {
        style_.binary |= length > 0 && (peek(2) == '0' || peek(2) == '1');
        for (std::size_t i = 0; i < length; ++i) {
            if (i > 0) {
                const bool swap = peek() == '`';
                if ((peek() != ' ' && !swap) || (i > 1 && swap != style_.swapped))
                    refuse(at_, fmt::format("{} bytes, separated by blanks or all by '`'", length));
                style_.swapped = swap;
                ++at_;
            }
            if (!(style_.binary ? take_bits(frame_.data[i]) : take_byte(frame_.data[i])))
                refuse(at_, style_.binary ? fmt::format("{} bytes of eight binary digits each", length)
                                          : fmt::format("{} bytes of two hexadecimal digits each", length));
        }
        if (style_.swapped)
            std::reverse(frame_.data.begin(), frame_.data.begin() + static_cast<std::ptrdiff_t>(length));
        if (length > 8)
            return;
        const std::size_t padding_from = at_;
        const std::size_t padding = take_blanks();
        if (frame_.error) {
            expect("ERRORFRAME", "ERRORFRAME behind the data of an error frame");
        } else if (peek() == '\'' || peek() == '`') {
            ascii_column(length);
        } else if (length == 0 && padding == 0) {
            // the one blank behind [0] was taken as blanks before data
        } else if (at_ != line_.size() || padding > 0) {
            at_ = padding_from; // told by parse()
        }
    }

    void ascii_column(std::size_t length) {
        const char quote = peek();
        if (length > 1 && (quote == '`') != style_.swapped)
            refuse(at_, style_.swapped ? "text between '`'" : "text between \"'\"");
        style_.swapped = quote == '`';
        style_.ascii = true;
        const std::size_t from = at_++;
        for (std::size_t i = 0; i < length; ++i, ++at_) {
            const std::uint8_t byte = frame_.data[style_.swapped ? length - 1 - i : i];
            if (peek() != (byte > 0x1f && byte < 0x7f ? static_cast<char>(byte) : '.'))
                refuse(from, "the bytes' text, with '.' for what cannot be printed");
        }
        if (!take(std::string_view(&quote, 1)))
            refuse(from, "the bytes' text, with '.' for what cannot be printed");
    }

    CanFrame& frame_;
    CandumpStyle& style_;
    std::size_t blanks_before_channel_ = 0, blanks_behind_channel_ = 0;
};

} // namespace

void parse_candump_line(std::string_view line, const InputError::Where& where, CandumpLine& out) {
    out.style = {};
    std::string channel = std::move(out.frame.channel); // keeps its storage
    out.frame = {};
    out.frame.channel = std::move(channel);
    CandumpParser(line, where, out).parse();
}

CandumpLine parse_candump_line(std::string_view line, const InputError::Where& where) {
    CandumpLine out;
    CandumpParser(line, where, out).parse();
    return out;
}

} // namespace fernlicht
