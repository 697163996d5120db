#include "runner/files/clean_text.h"
#include "runner/write/document.h"

namespace fernlicht {
namespace {

/// Within a table of Markdown.
std::string markdown_cell(const std::string& text) {
    std::string out;
    for (const char c : text)
        out += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
    return out;
}

/// As it is typed, between backticks; of a list each item.
std::string code_cell(const std::string& words, bool is_list) {
    std::string out = "`" + markdown_cell(words) + "`";
    for (std::size_t at = out.find(", "); is_list && at != std::string::npos; at = out.find(", ", at + 4))
        out.replace(at, 2, "`, `");
    return out;
}

} // namespace

std::string table_markdown(const Table& table) {
    std::string out = "|", line = "|";
    for (const Column& column : table.columns) {
        out += " " + head_of(column) + " |";
        line += column.words ? "---|" : "--:|";
    }
    out += "\n" + line + "\n";
    for (const std::vector<Cell>& row : table.rows) {
        out += "|";
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            out += i >= row.size()         ? " |"
                   : row[i].text.empty()   ? (table.prose ? "  |" : " - |")
                   : table.columns[i].code ? " " + code_cell(row[i].text, table.prose) + " |"
                                           : " " + markdown_cell(row[i].text) + " |";
        out += "\n";
    }
    return out;
}

std::string document_markdown(const Document& document) {
    std::string text = "# " + markdown_cell(clean_text(document.title)) + "\n";
    for (const Section& section : document.sections) {
        text += section.title.empty() ? ""
                                      : "\n" + std::string(static_cast<std::size_t>(section.level), '#') + " " +
                                            markdown_cell(clean_text(section.title)) + "\n";
        for (const DocumentPart& block : section.blocks)
            if (const auto* table = std::get_if<Table>(&block))
                text += "\n" + table_markdown(*table);
            else if (const auto* matrix = std::get_if<PlaceMatrix>(&block))
                text += "\n" + clean_text(matrix->caption) + ":\n\n" + table_markdown(table_of(*matrix));
            else if (const auto* paragraph = std::get_if<std::string>(&block))
                text += "\n" + clean_text(*paragraph) + "\n";
            else if (const auto* listing = std::get_if<Listing>(&block)) {
                text += listing->caption.empty() ? "\n" : "\n" + clean_text(listing->caption) + ":\n\n";
                for (const Cell& item : listing->items)
                    text += "- " + clean_text(item.text) + "\n";
            }
    }
    return text;
}

} // namespace fernlicht
