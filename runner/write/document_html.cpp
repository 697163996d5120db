#include "runner/files/clean_text.h"
#include "runner/write/document.h"
#include "runner/write/page_base.h"
#include "runner/write/plots/colour.h"

#include <fmt/format.h>

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

void mark(data& part, const std::optional<std::size_t>& series) {
    part.set("has_colour", series.has_value());
    part.set("colour", plots::css(plots::lamp_colour(series.value_or(0))));
}

/// The first cell of a row names it; long words wrap, figures do not.
data cell_part(const std::vector<Cell>& row, std::size_t i, const Table& table) {
    constexpr std::size_t longest_on_a_line = 30;
    const bool last_of_few = i > 0 && i + 1 == row.size() && row.size() < table.columns.size();
    const Column& column = table.columns[i];
    const bool wraps = column.code || (!row[i].value && row[i].text.size() > longest_on_a_line);
    data cell;
    cell.set("text", clean_text(row[i].text));
    cell.set("name", i == 0);
    cell.set("code", column.code && !last_of_few && !row[i].text.empty());
    cell.set("class", std::string(last_of_few || (wraps && i > 0) ? "text" : wraps ? "reading" : column.words || i == 0 ? "words" : "n"));
    cell.set("spans", last_of_few);
    cell.set("columns", fmt::format("{}", table.columns.size() - i));
    mark(cell, row[i].series);
    return cell;
}

data table_part(const Table& table) {
    data part, heads{List::list}, rows{List::list};
    bool has_groups = false;
    for (const Column& column : table.columns) {
        data head;
        head.set("text", column.series ? clean_text(column.head) : capitalised(clean_text(column.head)));
        head.set("unit", clean_text(column.unit));
        head.set("has_unit", !column.unit.empty());
        head.set("words", column.words);
        mark(head, column.series);
        heads.push_back(head);
        has_groups = has_groups || !column.group.empty();
    }
    for (const std::vector<Cell>& row : table.rows) {
        data cells{List::list};
        for (std::size_t i = 0; i < row.size(); ++i)
            cells.push_back(cell_part(row, i, table));
        data line;
        line.set("cells", cells);
        rows.push_back(line);
    }
    part.set("caption", clean_text(table.caption));
    part.set("has_caption", !table.caption.empty());
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
    part.set("beside", plot.beside);
    return part;
}

/// As markup, with what stands between backticks as code.
std::string sentence_html(const std::string& text) {
    const std::string safe = xml_text(text);
    std::string out;
    for (std::size_t at = 0; at < safe.size();) {
        const std::size_t open = safe.find('`', at), close = open == std::string::npos ? open : safe.find('`', open + 1);
        if (close == std::string::npos)
            return out + safe.substr(at);
        out += safe.substr(at, open - at) + "<code>" + safe.substr(open + 1, close - open - 1) + "</code>";
        at = close + 1;
    }
    return out;
}

data block_part(const DocumentPart& block) {
    const auto* paragraph = std::get_if<std::string>(&block);
    const auto* table = std::get_if<Table>(&block);
    const auto* plot = std::get_if<Plot>(&block);
    const auto* listing = std::get_if<Listing>(&block);
    data part = table ? table_part(*table) : plot ? plot_part(*plot) : data(), items{List::list};
    if (listing)
        for (const std::string& item : listing->items)
            items.push_back(sentence_html(item));
    part.set("is_paragraph", paragraph != nullptr);
    part.set("is_table", table != nullptr);
    part.set("is_plot", plot != nullptr);
    part.set("is_listing", listing != nullptr);
    part.set("html", paragraph ? sentence_html(*paragraph) : "");
    part.set("items", items);
    return part;
}

} // namespace

data sections_part(const std::vector<Section>& all) {
    data page, sections{List::list};
    for (const Section& section : all) {
        data part, blocks{List::list};
        for (const DocumentPart& block : section.blocks)
            blocks.push_back(block_part(block, folder, bytes_left));
        part.set("has_title", !section.title.empty());
        part.set("title", short_text(section.title, 160));
        part.set("level", fmt::format("{}", section.level));
        part.set("blocks", blocks);
        sections.push_back(part);
    }
    page.set("sections", sections);
    return page;
}

std::string document_html(const Document& document, const Findings& findings) {
    data page = sections_part(document.sections), missing{List::list};
    for (const std::string& what : findings.missing)
        missing.push_back(clean_text(what));
    page.set("title", document.title);
    page.set("started", clean_text(findings.context.started_utc));
    page.set("is_interrupted", !findings.interrupted.empty());
    page.set("interrupted", clean_text(findings.interrupted));
    page.set("missing", missing);
    page.set("context", context_part(findings.context));
    return page_of("document.html.mustache", page);
}

} // namespace fernlicht
