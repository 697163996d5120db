// A place in a line of candump: what stands there, taken step by step, and refused with its column.
#pragma once

#include "scenarios/values/errors.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace fernlicht {

/// Value of a hexadecimal digit, 255 for what is none.
inline constexpr std::array<std::uint8_t, 256> candump_nibbles = [] {
    std::array<std::uint8_t, 256> table{};
    table.fill(255);
    for (std::uint8_t i = 0; i < 10; ++i)
        table['0' + std::size_t{i}] = i;
    for (std::uint8_t i = 0; i < 6; ++i)
        table['A' + std::size_t{i}] = table['a' + std::size_t{i}] = static_cast<std::uint8_t>(10 + i);
    return table;
}();

inline std::uint8_t nibble_of(char c) { return candump_nibbles[static_cast<unsigned char>(c)]; }
inline bool is_decimal(char c) { return c >= '0' && c <= '9'; }

class CandumpCursor {
  public:
    /// `line` and `where` outlive it.
    CandumpCursor(std::string_view line, const InputError::Where& where) : line_(line), where_(where) {}

  protected:
    char peek(std::size_t ahead = 0) const { return at_ + ahead < line_.size() ? line_[at_ + ahead] : '\0'; }

    bool take(std::string_view text) {
        if (!line_.substr(at_).starts_with(text))
            return false;
        at_ += text.size();
        return true;
    }

    void expect(std::string_view text, const char* expected) {
        if (!take(text))
            refuse(at_, expected);
    }

    std::size_t take_blanks() {
        const std::size_t from = at_;
        while (peek() == ' ')
            ++at_;
        return at_ - from;
    }

    [[noreturn]] void refuse(std::size_t column, const std::string& expected) const {
        std::string_view rest = line_.substr(std::min(column, line_.size()));
        if (const std::size_t blank = rest.find(' '); blank != std::string_view::npos && blank > 0)
            rest = rest.substr(0, blank);
        refuse(column, rest.empty() ? "found the end of the line" : "found '" + printable(std::string(rest)) + "'", expected);
    }
    [[noreturn]] void refuse(std::size_t column, const std::string& found, const std::string& expected) const {
        InputError::Where where = where_;
        where.column = column + 1;
        throw InputError(std::move(where), found, expected);
    }

    /// Decimal digits from here on, at most `most` of them; their number.
    std::size_t decimal(std::int64_t& value, std::size_t most) {
        const std::size_t from = at_;
        value = 0;
        while (is_decimal(peek()) && at_ - from < most)
            value = value * 10 + (line_[at_++] - '0');
        return at_ - from;
    }

    std::int64_t fixed_decimal(std::size_t digits, std::int64_t least, std::int64_t greatest, const char* expected) {
        const std::size_t from = at_;
        std::int64_t value = 0;
        if (decimal(value, digits) != digits || value < least || value > greatest)
            refuse(from, expected);
        return value;
    }

    /// Of "2026-11-22 12:38:19" from the first '-' on, as UTC: seconds since 1970.
    std::int64_t date_stamp(std::int64_t year) {
        using namespace std::chrono;
        const std::size_t from = at_ - 4;
        ++at_;
        const std::int64_t month_number = fixed_decimal(2, 1, 12, "a month from 01 to 12");
        expect("-", "'-' behind the month");
        const std::int64_t day_number = fixed_decimal(2, 1, 31, "a day from 01 to 31");
        const year_month_day date(std::chrono::year(static_cast<int>(year)), month(static_cast<unsigned>(month_number)),
                                  day(static_cast<unsigned>(day_number)));
        if (!date.ok() || year < 1970 || year > 2261)
            refuse(from, "a day that there is, from 1970 to 2261");
        expect(" ", "a blank between date and time");
        const std::int64_t hours = fixed_decimal(2, 0, 23, "hours from 00 to 23");
        expect(":", "':' behind the hours");
        const std::int64_t minutes = fixed_decimal(2, 0, 59, "minutes from 00 to 59");
        expect(":", "':' behind the minutes");
        const std::int64_t seconds = fixed_decimal(2, 0, 60, "seconds from 00 to 60");
        return sys_days(date).time_since_epoch().count() * std::int64_t{86400} + hours * 3600 + minutes * 60 + seconds;
    }

    /// Two hexadecimal digits. False, and nothing taken, where there are none.
    bool take_byte(std::uint8_t& byte) {
        const std::uint8_t high = nibble_of(peek()), low = nibble_of(peek(1));
        if (high > 15 || low > 15)
            return false;
        byte = static_cast<std::uint8_t>(high << 4 | low);
        at_ += 2;
        return true;
    }

    /// Eight binary digits. False, and nothing taken, where there are none.
    bool take_bits(std::uint8_t& byte) {
        unsigned value = 0;
        for (std::size_t i = 0; i < 8; ++i) {
            if (peek(i) != '0' && peek(i) != '1')
                return false;
            value = value << 1 | (peek(i) == '1' ? 1U : 0U);
        }
        byte = static_cast<std::uint8_t>(value);
        at_ += 8;
        return true;
    }

    std::string_view line_;
    const InputError::Where& where_;
    std::size_t at_ = 0;
};

} // namespace fernlicht
