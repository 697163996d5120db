#include "runner/findings/document.h"

#include "runner/findings/figures.h"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace fernlicht {
namespace {

Table rows_of(const WorkPrecision& diagram) {
    Table table{diagram.name,
                "The same as a table",
                {{"#"},
                 {.head = "way", .words = true},
                 {diagram.error_name, diagram.error_unit},
                 {"from … to", diagram.error_unit},
                 {"floor", diagram.error_unit},
                 {diagram.time_name},
                 {"textures", "MiB"},
                 {.head = "standing", .words = true}},
                {},
                true,
                true};
    const std::vector<Standing> standing = standings(diagram.rows);
    for (std::size_t i = 0; i < diagram.rows.size(); ++i) {
        const WorkPrecisionRow& row = diagram.rows[i];
        const auto figure = [](bool there, double value) { return there ? Cell(two_digits(value), value) : Cell(""); };
        table.rows.push_back({fmt::format("{}", i + 1), row.label + (row.note.empty() ? "" : " (" + row.note + ")"),
                              row.error ? Cell(claimed_text(row, ""), row.error->value) : Cell("not measured"),
                              row.error ? two_digits(row.error->low) + " … " + two_digits(row.error->high) : "",
                              figure(row.error && row.floor > 0.0, row.floor),
                              row.seconds ? Cell(time_text(row.seconds->value), row.seconds->value) : Cell("not measured"),
                              row.bytes ? Cell(mib_text(*row.bytes), static_cast<double>(*row.bytes)) : Cell(""),
                              row.why_not.empty() ? standing_text(standing[i]) : row.why_not});
    }
    return table;
}

/// Who is on the front, and who is beaten by whom.
std::string front_words(const WorkPrecision& diagram) {
    const std::vector<Standing> standing = standings(diagram.rows);
    std::string front, beaten;
    const auto add = [](std::string& list, const std::string& what) { list += (list.empty() ? "" : "; ") + what; };
    for (std::size_t i = 0; i < standing.size(); ++i) {
        const WorkPrecisionRow& row = diagram.rows[i];
        if (standing[i].on_front)
            add(front, fmt::format("{} ({}, {})", row.label, claimed_text(row, diagram.error_unit), time_text(row.seconds->value)));
        else if (standing[i].dominated_by)
            add(beaten,
                fmt::format("{} by {}{}", row.label, diagram.rows[*standing[i].dominated_by].label, standing[i].surely ? "" : ", perhaps"));
    }
    if (front.empty())
        return "nothing was measured";
    return "on the front: " + front + (beaten.empty() ? "" : ". Beaten: " + beaten);
}

} // namespace

std::vector<Column> columns_of(const std::string& line) {
    std::vector<Column> columns;
    std::istringstream items(line);
    for (std::string item; std::getline(items, item, '|');) {
        Column& column = columns.emplace_back();
        column.code = item.ends_with('`');
        column.words = column.code || item.ends_with('<');
        if (column.words)
            item.pop_back();
        if (const std::size_t at = item.find(" ["); at != std::string::npos) {
            column.unit = item.substr(at + 2, item.size() - at - 3);
            item.erase(at);
        }
        if (const std::size_t at = item.find(": "); at != std::string::npos) {
            column.group = item.substr(0, at);
            item.erase(0, at + 2);
        }
        column.head = item;
    }
    return columns;
}

Table table_of(const PlaceMatrix& matrix) {
    Table table{matrix.name, matrix.caption, {{.head = matrix.corner, .words = true}}, {}};
    std::vector<bool> changes;
    for (std::size_t i = 0; i < matrix.columns.size(); ++i) {
        changes.push_back(std::ranges::any_of(matrix.rows, [&](const auto& row) { return !row.second[i].standing.empty(); }));
        table.columns.push_back({.head = matrix.columns[i].text, .unit = matrix.unit, .series = matrix.columns[i].series});
        if (changes.back())
            for (const auto& [head, unit] :
                 {std::pair("change", matrix.unit.c_str()), {"change", "%"}, {"±", matrix.open_by.c_str()}, {"is", ""}})
                table.columns.push_back({.head = head, .unit = unit, .words = std::string_view(head) == "is"});
    }
    for (const auto& [name, entries] : matrix.rows) {
        std::vector<Cell>& row = table.rows.emplace_back(std::vector<Cell>{name});
        for (std::size_t i = 0; i < entries.size(); ++i) {
            row.push_back(entries[i].value);
            if (changes[i])
                row.insert(row.end(), {entries[i].change, entries[i].share, entries[i].open, entries[i].standing});
        }
    }
    return table;
}

Section work_precision_section(const WorkPrecision& diagram) {
    Plot plot{diagram.name, diagram, diagram.notes, 1.5};
    plot.captions.insert(plot.captions.begin(), front_words(diagram));
    for (const WorkPrecisionRow& row : diagram.rows)
        if (!row.measured())
            plot.captions.push_back(fmt::format("Not in the diagram: {}, {}", row.label, row.why_not));
    return {diagram.title, {plot, rows_of(diagram)}};
}

} // namespace fernlicht
