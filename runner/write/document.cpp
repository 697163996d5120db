#include "runner/write/document.h"

#include "runner/files/clean_text.h"
#include "runner/files/output_folder.h"
#include "runner/write/aligned_table.h"
#include "runner/write/plots/png.h"
#include "runner/write/plots/svg.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <fmt/format.h>
#include <system_error>

namespace fernlicht {
namespace {

/// Within a table of Markdown.
std::string markdown_cell(const std::string& text) {
    std::string out;
    for (const char c : text)
        out += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
    return out;
}

/// Heads in up to three lines: group, head, unit.
std::string text_of(const Table& table) {
    if (table.aside)
        return "";
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
                after += (i == 0 ? "" : ", ") + row[i].text;
            after += ": " + row.back().text + "\n";
            continue;
        }
        std::vector<std::string>& line = lines.emplace_back();
        for (const Cell& cell : row)
            line.push_back(clean_text(cell.text.empty() ? "-" : cell.text));
    }
    return (table.caption.empty() ? "" : table.caption + "\n") + aligned_table(alignment, lines.front(), {lines.begin() + 1, lines.end()}) +
           after;
}

std::string text_of(const std::string& paragraph) { return clean_text(paragraph) + "\n"; }

std::string text_of(const Plot& plot) {
    std::string text;
    for (const std::string& caption : plot.captions)
        text += "  " + clean_text(caption) + "\n";
    return text;
}

std::string text_of(const Listing& listing) {
    std::string text = listing.caption.empty() ? "" : clean_text(listing.caption) + "\n";
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

std::string text_of(const PictureOverlay&) { return ""; }

std::string text_of(const PictureStrip&) { return ""; }

} // namespace

std::string head_of(const Column& column) {
    const std::string head = column.group.empty() ? column.head : column.group + " " + column.head;
    return column.unit.empty() ? head : head + ", " + column.unit;
}

std::string plot_svg(const Plot& plot) {
    return std::visit([](const auto& figure) { return plots::svg_of(figure); }, plot.figure);
}

std::string place_of(const Plot& plot) { return plot.name.find('/') == std::string::npos ? file_name_of(plot.name) : plot.name; }

std::string document_text(const Document& document) {
    std::string text;
    for (const Section& section : document.sections) {
        if (section.on_page_alone)
            continue;
        text += section.title.empty() ? "" : "\n" + clean_text(section.title) + "\n";
        for (const DocumentPart& block : section.blocks)
            text += std::visit([](const auto& part) { return text_of(part); }, block);
    }
    return text;
}

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
            out += i >= row.size() ? " |" : row[i].text.empty() ? " - |" : " " + markdown_cell(row[i].text) + " |";
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

std::string document_latex(const Document& document) {
    std::string out = "% \\usepackage{booktabs,graphicx}; the table is as wide as the text\n";
    for (const Section& section : document.sections)
        for (const DocumentPart& block : section.blocks)
            if (const auto* table = std::get_if<Table>(&block))
                out += "\\resizebox{\\linewidth}{!}{%\n" + table_latex(*table) + "}\n";
            else if (const auto* paragraph = std::get_if<std::string>(&block))
                out += "% " + clean_text(*paragraph) + "\n";
    return out;
}

void write_plot(const Plot& plot, const std::filesystem::path& place) {
    std::error_code ignored; // a folder that cannot be made shows in the first file below it
    std::filesystem::create_directories(place.parent_path(), ignored);
    const std::string svg = plot_svg(plot);
    if (!plot.png_alone)
        write_file(place.string() + ".svg", svg);
    write_file(place.string() + ".png", plots::png_of_svg(svg, plot.scale));
}

void write_document(const Document& document, const Findings& findings, const std::filesystem::path& folder, const std::string& stem,
                    TableFormat tables) {
    for (const Section& section : document.sections)
        for (const DocumentPart& block : section.blocks)
            if (const auto* plot = std::get_if<Plot>(&block))
                write_plot(*plot, folder / place_of(*plot));
    write_tables(document, folder, tables);
    write_file(folder / (stem + ".html"), document_html(document, findings, folder));
}

} // namespace fernlicht
