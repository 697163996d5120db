#include "runner/files/clean_text.h"
#include "runner/write/document.h"

#include <charconv>

namespace fernlicht {
namespace {

/// "−1.5" and "+1.5" as programs read them; nothing where the cell is no figure.
std::optional<std::string> plain_figure(std::string text) {
    if (text.starts_with("\u2212"))
        text.replace(0, 3, "-");
    else if (text.starts_with('+'))
        text.erase(0, 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(text) : std::nullopt;
}

} // namespace

std::string table_csv(const Table& table) {
    std::string out;
    const auto line = [&](const auto& entries, const auto& text_of) {
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            out += (i == 0 ? "" : ",") + (i < entries.size() ? text_of(entries[i]) : std::string());
        out += "\r\n";
    };
    line(table.columns, [](const Column& column) { return csv_text(head_of(column)); });
    for (const std::vector<Cell>& row : table.rows)
        line(row, [](const Cell& cell) { return plain_figure(cell.text).value_or(csv_text(cell.text)); });
    return out;
}

} // namespace fernlicht
