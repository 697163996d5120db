#include "scenarios/can/dbc/dbc_cursor.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

bool dbc_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\f' || c == '\v'; }
bool ends_dbc_word(char c) { return dbc_blank(c) || std::string_view(":;,|@()[]\"").find(c) != std::string_view::npos; }
bool dbc_digit(char c) { return c >= '0' && c <= '9'; }

} // namespace

void DbcCursor::skip() {
    while (at_ < text_.size()) {
        if (text_[at_] == '\n')
            ++line_;
        if (dbc_blank(text_[at_]))
            ++at_;
        else if (text_.compare(at_, 2, "//") == 0)
            at_ = std::min(text_.find('\n', at_), text_.size());
        else
            return;
    }
}

void DbcCursor::advance_to(std::size_t end) {
    at_ = end;
    taken_line_ = line_;
}

bool DbcCursor::at_end() {
    skip();
    return at_ == text_.size();
}

bool DbcCursor::line_goes_on() {
    if (line_ != taken_line_) // a look ahead has left it already
        return false;
    while (at_ < text_.size() && text_[at_] != '\n' && dbc_blank(text_[at_]))
        ++at_;
    return at_ < text_.size() && text_[at_] != '\n' && text_.compare(at_, 2, "//") != 0;
}

bool DbcCursor::has(char c) { return !at_end() && text_[at_] == c; }

bool DbcCursor::take(char c) {
    const bool there = has(c);
    if (there)
        advance_to(at_ + 1);
    return there;
}

void DbcCursor::expect(char c, const char* where) {
    if (!take(c))
        refuse(fmt::format("'{}' {}", c, where));
}

std::string_view DbcCursor::peek() {
    skip();
    std::size_t end = at_;
    while (end < text_.size() && !ends_dbc_word(text_[end]))
        ++end;
    return std::string_view(text_).substr(at_, end - at_);
}

std::string DbcCursor::word(const char* what) {
    const std::string_view next = peek();
    if (next.empty())
        refuse(what);
    advance_to(at_ + next.size());
    return std::string(next);
}

bool DbcCursor::has_text() { return has('"'); }

std::string DbcCursor::text(const char* what) {
    if (!has_text())
        refuse(what);
    const std::size_t begin_line = line_;
    std::string result;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
        if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] == '"')
            ++at_;
        line_ += text_[at_] == '\n';
        result += text_[at_];
    }
    if (at_ == text_.size())
        refuse_at(begin_line, "a text that does not end", "a closing \"");
    advance_to(at_ + 1);
    return result;
}

bool DbcCursor::has_number() { return !at_end() && (dbc_digit(text_[at_]) || text_[at_] == '-' || text_[at_] == '+' || text_[at_] == '.'); }

std::string_view DbcCursor::number_text() {
    skip();
    std::size_t end = at_;
    const auto digits = [&] {
        while (end < text_.size() && dbc_digit(text_[end]))
            ++end;
    };
    if (end < text_.size() && (text_[end] == '-' || text_[end] == '+'))
        ++end;
    for (const std::string_view word : {"nan", "NaN", "NAN", "inf", "Inf", "INF"}) // as printf and others write them
        if (text_.compare(end, word.size(), word) == 0)
            return std::string_view(text_).substr(at_, end + word.size() - at_);
    digits();
    if (end < text_.size() && text_[end] == '.') {
        ++end;
        digits();
    }
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
        std::size_t exponent = end + 1;
        exponent += exponent < text_.size() && (text_[exponent] == '-' || text_[exponent] == '+');
        if (exponent < text_.size() && dbc_digit(text_[exponent])) {
            end = exponent;
            digits();
        }
    }
    return std::string_view(text_).substr(at_, end - at_);
}

double DbcCursor::number(const char* what) {
    const std::string_view next = number_text();
    const char* begin = next.data() + (next.starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [end, error] = std::from_chars(begin, next.data() + next.size(), value);
    if (error == std::errc::result_out_of_range)
        refuse(fmt::format("{} that a double can hold", what));
    if (error != std::errc{} || end != next.data() + next.size())
        refuse(what);
    advance_to(at_ + next.size());
    if (at_ < text_.size() && text_[at_] == '#') { // as old Windows libraries write what is not a number or infinite
        advance_to(at_ + peek().size());
        return std::numeric_limits<double>::quiet_NaN();
    }
    return value;
}

std::string DbcCursor::number_as_written(const char* what) {
    skip();
    const std::size_t begin = at_;
    number(what);
    return text_.substr(begin, at_ - begin);
}

std::uint64_t DbcCursor::whole(const char* what, std::uint64_t greatest) {
    skip();
    std::size_t end = at_;
    while (end < text_.size() && dbc_digit(text_[end]))
        ++end;
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(text_.data() + at_, text_.data() + end, value);
    if (error != std::errc{} || stop != text_.data() + end || value > greatest)
        refuse(fmt::format("{}, a whole number from 0 to {}", what, greatest));
    advance_to(end);
    return value;
}

void DbcCursor::skip_past(char c) {
    const std::size_t begin_line = line_;
    while (!at_end()) {
        if (take(c))
            return;
        if (has_text())
            text("a text");
        else
            advance_to(at_ + 1);
    }
    refuse_at(begin_line, "no end of what begins here", fmt::format("'{}'", c));
}

void DbcCursor::refuse(const std::string& expected) {
    if (at_end())
        refuse_at(line_, "the end of the file", expected);
    std::string found = std::string(peek());
    if (found.empty())
        found = text_.substr(at_, 1);
    refuse_at(line_, fmt::format("'{}'", printable(found)), expected);
}

void DbcCursor::refuse_at(std::size_t line, const std::string& found, const std::string& expected) const {
    throw InputError({file_, line, 0, {}}, "found " + found, expected);
}

} // namespace fernlicht
