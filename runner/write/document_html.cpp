#include "report_files.h"
#include "runner/files/clean_text.h"
#include "runner/findings/plots/colour.h"
#include "runner/write/document.h"
#include "runner/write/page_base.h"
#include "runner/write/thumbnail.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

constexpr std::size_t embedded_bytes = std::size_t{32} << 20;

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

std::string swatch(const std::optional<std::size_t>& series) {
    return series ? fmt::format("<span class=\"swatch\" style=\"background:{}\"></span>", plots::css(plots::lamp_colour(*series))) : "";
}

std::string linked_html(const Cell& cell, const std::string& html) {
    if (cell.link.empty())
        return html;
    return fmt::format("<a href=\"{}\">{}</a>", cell.link.front() == '#' ? xml_text(cell.link) : relative_link(cell.link), html);
}

/// Class, hint, width, and for the browser's sorting a number or nothing. Long words wrap, figures do not.
std::string attributes_of(const std::vector<Cell>& row, std::size_t i, const Table& table) {
    constexpr std::size_t longest_on_a_line = 30;
    const Cell& cell = row[i];
    const Column& column = table.columns[i];
    const std::size_t width = i > 0 && i + 1 == row.size() ? table.columns.size() - i : 1; // the last of few takes the others' place
    const bool wraps = column.code || (!cell.value && cell.text.size() > longest_on_a_line);
    const bool is_text = width > 1 || (table.sortable ? column.words : wraps && i > 0);
    std::string text = fmt::format(" class=\"{}\"", is_text                    ? "text"
                                                    : wraps && !table.sortable ? "reading"
                                                    : column.words || i == 0   ? "words"
                                                                               : "n");
    if (table.sortable && !column.words)
        text += cell.value ? fmt::format(" data-key=\"{}\"", *cell.value) : " data-key=\"\"";
    if (!cell.hint.empty())
        text += " title=\"" + xml_text(cell.hint) + "\"";
    return width > 1 ? text + fmt::format(" colspan=\"{}\"", width) : text;
}

/// As markup: a study's page has tens of thousands of cells, and as parts of a template they would take ten times the memory.
void append_row(std::string& html, const std::vector<Cell>& row, const Table& table, bool is_quiet) {
    html += "<tr" + (table.led_to ? " id=\"" + xml_text(row.front().text) + "\"" : "") + (is_quiet ? " class=\"quiet\">" : ">");
    for (std::size_t i = 0; i < row.size(); ++i) {
        const bool is_code = table.columns[i].code && !row[i].text.empty() && (i + 1 < row.size() || row.size() == table.columns.size());
        const std::string text = is_code ? "<code>" + xml_text(row[i].text) + "</code>" : sentence_html(row[i].text);
        html += (i == 0 ? "<th scope=\"row\"" : "<td") + attributes_of(row, i, table) + ">" + swatch(row[i].series) +
                linked_html(row[i], text) + (i == 0 ? "</th>" : "</td>");
    }
    html += "</tr>\n";
}

data part_of(const std::string& paragraph, const std::filesystem::path&, std::size_t&) {
    data part;
    part.set("is_paragraph", true);
    part.set("html", sentence_html(paragraph));
    return part;
}

data part_of(const Table& table, const std::filesystem::path&, std::size_t&) {
    data part, heads{List::list};
    std::string rows;
    bool has_groups = false;
    for (const Column& column : table.columns) {
        data head;
        head.set("text", table.sortable || column.series ? clean_text(column.head) : capitalised(clean_text(column.head)));
        head.set("swatch", swatch(column.series));
        head.set("unit", clean_text(column.unit));
        head.set("has_unit", !column.unit.empty());
        head.set("words", column.words);
        heads.push_back(head);
        has_groups = has_groups || !column.group.empty();
    }
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        append_row(rows, table.rows[i], table, std::ranges::count(table.quiet, i) > 0);
    part.set("is_table", true);
    part.set("caption", sentence_html(clean_text(table.caption)));
    part.set("has_caption", !table.caption.empty() && !table.folded);
    part.set("folded", table.folded);
    part.set("sortable", table.sortable);
    part.set("has_groups", has_groups);
    part.set("groups", groups_of(table));
    part.set("heads", heads);
    part.set("rows", rows);
    return part;
}

const char* mark_of(const MatrixEntry& entry) {
    return entry.standing.empty()        ? ""
           : entry.standing == "better"  ? "▲ "
           : entry.standing == "worse"   ? "▼ "
           : entry.standing == "changed" ? "◆ "
                                         : "≈ ";
}

/// "▲ +9.1 (+21 %) better  aim ±6.3"
std::string standing_html(const MatrixEntry& entry, const std::string& open_by) {
    return fmt::format(" <span><span aria-hidden=\"true\">{}</span>{}{} {}{}</span>", mark_of(entry), xml_text(entry.change),
                       entry.share.empty() ? "" : " (" + xml_text(entry.share) + " %)", xml_text(entry.standing),
                       entry.open.empty() ? "" : fmt::format("<small> {} ±{}</small>", xml_text(open_by), xml_text(entry.open)));
}

data part_of(const PlaceMatrix& matrix, const std::filesystem::path&, std::size_t&) {
    data part, heads{List::list};
    std::string rows;
    for (const Cell& column : matrix.columns)
        heads.push_back(swatch(column.series) + xml_text(column.text));
    for (const auto& [name, entries] : matrix.rows) {
        rows += fmt::format("<tr><th scope=\"row\" title=\"{}\">{}</th>", xml_text(name.hint), xml_text(name.text));
        for (const MatrixEntry& entry : entries)
            rows += fmt::format("<td class=\"{}\" style=\"--shade:{:.2f}\" title=\"{}\"><b>{}</b>{}</td>",
                                entry.shade > 0.0   ? "gain"
                                : entry.shade < 0.0 ? "loss"
                                                    : "even",
                                std::abs(entry.shade), xml_text(entry.value.hint), linked_html(entry.value, xml_text(entry.value.text)),
                                entry.standing.empty() ? "" : standing_html(entry, matrix.open_by));
        rows += "</tr>\n";
    }
    part.set("is_matrix", true);
    part.set("caption", xml_text(capitalised(clean_text(matrix.caption))));
    part.set("unit", clean_text(matrix.unit));
    part.set("corner", clean_text(capitalised(matrix.corner)));
    part.set("narrow", matrix.columns.size() <= 3);
    part.set("dense", matrix.rows.size() > 8);
    part.set("heads", heads);
    part.set("rows", rows);
    return part;
}

data part_of(const Plot& plot, const std::filesystem::path& folder, std::size_t&) {
    data part, captions{List::list};
    for (const std::string& caption : plot.captions)
        captions.push_back(capitalised(clean_text(caption)));
    part.set("is_plot", true);
    part.set("svg", plot_svg(plot));
    part.set("beside", plot.beside);
    constexpr double narrow_px = 450.0;
    const auto* const figure = std::get_if<plots::Figure>(&plot.figure);
    part.set("small", figure && figure->width_px < narrow_px);
    part.set("place", plot.places.empty()
                          ? std::string()
                          : fmt::format(" data-place=\"{}\" data-rank=\"{}\"", xml_text(fmt::format("{}", fmt::join(plot.places, " | "))),
                                        plot.rank.value_or(0.0)));
    part.set("has_files", !folder.empty());
    part.set("link", relative_link(place_of(plot)));
    part.set("captions", captions);
    return part;
}

data part_of(const Listing& listing, const std::filesystem::path&, std::size_t&) {
    data part, items{List::list};
    for (const Cell& item : listing.items)
        items.push_back(linked_html(item, sentence_html(item.text)));
    part.set("is_listing", true);
    part.set("caption", sentence_html(clean_text(listing.caption)));
    part.set("has_caption", !listing.caption.empty());
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
        one.set("place", swatch(card.place.series) + linked_html(card.place, xml_text(card.place.text)));
        list.push_back(one);
    }
    part.set("is_cards", true);
    part.set("cards", list);
    return part;
}

/// Nothing where the page would grow too large.
data part_of(const PictureOverlay& pair, const std::filesystem::path& folder, std::size_t& bytes_left) {
    FilesRead ignored;
    constexpr int most_px = 480; // a strip is 24 rem wide
    const std::string over = embedded_picture(read_file(folder / pair.paths[0], ignored), most_px),
                      under = embedded_picture(read_file(folder / pair.paths[1], ignored), most_px);
    data part;
    if (over.size() + under.size() > bytes_left)
        return part;
    bytes_left -= over.size() + under.size();
    part.set("is_pair", true);
    part.set("title", clean_text(pair.title));
    part.set("over", clean_text(pair.names[0]));
    part.set("under", clean_text(pair.names[1]));
    part.set("over_picture", over);
    part.set("under_picture", under);
    part.set("over_link", relative_link(pair.paths[0]));
    part.set("under_link", relative_link(pair.paths[1]));
    return part;
}

/// Pictures below `folder` are links, too; those that do not fit into the page any more are links alone.
data part_of(const PictureStrip& strip, const std::filesystem::path& folder, std::size_t& bytes_left) {
    data part, pictures{List::list};
    for (const Picture& picture : strip.pictures) {
        FilesRead ignored;
        const std::string embedded = embedded_picture(read_file(folder / picture.file, ignored));
        data row;
        row.set("is_embedded", embedded.size() <= bytes_left);
        if (embedded.size() <= bytes_left) {
            bytes_left -= embedded.size();
            row.set("embedded", embedded);
        }
        row.set("caption", clean_text(picture.caption));
        row.set("is_link", std::filesystem::path(picture.file).is_relative());
        row.set("link", relative_link(picture.file));
        pictures.push_back(row);
    }
    part.set("is_strip", true);
    part.set("title", clean_text(strip.title));
    part.set("pictures", pictures);
    return part;
}

const char* mark_of(const std::string& verdict) { return verdict == "none" ? "" : verdict == "pass" ? "✓" : verdict == "fail" ? "✗" : "?"; }

bool needs_script(const DocumentPart& block) {
    const auto* table = std::get_if<Table>(&block);
    const auto* plot = std::get_if<Plot>(&block);
    return (table && table->sortable) || (plot && !plot->places.empty()) || std::holds_alternative<PictureOverlay>(block);
}

} // namespace

data sections_part(const std::vector<Section>& all, const std::filesystem::path& folder) {
    data page, sections{List::list};
    bool has_script = false;
    std::size_t bytes_left = embedded_bytes;
    for (const Section& section : all) {
        data part, blocks{List::list};
        for (const DocumentPart& block : section.blocks) {
            blocks.push_back(std::visit([&](const auto& one) { return part_of(one, folder, bytes_left); }, block));
            has_script = has_script || needs_script(block);
        }
        part.set("is_verdict", !section.verdict.empty());
        part.set("is_answer", section.is_answer);
        part.set("is_folded", section.folded);
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

void document_html(const Document& document, const Findings& findings, const std::filesystem::path& folder, const TakePiece& take) {
    data page = sections_part(document.sections, folder), missing{List::list};
    for (const std::string& what : findings.missing)
        missing.push_back(clean_text(what));
    page.set("script", std::string(report_file("document.js")));
    page.set("title", clean_text(document.title));
    page.set("has_started", !findings.context.started_utc.empty());
    page.set("started", clean_text(findings.context.started_utc));
    page.set("is_interrupted", !findings.interrupted.empty());
    page.set("interrupted", clean_text(findings.interrupted));
    page.set("missing", missing);
    if (!findings.context.command.empty()) // else it was not measured by a call that could be repeated
        page.set("context", context_part(findings.context));
    page_of("document.html.mustache", std::move(page), take);
}

std::string document_html(const Document& document, const Findings& findings, const std::filesystem::path& folder) {
    std::string html;
    document_html(document, findings, folder, [&](std::string_view piece) { html += piece; });
    return html;
}

} // namespace fernlicht
