#include "report_files.h"
#include "runner/files/clean_text.h"
#include "runner/write/document.h"
#include "runner/write/page_base.h"
#include "runner/write/plots/png.h"
#include "scenarios/values/files.h"

#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

constexpr std::size_t embedded_bytes = std::size_t{48} << 20; // of a page's pictures as they lie on disk

std::string capitalised(std::string text) {
    if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
        text.front() = static_cast<char>(text.front() - 'a' + 'A');
    return text;
}

/// Headings over neighbouring columns of one group; one over each run.
data groups_of(const Table& table) {
    data groups{List::list};
    for (std::size_t i = 0; i < table.columns.size();) {
        std::size_t end = i;
        while (end < table.columns.size() && table.columns[end].group == table.columns[i].group)
            ++end;
        data group;
        group.set("text", capitalised(clean_text(table.columns[i].group)));
        group.set("columns", fmt::format("{}", end - i));
        groups.push_back(group);
        i = end;
    }
    return groups;
}

data row_of(const std::vector<Cell>& row, const Table& table) {
    data part, cells{List::list};
    part.set("name", clean_text(row.front().text));
    for (std::size_t i = 1; i < row.size(); ++i) {
        data cell;
        const bool last_of_few = i + 1 == row.size() && row.size() < table.columns.size();
        cell.set("text", clean_text(row[i].text));
        cell.set("class", last_of_few || table.columns[i].words ? std::string("text") : std::string("n"));
        cell.set("spans", last_of_few);
        cell.set("columns", fmt::format("{}", table.columns.size() - i));
        cells.push_back(cell);
    }
    part.set("cells", cells);
    return part;
}

data table_part(const Table& table) {
    data part, heads{List::list}, rows{List::list};
    bool has_groups = false;
    for (const Column& column : table.columns) {
        data head;
        head.set("text", capitalised(clean_text(column.head)));
        head.set("unit", clean_text(column.unit));
        head.set("has_unit", !column.unit.empty());
        head.set("words", column.words);
        heads.push_back(head);
        has_groups = has_groups || !column.group.empty();
    }
    for (const std::vector<Cell>& row : table.rows)
        rows.push_back(row_of(row, table));
    part.set("caption", clean_text(table.caption));
    part.set("aside", table.aside);
    part.set("has_groups", has_groups);
    part.set("groups", groups_of(table));
    part.set("heads", heads);
    part.set("rows", rows);
    return part;
}

data plot_part(const Plot& plot) {
    data part, captions{List::list};
    for (const std::string& caption : plot.captions)
        captions.push_back(capitalised(clean_text(caption)));
    part.set("svg", plot_svg(plot));
    part.set("captions", captions);
    return part;
}

/// Pictures below `folder` are links, too; those that do not fit into the page any more are links alone.
data part_of(const PictureStrip& strip, const std::filesystem::path& folder, std::size_t& bytes_left) {
    data part, pictures{List::list};
    for (const Picture& picture : strip.pictures) {
        FilesRead ignored;
        const std::string bytes = read_file(folder / picture.file, ignored);
        data row;
        row.set("is_embedded", bytes.size() <= bytes_left);
        if (bytes.size() <= bytes_left) {
            bytes_left -= bytes.size();
            row.set("bytes", plots::base64(bytes));
        }
        row.set("caption", clean_text(picture.caption));
        row.set("is_link", std::filesystem::path(picture.file).is_relative());
        row.set("link", relative_link(picture.file));
        pictures.push_back(row);
    }
    part.set("title", clean_text(strip.title));
    part.set("pictures", pictures);
    return part;
}

data block_part(const DocumentPart& block, const std::filesystem::path& folder, std::size_t& bytes_left) {
    const auto* paragraph = std::get_if<std::string>(&block);
    const auto* table = std::get_if<Table>(&block);
    const auto* plot = std::get_if<Plot>(&block);
    const auto* strip = std::get_if<PictureStrip>(&block);
    data part = table ? table_part(*table) : plot ? plot_part(*plot) : strip ? part_of(*strip, folder, bytes_left) : data();
    part.set("is_paragraph", paragraph != nullptr);
    part.set("is_table", table != nullptr);
    part.set("is_plot", plot != nullptr);
    part.set("is_strip", strip != nullptr);
    part.set("text", paragraph ? clean_text(*paragraph) : "");
    return part;
}

} // namespace

std::string document_html(const Document& document, const Findings& findings, const std::filesystem::path& folder) {
    std::size_t bytes_left = embedded_bytes;
    data page, sections{List::list}, missing{List::list};
    for (const Section& section : document.sections) {
        data part, blocks{List::list};
        for (const DocumentPart& block : section.blocks)
            blocks.push_back(block_part(block, folder, bytes_left));
        part.set("has_title", !section.title.empty());
        part.set("title", short_text(section.title, 160));
        part.set("blocks", blocks);
        sections.push_back(part);
    }
    for (const std::string& what : findings.missing)
        missing.push_back(clean_text(what));
    page.set("style", std::string(report_file("report.css")));
    page.set("title", clean_text(document.title));
    page.set("has_started", !findings.context.started_utc.empty());
    page.set("started", clean_text(findings.context.started_utc));
    page.set("is_interrupted", !findings.interrupted.empty());
    page.set("interrupted", clean_text(findings.interrupted));
    page.set("missing", missing);
    page.set("sections", sections);
    page.set("context", context_part(findings.context));
    kainjow::mustache::mustache page_template{std::string(report_file("document.html.mustache"))};
    std::string html = page_template.render(page);
    if (!page_template.is_valid())
        throw std::logic_error("document.html.mustache: " + page_template.error_message());
    return html;
}

} // namespace fernlicht
