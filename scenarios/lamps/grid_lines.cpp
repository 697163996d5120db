#include "scenarios/lamps/grid_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_head_lines = 1000;

std::string_view delimiter_text(CellDelimiter delimiter) {
    return std::array<std::string_view, 4>{"commas", "semicolons", "tabs", "blanks"}[static_cast<std::size_t>(delimiter)];
}

std::string shown_cell(std::string_view text) { return printable(std::string(text.substr(0, 200))); }

bool begins_with_mark(std::string_view line, const std::string& mark) { return !mark.empty() && trimmed(line).starts_with(trimmed(mark)); }

} // namespace

GridLines::GridLines(const std::filesystem::path& path, std::string_view text, const GridRecipe& recipe)
    : path_(path), recipe_(recipe), lines_(text) {
    LineReader lines(text);
    for (std::string_view line; head_.size() < most_head_lines && lines.next(line);)
        head_.push_back(line);
    check_required();
    skip_header();
}

void GridLines::skip_header() {
    std::string_view line;
    if (!recipe_.header_ends_with.empty()) {
        do
            if (!lines_.next(line))
                throw InputError({path_, lines_.number(), 0, {}}, "no line ends the header",
                                 fmt::format("one that begins with '{}', as the recipe says", shown_cell(recipe_.header_ends_with)));
        while (!begins_with_mark(line, recipe_.header_ends_with));
    }
    for (int i = 0; i < recipe_.header_lines; ++i)
        if (!lines_.next(line))
            throw InputError({path_, lines_.number(), 0, {}}, "the file ends in its header",
                             fmt::format("{} lines of it, as the recipe says, then the grid", recipe_.header_lines));
}

void GridLines::check_required() const {
    for (const HeaderWord& required : recipe_.require)
        if (const std::string_view found = header_word(required.line, required.word, "require"); found != required.is)
            throw InputError({path_, static_cast<std::size_t>(required.line), 0, fmt::format("word {}", required.word)},
                             fmt::format("found '{}'", shown_cell(found)),
                             fmt::format("'{}'{}, as the recipe says", shown_cell(required.is),
                                         required.means.empty() ? "" : fmt::format(" ({})", shown_cell(required.means))));
}

std::string_view GridLines::header_word(int line, int word, const std::string& asked_by) const {
    const auto at = static_cast<std::size_t>(line);
    const InputError::Where where{path_, std::min(at, head_.size()), 0, {}};
    if (at > head_.size())
        throw InputError(where, "the file ends here", fmt::format("line {}, which `{}` of the recipe names", line, asked_by));
    // A comma is part of a number with a decimal comma.
    const std::vector<std::string_view> words =
        words_of(head_[at - 1], recipe_.decimal == DecimalSign::comma ? std::string_view(" \t;:=") : std::string_view(" \t,;:="));
    if (static_cast<std::size_t>(word) > words.size())
        throw InputError(where, fmt::format("found {} words", words.size()),
                         fmt::format("word {}, which `{}` of the recipe names", word, asked_by));
    return words[static_cast<std::size_t>(word) - 1];
}

bool GridLines::next(std::vector<std::string_view>& cells) {
    std::string_view line;
    do
        if (!lines_.next(line) || begins_with_mark(line, recipe_.ends_before))
            return false;
    while (trimmed(line).empty() || begins_with_mark(line, recipe_.comment));
    cells = cells_of(line, std::array{',', ';', '\t', ' '}[static_cast<std::size_t>(recipe_.delimiter)]);
    saw_point_ = saw_point_ || line.find('.') != std::string_view::npos;
    return true;
}

std::optional<double> GridLines::number_in_cell(std::string_view cell) const {
    const bool comma = recipe_.decimal == DecimalSign::comma;
    if (cell.size() > 100 || cell.find(comma ? '.' : ',') != std::string_view::npos)
        return std::nullopt;
    std::string text(cell);
    if (comma)
        std::ranges::replace(text, ',', '.');
    const std::optional<double> value = fernlicht::number_in(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

double GridLines::number_of(std::string_view cell, const InputError::Where& where) const {
    if (const std::optional<double> value = number_in_cell(cell))
        return *value;
    const bool comma = recipe_.decimal == DecimalSign::comma, other = cell.find(comma ? '.' : ',') != std::string_view::npos;
    throw InputError(where, fmt::format("found '{}'", shown_cell(cell)),
                     other ? fmt::format("a number with a decimal {}, as the recipe says", comma ? "comma" : "point")
                           : std::string("a finite number"));
}

double GridLines::number_of(const std::vector<std::string_view>& cells, std::size_t at, std::string_view what) const {
    if (const std::optional<double> value = number_in_cell(cells[at]))
        return *value;
    return number_of(cells[at], where(fmt::format("{} in column {}", what, at + 1)));
}

double GridLines::number_of(const HeaderNumber& number, const char* name) const {
    if (number.number)
        return *number.number;
    return number_of(header_word(number.line, number.word, name), {path_, static_cast<std::size_t>(number.line), 0, name});
}

std::string GridLines::doubt() const {
    return recipe_.delimiter == CellDelimiter::comma && !saw_point_ ? "; numbers with decimal commas cannot be separated by commas" : "";
}

std::string_view GridLines::delimiter_name() const { return delimiter_text(recipe_.delimiter); }

} // namespace fernlicht
