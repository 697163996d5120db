#include "runner/files/clean_text.h"
#include "runner/write/document.h"

#include <algorithm>

namespace fernlicht {
namespace {

/// Within a table of Markdown.
std::string markdown_cell(const std::string& text) {
    std::string out;
    for (const char c : text)
        out += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
    return out;
}

/// Each of the words that are typed, between backticks.
std::string code_cell(const std::string& words) {
    std::string out;
    for (std::size_t at = 0, end = 0; at < words.size(); at = end + 2) {
        end = std::min(words.find(", ", at), words.size());
        out += (at == 0 ? "`" : ", `") + markdown_cell(words.substr(at, end - at)) + "`";
    }
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
                   : table.columns[i].code ? " " + code_cell(row[i].text) + " |"
                                           : " " + markdown_cell(row[i].text) + " |";
        out += "\n";
    }
    return out;
}

std::string document_markdown(const Document& document) {
    std::string text = "# " + markdown_cell(clean_text(document.title)) + "\n";
    for (const Section& section : document.sections) {
        text += section.title.empty() ? "" : "\n## " + markdown_cell(clean_text(section.title)) + "\n";
        for (const DocumentPart& block : section.blocks)
            if (const auto* table = std::get_if<Table>(&block))
                text += "\n" + table_markdown(*table);
            else if (const auto* paragraph = std::get_if<std::string>(&block))
                text += "\n" + clean_text(*paragraph) + "\n";
    }
    return text;
}

} // namespace fernlicht
