#include "runner/files/clean_text.h"
#include "runner/write/document.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Code points, as fmt pads by them.
std::size_t characters(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// What is meant as it is typed stands in quotes there.
std::string cell_text(const std::string& text) {
    std::string shown = clean_text(text);
    std::ranges::replace(shown, '`', '\'');
    return shown;
}

/// Of a table of prose: a line for each cell, behind its head, and rows apart.
std::string entries_of(const Table& table) {
    std::string text;
    for (const std::vector<Cell>& row : table.rows) {
        std::vector<std::vector<std::string>> lines;
        for (std::size_t i = 0; i < row.size(); ++i)
            if (!row[i].text.empty())
                lines.push_back(
                    {head_of(table.columns[i]), cell_text(row[i].text + (row[i].hint.empty() ? "" : " (" + row[i].hint + ")"))});
        text += (text.empty() ? "" : "\n") + aligned_table("<<", lines);
    }
    return text;
}

/// Heads in up to three lines: group, head, unit.
std::string lines_of(const Table& table) {
    std::string alignment, after;
    std::vector<std::vector<std::string>> lines;
    for (const auto part : {&Column::group, &Column::head, &Column::unit})
        if (std::ranges::any_of(table.columns, [&](const Column& column) { return !(column.*part).empty(); })) {
            std::vector<std::string>& line = lines.emplace_back();
            for (const Column& column : table.columns)
                line.push_back(column.*part);
        }
    for (const Column& column : table.columns)
        alignment += column.words ? '<' : '>';
    for (const std::vector<Cell>& row : table.rows) {
        if (row.size() < table.columns.size()) { // words in place of figures stand below the table
            for (std::size_t i = 0; i + 1 < row.size(); ++i)
                after += (i == 0 ? "" : ", ") + cell_text(row[i].text);
            after += ": " + cell_text(row.back().text) + "\n";
            continue;
        }
        std::vector<std::string>& line = lines.emplace_back();
        for (const Cell& cell : row)
            line.push_back(cell_text(cell.text.empty() ? "-" : cell.text));
    }
    return aligned_table(alignment, lines) + after;
}

std::string text_of(const Table& table) { return table.off_terminal ? "" : table_text(table); }

std::string text_of(const PlaceMatrix& matrix) { return table_text(table_of(matrix)); }

std::string text_of(const std::string& paragraph) { return clean_text(paragraph) + "\n"; }

std::string text_of(const Plot& plot) {
    std::string text;
    for (const std::string& caption : plot.captions)
        text += "  " + cell_text(caption) + "\n";
    return text;
}

std::string text_of(const Listing& listing) {
    std::string text = listing.caption.empty() ? "" : cell_text(listing.caption) + "\n";
    for (const Cell& item : listing.items)
        text += "  " + clean_text(item.text) + "\n";
    return text;
}

std::string text_of(const Cards& cards) {
    std::string text;
    for (const Card& card : cards)
        text += clean_text(fmt::format("{}: {} {}{}{}; {}; {}", card.what, card.figure, card.unit, card.beside.empty() ? "" : " ",
                                       card.beside, card.detail, card.place.text)) +
                "\n";
    return text;
}

std::string text_of(const auto&) { return ""; } // pictures

} // namespace

std::string aligned_table(const std::string& alignment, const std::vector<std::vector<std::string>>& lines) {
    std::string text;
    std::vector<std::size_t> widths(alignment.size(), 0);
    for (const auto& cells : lines)
        for (std::size_t i = 0; i < widths.size(); ++i)
            widths[i] = std::max(widths[i], characters(cells.at(i)));
    for (const auto& cells : lines) {
        std::string line;
        for (std::size_t i = 0; i < widths.size(); ++i)
            line += (i == 0 ? "" : "  ") +
                    (alignment.at(i) == '>' ? fmt::format("{:>{}}", cells[i], widths[i]) : fmt::format("{:<{}}", cells[i], widths[i]));
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

std::string table_text(const Table& table) {
    return (table.caption.empty() ? "" : cell_text(table.caption) + "\n") + (table.prose ? entries_of(table) : lines_of(table));
}

std::string document_text(const Document& document) {
    std::string text;
    for (const Section& section : document.sections) {
        if (section.on_page_alone)
            continue;
        std::string body;
        for (const DocumentPart& block : section.blocks)
            body += std::visit([](const auto& part) { return text_of(part); }, block);
        if (body.empty() && !section.blocks.empty()) // pictures alone
            continue;
        text += (section.title.empty() ? "" : "\n" + clean_text(section.title) + "\n") + body;
    }
    return text;
}

} // namespace fernlicht
