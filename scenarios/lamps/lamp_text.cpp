#include "scenarios/lamps/lamp_text.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {

bool LineReader::next(std::string_view& line) {
    if (rest_.empty())
        return false;
    const std::size_t end = rest_.find_first_of("\r\n");
    line = rest_.substr(0, end);
    if (end == std::string_view::npos)
        rest_ = {};
    else
        rest_.remove_prefix(end + (rest_.substr(end).starts_with("\r\n") ? 2 : 1));
    ++number_;
    return true;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks{" \t\v\f\0", 5};
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos)
        return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string uppercase(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'a' && c <= 'z')
            c = static_cast<char>(c - 'a' + 'A');
    return out;
}

std::optional<double> number_in(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

double finite_number(std::string_view text, const InputError::Where& where) {
    const std::optional<double> value = number_in(text);
    if (!value || !std::isfinite(*value))
        throw InputError(where, fmt::format("found '{}'", printable(std::string(trimmed(text.substr(0, 200))))), "a finite number");
    return *value;
}

long whole_number(std::string_view text, long least, long most, const InputError::Where& where) {
    const std::optional<double> value = number_in(text);
    if (!value || *value != std::floor(*value) || *value < static_cast<double>(least) || *value > static_cast<double>(most))
        throw InputError(where, fmt::format("found '{}'", printable(std::string(trimmed(text.substr(0, 200))))),
                         fmt::format("a whole number from {} to {}", least, most));
    return static_cast<long>(*value);
}

} // namespace fernlicht
