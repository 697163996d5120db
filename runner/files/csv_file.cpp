#include "runner/files/csv_file.h"

#include "scenarios/lamps/lamp_text.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// From `at` on, which then stands behind the field and its comma.
std::string next_field(std::string_view text, std::size_t& at, bool& ends_line, const std::filesystem::path& file) {
    const std::string_view before = text.substr(0, at);
    std::string field;
    bool quoted = false;
    for (; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '"' && quoted && text.substr(at + 1, 1) == "\"")
            field += text[at++];
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == ',' || c == '\n'))
            break;
        else if (quoted || c != '\r')
            field += c;
    }
    if (quoted)
        throw InputError({file, static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1, 0, {}}, "found a quote that does not end",
                         "a quote at the end of the field");
    ends_line = at >= text.size() || text[at] == '\n';
    ++at;
    if (field.size() > 1 && field[0] == '\'' && std::string_view("=+-@").find(field[1]) != std::string_view::npos)
        field.erase(0, 1);
    return field;
}

} // namespace

CsvFile read_csv(const std::filesystem::path& file) {
    FilesRead opened;
    return csv_in(read_file(file, opened, std::size_t{1} << 30), file);
}

CsvFile csv_in(std::string_view text, const std::filesystem::path& file) {
    CsvFile csv{file, {}, {}};
    for (std::size_t at = 0, line = 1; at < text.size(); ++line) {
        std::vector<std::string> fields;
        for (bool ends_line = false; !ends_line;)
            fields.push_back(next_field(text, at, ends_line, file));
        if (line == 1) {
            csv.heads = std::move(fields);
            continue;
        }
        if (fields.size() != csv.heads.size())
            throw InputError({file, line, 0, {}}, fmt::format("found {} fields", fields.size()),
                             fmt::format("{}, as the first line has", csv.heads.size()));
        csv.rows.push_back(std::move(fields));
    }
    return csv;
}

std::size_t CsvFile::column(std::string_view head) const {
    const auto found = std::ranges::find(heads, head);
    if (found == heads.end())
        throw InputError({file, 1, 0, {}}, fmt::format("has no column '{}'", head));
    return static_cast<std::size_t>(found - heads.begin());
}

double CsvFile::number(std::size_t row, std::size_t column) const {
    const std::optional<double> number = number_in(rows[row][column]);
    if (!number || !std::isfinite(*number))
        refuse(row, column, "a number");
    return *number;
}

int CsvFile::count(std::size_t row, std::size_t column) const {
    const std::string& text = rows[row][column];
    int count = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size() || count < 0)
        refuse(row, column, "a whole number of at least 0");
    return count;
}

void CsvFile::refuse(std::size_t row, std::size_t column, const std::string& expected) const {
    throw InputError({file, row + 2, 0, heads[column]}, "found '" + printable(rows[row][column]) + "'", expected);
}

} // namespace fernlicht
