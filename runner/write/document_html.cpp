#include "report_files.h"
#include "runner/files/clean_text.h"
#include "runner/findings/plots/colour.h"
#include "runner/write/document.h"
#include "runner/write/page_base.h"
#include "runner/write/plots/png.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

constexpr std::size_t embedded_bytes = std::size_t{48} << 20; // of pictures as they lie on disk

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

/// The words of a cell, as the page has them.
std::string html_of(const Cell& cell, bool is_code = false) {
    std::string html = xml_text(cell.text);
    if (is_code)
        html = "<code class=\"command\">" + html + "</code>";
    if (!cell.link.empty())
        html = fmt::format("<a href=\"{}\">{}</a>", cell.link.front() == '#' ? xml_text(cell.link) : relative_link(cell.link), html);
    return html;
}

/// Class, hint, width, and for the browser's sorting a number or nothing.
std::string attributes_of(const Cell& cell, const Column& column, std::size_t width, bool sorts) {
    std::string text = column.words || width > 1 ? " class=\"text\"" : " class=\"n\"";
    if (sorts && !column.words)
        text += cell.value ? fmt::format(" data-key=\"{}\"", *cell.value) : " data-key=\"\"";
    if (!cell.hint.empty())
        text += " title=\"" + xml_text(cell.hint) + "\"";
    return width > 1 ? text + fmt::format(" colspan=\"{}\"", width) : text;
}

data row_of(const std::vector<Cell>& row, const Table& table, bool is_quiet) {
    data part, cells{List::list};
    for (std::size_t i = 0; i < row.size(); ++i) {
        data cell;
        const std::size_t width = i > 0 && i + 1 == row.size() ? table.columns.size() - i : 1; // the last of few takes the others' place
        cell.set("html", html_of(row[i], table.columns[i].code));
        cell.set("tag", i == 0 ? "th scope=\"row\"" : "td");
        cell.set("end", i == 0 ? "th" : "td");
        cell.set("attributes", i == 0 && !table.sortable ? "" : attributes_of(row[i], table.columns[i], width, table.sortable));
        cells.push_back(cell);
    }
    part.set("attributes", (table.sortable ? " id=\"" + xml_text(row.front().text) + "\"" : "") +
                               (is_quiet ? std::string(" class=\"quiet\"") : std::string()));
    part.set("cells", cells);
    return part;
}

data part_of(const std::string& paragraph, const std::filesystem::path&, std::size_t&) {
    data part;
    part.set("is_paragraph", true);
    part.set("text", clean_text(paragraph));
    return part;
}

data part_of(const Table& table, const std::filesystem::path&, std::size_t&) {
    data part, heads{List::list}, rows{List::list};
    bool has_groups = false;
    for (const Column& column : table.columns) {
        data head;
        head.set("text", table.sortable ? clean_text(column.head) : capitalised(clean_text(column.head)));
        head.set("unit", clean_text(column.unit));
        head.set("has_unit", !column.unit.empty());
        head.set("words", column.words);
        heads.push_back(head);
        has_groups = has_groups || !column.group.empty();
    }
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        rows.push_back(row_of(table.rows[i], table, std::ranges::count(table.quiet, i) > 0));
    part.set("is_table", true);
    part.set("caption", clean_text(table.caption));
    part.set("has_caption", !table.caption.empty() && !table.aside);
    part.set("aside", table.aside);
    part.set("sortable", table.sortable);
    part.set("has_groups", has_groups);
    part.set("groups", groups_of(table));
    part.set("heads", heads);
    part.set("rows", rows);
    return part;
}

data part_of(const Plot& plot, const std::filesystem::path&, std::size_t&) {
    data part, captions{List::list};
    for (const std::string& caption : plot.captions)
        captions.push_back(capitalised(clean_text(caption)));
    part.set("is_plot", true);
    part.set("svg", plot_svg(plot));
    part.set("beside", plot.beside);
    part.set("link", relative_link(place_of(plot)));
    part.set("captions", captions);
    return part;
}

data part_of(const Bullets& bullets, const std::filesystem::path&, std::size_t&) {
    data part, items{List::list};
    for (const Cell& item : bullets.items)
        items.push_back(html_of(item));
    part.set("is_bullets", true);
    part.set("caption", clean_text(bullets.caption));
    part.set("has_caption", !bullets.caption.empty());
    part.set("items", items);
    return part;
}

data part_of(const Cards& cards, const std::filesystem::path&, std::size_t&) {
    data part, list{List::list};
    for (const Card& card : cards) {
        data one;
        for (const auto& [name, text] : {std::pair("what", &card.what),
                                         {"figure", &card.figure},
                                         {"unit", &card.unit},
                                         {"beside", &card.beside},
                                         {"detail", &card.detail}})
            one.set(name, clean_text(*text));
        one.set("place", html_of(card.place));
        list.push_back(one);
    }
    part.set("is_cards", true);
    part.set("cards", list);
    return part;
}

/// Nothing where the page would grow too large.
data part_of(const PictureOverlay& pair, const std::filesystem::path& folder, std::size_t& bytes_left) {
    FilesRead ignored;
    const std::string over = read_file(folder / pair.paths[0], ignored), under = read_file(folder / pair.paths[1], ignored);
    data part;
    if (over.size() + under.size() > bytes_left)
        return part;
    bytes_left -= over.size() + under.size();
    part.set("is_pair", true);
    part.set("title", clean_text(pair.title));
    part.set("over", clean_text(pair.names[0]));
    part.set("under", clean_text(pair.names[1]));
    part.set("over_picture", plots::base64(over));
    part.set("under_picture", plots::base64(under));
    part.set("over_link", relative_link(pair.paths[0]));
    part.set("under_link", relative_link(pair.paths[1]));
    return part;
}

const char* mark_of(const std::string& verdict) {
    return verdict == "none" ? "–" : verdict == "pass" ? "✓" : verdict == "fail" ? "✗" : "?";
}

bool needs_script(const DocumentPart& block) {
    const auto* table = std::get_if<Table>(&block);
    return (table && table->sortable) || std::holds_alternative<PictureOverlay>(block);
}

} // namespace

std::string document_html(const Document& document, const Findings& findings, const std::filesystem::path& folder) {
    data page, sections{List::list}, missing{List::list};
    bool has_script = false;
    std::size_t bytes_left = embedded_bytes;
    for (const Section& section : document.sections) {
        data part, blocks{List::list};
        for (const DocumentPart& block : section.blocks) {
            blocks.push_back(std::visit([&](const auto& one) { return part_of(one, folder, bytes_left); }, block));
            has_script = has_script || needs_script(block);
        }
        part.set("is_verdict", !section.verdict.empty());
        part.set("verdict", section.verdict);
        part.set("mark", mark_of(section.verdict));
        part.set("has_title", !section.title.empty());
        part.set("title", short_text(section.title, 160));
        part.set("level", fmt::format("{}", section.level));
        part.set("blocks", blocks);
        sections.push_back(part);
    }
    page.set("sections", sections);
    page.set("has_script", has_script);
    return page;
}

std::string document_html(const Document& document, const Findings& findings, const std::filesystem::path& folder) {
    data page = sections_part(document.sections, folder), missing{List::list};
    for (const std::string& what : findings.missing)
        missing.push_back(clean_text(what));
    page.set("style", std::string(report_file("report.css")) + std::string(report_file("document.css")));
    page.set("has_script", has_script);
    page.set("script", std::string(report_file("document.js")));
    page.set("title", document.title);
    page.set("started", clean_text(findings.context.started_utc));
    page.set("is_interrupted", !findings.interrupted.empty());
    page.set("interrupted", clean_text(findings.interrupted));
    page.set("missing", missing);
    page.set("context", context_part(findings.context));
    return page_of("document.html.mustache", page);
}

} // namespace fernlicht
