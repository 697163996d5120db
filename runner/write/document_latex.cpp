#include "runner/files/clean_text.h"
#include "runner/write/document.h"

#include <fmt/format.h>
#include <map>

namespace fernlicht {

/// For LaTeX in UTF-8, which knows most letters; signs that it knows in formulas alone become some.
std::string latex_text(const std::string& words) {
    static const std::map<std::string_view, const char*> signs{{"\\", "\\textbackslash{}"},
                                                               {"~", "\\textasciitilde{}"},
                                                               {"^", "\\textasciicircum{}"},
                                                               {"<", "\\textless{}"},
                                                               {">", "\\textgreater{}"},
                                                               {"|", "\\textbar{}"},
                                                               {"\"", "''"},
                                                               {"\u2212", "$-$"},
                                                               {"\u2264", "$\\le$"},
                                                               {"\u2265", "$\\ge$"},
                                                               {"\u2260", "$\\ne$"},
                                                               {"\u2032", "$'$"},
                                                               {"\u2009", "\\,"},
                                                               {"²", "$^2$"},
                                                               {"±", "$\\pm$"},
                                                               {"°", "$^\\circ$"},
                                                               {"\ufffd", "?"}};
    const std::string clean = clean_text(words);
    std::string out;
    for (std::size_t at = 0; at < clean.size();) {
        std::size_t length = 1;
        while (at + length < clean.size() && (static_cast<unsigned char>(clean[at + length]) & 0xC0U) == 0x80U)
            ++length;
        if (std::string_view("&%$#_{}").find(clean[at]) != std::string_view::npos)
            out += '\\';
        const auto sign = signs.find(std::string_view(clean).substr(at, length));
        out += sign == signs.end() ? clean.substr(at, length) : sign->second;
        if (clean.compare(at, 2, "--") == 0) // no dash
            out += "{}";
        at += length;
    }
    return out;
}

namespace {

/// Figures as formulas, which set a minus sign as one.
std::string latex_cell(const Cell& cell) {
    if (cell.text.empty())
        return "--";
    const std::string plain = cell.text.starts_with("\u2212") ? "-" + cell.text.substr(3) : cell.text;
    return cell.value ? "$" + latex_text(plain) + "$" : latex_text(cell.text);
}

/// A line of heads over neighbouring columns of one group, with a rule below each.
std::string latex_groups(const std::vector<Column>& columns) {
    std::string heads, rules;
    for (std::size_t i = 0, end = 0; i < columns.size(); i = end) {
        while (end < columns.size() && columns[end].group == columns[i].group)
            ++end;
        heads += fmt::format("{}\\multicolumn{{{}}}{{c}}{{{}}}", i == 0 ? "" : " & ", end - i, latex_text(columns[i].group));
        if (!columns[i].group.empty())
            rules += fmt::format("\\cmidrule(lr){{{}-{}}}", i + 1, end);
    }
    return rules.empty() ? "" : heads + " \\\\\n" + rules + "\n";
}

} // namespace

std::string table_latex(const Table& table) {
    std::string out = "% " + clean_text(table.caption) + "\n\\begin{tabular}{", heads;
    for (const Column& column : table.columns) {
        out += column.words ? "l" : "r";
        heads += (heads.empty() ? "" : " & ") + latex_text(column.head) + (column.unit.empty() ? "" : " [" + latex_text(column.unit) + "]");
    }
    out += "}\n\\toprule\n" + latex_groups(table.columns) + heads + " \\\\\n\\midrule\n";
    for (const std::vector<Cell>& row : table.rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string text = latex_cell(row[i]);
            const bool last_of_few = i + 1 == row.size() && row.size() < table.columns.size();
            out += (i == 0 ? "" : " & ") +
                   (last_of_few ? fmt::format("\\multicolumn{{{}}}{{l}}{{{}}}", table.columns.size() - i, text) : text);
        }
        out += " \\\\\n";
    }
    return out + "\\bottomrule\n\\end{tabular}\n";
}

std::string document_latex(const Document& document) {
    std::string out = "% \\usepackage{booktabs,graphicx}; tables are as wide as the text of both columns\n";
    const auto floating = [](const Table& table) {
        if (table.caption.empty())
            return "\\resizebox{\\linewidth}{!}{%\n" + table_latex(table) + "}\n";
        return fmt::format("\\begin{{table*}}\n\\centering\n\\caption{{{}}}\n\\label{{tab:{}}}\n\\resizebox{{\\linewidth}}{{!}}{{%\n{}}}\n"
                           "\\end{{table*}}\n",
                           latex_text(table.caption), table.name, table_latex(table));
    };
    for (const Section& section : document.sections)
        for (const DocumentPart& block : section.blocks)
            if (const auto* table = std::get_if<Table>(&block))
                out += floating(*table);
            else if (const auto* matrix = std::get_if<PlaceMatrix>(&block))
                out += floating(table_of(*matrix));
            else if (const auto* paragraph = std::get_if<std::string>(&block))
                out += "% " + clean_text(*paragraph) + "\n";
            else if (const auto* listing = std::get_if<Listing>(&block)) {
                out += listing->caption.empty() ? "" : "% " + clean_text(listing->caption) + ":\n";
                for (const Cell& item : listing->items)
                    out += "% - " + clean_text(item.text) + "\n";
            }
    return out;
}

} // namespace fernlicht
