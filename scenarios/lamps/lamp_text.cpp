#include "scenarios/lamps/lamp_text.h"

#include "scenarios/values/files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::string_view blanks{" \t\v\f\0", 5};

[[noreturn]] void refuse_comma(const InputError::Where& where, std::string_view text, const std::string& pointed) {
    throw InputError(where, "has decimal commas", fmt::format("points: write {} for {}", pointed, text));
}

/// What `text` is with a point for its decimal comma ("1.5" for "1,5"); nullopt when it is no number with one.
std::optional<std::string> with_point(std::string_view text) {
    text = trimmed(text.substr(0, 100));
    const std::size_t comma = text.find(',');
    const auto digit = [&](std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
    if (comma == std::string_view::npos || comma == 0 || !digit(comma - 1) || !digit(comma + 1))
        return std::nullopt;
    std::string out(text);
    out[comma] = '.';
    return number_in(out) ? std::optional(out) : std::nullopt;
}

std::string_view unquoted(std::string_view cell) {
    cell = trimmed(cell);
    return cell.size() >= 2 && cell.front() == '"' && cell.back() == '"' ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

} // namespace

std::string lamp_text(const std::string& bytes, const std::filesystem::path& path) {
    if (is_utf16(bytes))
        throw InputError({path, 0, 0, {}}, "is encoded in UTF-16", "UTF-8 or Windows-1252: save it as one of these");
    return to_utf8(bytes);
}

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
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos)
        return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string_view> words_of(std::string_view line, std::string_view separators) {
    std::vector<std::string_view> words;
    for (std::size_t begin = 0, end = 0; (begin = line.find_first_not_of(separators, end)) != std::string_view::npos;) {
        end = std::min(line.find_first_of(separators, begin), line.size());
        words.push_back(line.substr(begin, end - begin));
    }
    return words;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
    std::vector<std::string_view> cells;
    if (separator == ' ') {
        cells = words_of(line);
        std::ranges::transform(cells, cells.begin(), unquoted);
        return cells;
    }
    line = separator == '\t' ? line : trimmed(line);
    for (;;) {
        const std::size_t end = line.find(separator);
        cells.push_back(unquoted(line.substr(0, end)));
        if (end == std::string_view::npos)
            break;
        line.remove_prefix(end + 1);
    }
    if (cells.size() > 1 && cells.back().empty())
        cells.pop_back();
    return cells;
}

std::string uppercase(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'a' && c <= 'z')
            c = static_cast<char>(c - 'a' + 'A');
    return out;
}

std::string on_one_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    return text;
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
    if (const auto pointed = value ? std::nullopt : with_point(text))
        refuse_comma(where, trimmed(text), *pointed);
    if (!value || !std::isfinite(*value))
        throw InputError(where, fmt::format("found '{}'", printable(std::string(trimmed(text.substr(0, 200))))), "a finite number");
    return *value;
}

double number_above_zero(std::string_view text, const InputError::Where& where) {
    const double number = finite_number(text, where);
    if (!(number > 0.0))
        throw InputError(where, fmt::format("found {}", number), "a number above 0");
    return number;
}

long whole_number(std::string_view text, long least, long most, const InputError::Where& where) {
    const std::optional<double> value = number_in(text);
    if (!value || *value != std::floor(*value) || *value < static_cast<double>(least) || *value > static_cast<double>(most))
        throw InputError(where, fmt::format("found '{}'", printable(std::string(trimmed(text.substr(0, 200))))),
                         fmt::format("a whole number from {} to {}", least, most));
    return static_cast<long>(*value);
}

void refuse_decimal_commas(std::string_view text, std::size_t lines_before, const std::filesystem::path& path) {
    struct Found {
        InputError::Where where;
        std::string_view number;
        std::string pointed;
    };
    std::optional<Found> first;
    bool beside_others = false; // "0,90" alone on its line may as well be two numbers
    LineReader lines(text);
    for (std::string_view line; lines.next(line);) {
        const std::vector<std::string_view> numbers = words_of(line);
        bool comma = false;
        for (const std::string_view number : numbers) {
            if (const auto pointed = with_point(number)) {
                comma = true;
                if (!first)
                    first = {{path, lines_before + lines.number(), static_cast<std::size_t>(number.data() - line.data()) + 1, {}},
                             number,
                             *pointed};
            } else if (number.find_first_of(",.") != std::string_view::npos) {
                return; // commas separate here, or points are known
            }
        }
        beside_others = beside_others || (comma && numbers.size() > 1);
    }
    if (first && beside_others)
        refuse_comma(first->where, first->number, first->pointed);
}

void refuse_lone_commas(std::string_view text, std::size_t lines_before, const std::filesystem::path& path) {
    LineReader lines(text);
    for (std::string_view line; lines.next(line);)
        for (const std::string_view number : words_of(line))
            if (const auto pointed = with_point(number))
                throw InputError({path, lines_before + lines.number(), static_cast<std::size_t>(number.data() - line.data()) + 1, {}},
                                 fmt::format("found '{}' in a table with more intensities than its angles ask for", number),
                                 fmt::format("{}, if that is a decimal comma", *pointed));
}

} // namespace fernlicht
