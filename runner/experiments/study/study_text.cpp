#include "metrics/readings/reading_words.h"
#include "runner/experiments/study/lamp_verdict.h"
#include "runner/experiments/study/study_words.h"
#include "runner/experiments/study/study_writers.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"
#include "runner/judge/verdict_line.h"
#include "runner/write/report_texts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace fernlicht {
namespace {

std::string value_text(const Value& value, const std::string& unit) {
    return value.measured() ? with_bound(value, fmt::format("{:.4g} {}", *value.figure(), unit_in_words(unit))) : "not measured";
}

/// "halogen -> xenon on straight-1 (night, aim -1 %, 13.2 V)"
std::string place_of(const StudyResult& result, const Change& change) {
    const CellResult &now = result.cells[change.tested], &before = result.cells[change.against];
    return fmt::format("{} against {} on {} ({})", result.study.lamps[now.cell.lamp].name, result.study.lamps[before.cell.lamp].name,
                       now.drive, now.cell.condition);
}

/// Of the characters beyond ASCII those of our own units.
std::string latex_signs(std::string text) {
    for (const auto& [from, to] : {std::pair("²", "$^2$"), std::pair("±", "$\\pm$"), std::pair("°", "$^\\circ$")})
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
            text.replace(at, std::string(from).size(), to);
    return text;
}

std::string latex_text(const std::string& text) {
    std::string out;
    for (const char c : text)
        switch (c) {
        case '_':
        case '%':
        case '&':
        case '#':
        case '$':
        case '{':
        case '}':
            out += std::string("\\") + c;
            break;
        case '~':
            out += "\\textasciitilde{}";
            break;
        case '^':
            out += "\\textasciicircum{}";
            break;
        case '\\':
            out += "\\textbackslash{}";
            break;
        default:
            out += c;
        }
    return latex_signs(out);
}

/// `|` would end a cell.
std::string markdown_text(const std::string& text) {
    std::string out;
    for (const char c : text)
        out += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
    return out;
}

std::string cell_text(const Value& value, const char* format) {
    return value.measured() ? with_bound(value, fmt::format(fmt::runtime(format), *value.figure())) : "--";
}

using Escape = std::function<std::string(const std::string&)>;

/// Lamps, drive and condition, reading, old, new, change, uncertainty, what it is.
std::vector<std::string> table_row(const StudyResult& result, const Change& change, const Escape& escape) {
    const CellResult& now = result.cells[change.tested];
    return {escape(result.study.lamps[now.cell.lamp].name + " / " + result.study.lamps[result.cells[change.against].cell.lamp].name),
            escape(now.drive),
            escape(now.cell.condition),
            escape(reading_in_words(change.reading)),
            escape(cell_text(change.old_value, "{:.2f}")),
            escape(cell_text(change.new_value, "{:.2f}")),
            escape(cell_text(change.change(), "{:+.2f}")),
            change.uncertainty ? fmt::format("{:.2f}", change.unsure()) : "--",
            escape(unit_in_words(change.unit())),
            change_name(change.kind)};
}

const std::vector<std::string> headings{"new / old", "drive", "condition", "reading", "old", "new", "change", "±", "unit", "is"};

std::string joined(const std::vector<std::string>& parts, const std::string& between) {
    return fmt::format("{}", fmt::join(parts, between));
}

} // namespace

std::string delta_text(const Change& change) {
    const Value found = change.change();
    return fmt::format("{} {}{}", with_bound(found, fmt::format("{:+.2f}", found.figure().value_or(0.0))), unit_in_words(change.unit()),
                       change.relative() ? fmt::format(" ({:+.1f} %)", 100.0 * *change.relative()) : "");
}

std::string study_text(const StudyResult& result) {
    std::string text =
        fmt::format("{}: {}\n", clean_text(result.study.title), was_judged(result) ? verdict_name(overall(result)) : "no limits were set");
    if (const std::string part = played_in_part(result); !part.empty())
        text += part + "\n";
    if (!result.interrupted.empty())
        text += "incomplete: " + result.interrupted + "\n";
    for (const CellResult& cell : result.cells)
        if (!cell.failed.empty())
            text += fmt::format("NOT PLAYED {}: {}\n", cell.cell.name, clean_text(cell.failed));
    const auto add = [&](const std::string& where, const std::vector<Verdict>& verdicts) {
        for (const Verdict& verdict : verdicts)
            text += verdict_line(verdict, where);
    };
    add("", result.verdicts);
    for (const CellResult& cell : result.cells)
        add(cell.cell.name + ": ", cell.verdicts);
    for (const std::string& warning : result.warnings)
        text += "warning: " + warning + "\n";
    for (const LampComparison& lamps : result.lamps)
        text += clean_text(lamp_verdict(lamps)) + "\n";
    if (const std::string nothing = nothing_compared(result); !nothing.empty())
        text += nothing + "\n";
    else if (result.largest.empty())
        text += "no deciding reading changed beyond what calculation, the tables' noise and 0.1 degrees of aim leave open\n";
    for (const std::size_t i : result.largest) {
        const Change& change = result.changes[i];
        text += fmt::format("{}: {} -> {}, {} ±{:.2g}; {}\n", reading_in_words(change.reading), value_text(change.old_value, change.unit()),
                            value_text(change.new_value, change.unit()), delta_text(change), change.uncertainty.value_or(0.0),
                            place_of(result, change));
    }
    return text;
}

std::string study_csv(const StudyResult& result) {
    std::string csv = "id,new,against,drive,technique,condition,reading,unit,old_value,new_value,change,uncertainty,by_tenth_degree,by_"
                      "noise,kind,decides,"
                      "new_cell,old_cell,why_not,old_bound,new_bound,change_bound\r\n";
    const auto number = [](const std::optional<double>& value) { return value ? fmt::format("{}", *value) : std::string(); };
    for (std::size_t i = 0; i < result.changes.size(); ++i) {
        const Change& c = result.changes[i];
        const CellResult &now = result.cells[c.tested], &before = result.cells[c.against];
        const std::vector<std::string> fields{fmt::format("c{}", i),
                                              csv_text(result.study.lamps[now.cell.lamp].name),
                                              csv_text(result.study.lamps[before.cell.lamp].name),
                                              csv_text(now.drive),
                                              csv_text(result.study.techniques[now.cell.technique]),
                                              csv_text(now.cell.condition),
                                              csv_text(name_of(c.reading)),
                                              csv_text(c.unit()),
                                              number(c.old_value.figure()),
                                              number(c.new_value.figure()),
                                              number(c.change().figure()),
                                              number(c.uncertainty),
                                              number(c.by_aim),
                                              number(c.by_noise),
                                              change_name(c.kind),
                                              c.decides ? "yes" : "no",
                                              csv_text(now.cell.name),
                                              csv_text(before.cell.name),
                                              csv_text(c.why_not),
                                              bound_name(c.old_value),
                                              bound_name(c.new_value),
                                              bound_name(c.change())};
        csv += joined(fields, ",") + "\r\n";
    }
    return csv;
}

std::string study_markdown(const StudyResult& result) {
    std::string text = "# " + markdown_text(clean_text(result.study.title)) + "\n\n";
    text += "| " + joined(headings, " | ") + " |\n|---|---|---|---|--:|--:|--:|--:|---|---|\n";
    for (const Change& change : result.changes)
        if (change.decides)
            text += "| " + joined(table_row(result, change, markdown_text), " | ") + " |\n";
    const std::string part = played_in_part(result);
    text += part.empty() ? "" : "\n**" + part + ".**\n";
    text += "\nMedians over what was played of the drive unless said otherwise. ± is what calculation and the noise of the lamps' tables "
            "leave open of the change; *within aim* means that 0.1° of aim would do as much.\n";
    return text;
}

std::string study_latex(const StudyResult& result) {
    std::string text = "% \\usepackage{booktabs,graphicx}; the table is as wide as the text\n";
    if (const std::string part = played_in_part(result); !part.empty())
        text += "% " + part + "\n";
    text += "\\resizebox{\\linewidth}{!}{%\n\\begin{tabular}{llllrrrrll}\n\\toprule\n";
    std::vector<std::string> titles = headings;
    std::ranges::replace(titles, std::string("±"), std::string("$\\pm$"));
    text += joined(titles, " & ") + " \\\\\n\\midrule\n";
    for (const Change& change : result.changes)
        if (change.decides) {
            std::vector<std::string> row = table_row(result, change, latex_text);
            for (std::size_t i = 4; i < 8; ++i)
                row[i] = "$" + row[i] + "$";
            text += joined(row, " & ") + " \\\\\n";
        }
    return text + "\\bottomrule\n\\end{tabular}}\n";
}

std::string study_junit(const StudyResult& result) {
    Report report;
    report.context = result.context;
    for (const CellResult& cell : result.cells) {
        PlayedVariant suite;
        suite.drive = cell.cell.name;
        suite.variant = cell.cell.condition;
        suite.technique = result.study.techniques[cell.cell.technique];
        suite.verdicts.push_back(cell.failed.empty() ? Verdict{VerdictKind::pass, "played", moments_text(result, cell), cell.command}
                                                     : Verdict{VerdictKind::not_measured, "played", cell.failed, cell.command});
        suite.verdicts.insert(suite.verdicts.end(), cell.verdicts.begin(), cell.verdicts.end());
        report.played.push_back(std::move(suite));
    }
    PlayedVariant own;
    own.drive = result.study.name;
    own.variant = "limits of the study";
    own.technique = "photometric";
    own.verdicts = result.verdicts;
    report.played.push_back(std::move(own));
    report.complete = result.interrupted.empty();
    report.interrupted = result.interrupted;
    return report_junit(report);
}

} // namespace fernlicht
