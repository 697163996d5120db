#include "runner/experiments/study/study_decision.h"
#include "runner/experiments/study/study_document.h"
#include "runner/files/output_folder.h"
#include "runner/findings/figures.h"
#include "runner/findings/paper_figure.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

/// Of lines: apart in grey print, too.
constexpr const char *paper_dashes[] = {"", "6 3", "1.5 2.5", "9 3 2 3", "14 4", "9 3 2 3 2 3"},
                     *dash_names[] = {"full", "dashed", "dotted", "dash-dotted", "long-dashed", "dash-dot-dotted"};

/// ". Only moments 0:8 of each drive were played: 9 of 660"; "" where all were.
std::string part_of_drives(const StudyResult& result) { return result.played_in_part.empty() ? "" : ". " + result.played_in_part; }

/// "Source: cells country_halogen and country_xenon of the study standard-1, fernlicht 1.2".
std::string source_of(const StudyResult& result, const std::vector<std::size_t>& cells) {
    constexpr std::size_t most_named = 6;
    std::vector<std::string> names;
    for (const std::size_t cell : cells)
        names.push_back(result.cells[cell].cell.name);
    return fmt::format("Source: moments of {} in the study {}{}{}.",
                       names.size() > most_named ? counted(names.size(), "cell")
                                                 : fmt::format("the cell{} {}", names.size() == 1 ? "" : "s", fmt::join(names, ", ")),
                       result.study.name,
                       result.context.versions.empty()
                           ? ""
                           : fmt::format(", {} {}", result.context.versions.front().first, result.context.versions.front().second),
                       part_of_drives(result));
}

Table data_of(const plots::Figure& figure) {
    Table table{
        "data", figure.title, {{.head = "line", .words = true}, {figure.x.label, figure.x.unit}, {figure.y.label, figure.y.unit}}, {}};
    for (const plots::Series& series : figure.series)
        for (const plots::Point& point : series.points)
            if (std::isfinite(point.x) && std::isfinite(point.y))
                table.rows.push_back({series.name, Cell(fmt::format("{}", point.x), point.x), Cell(fmt::format("{}", point.y), point.y)});
    return table;
}

/// One column wide: title and place go to the caption, lines get dashes beside their colours.
PaperFigure lines_for_paper(const StudyResult& result, const StudyFigure& drawn) {
    plots::Figure figure = std::get<plots::Figure>(drawn.plot.figure);
    PaperFigure paper{file_name_of(drawn.plot.name.substr(drawn.plot.name.find('/') + 1)), figure, "", one_column_mm, data_of(figure)};
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < figure.series.size(); ++i) {
        figure.series[i].dash = paper_dashes[i % std::size(paper_dashes)];
        lines.push_back(fmt::format("{}: {}", dash_names[i % std::size(dash_names)], figure.series[i].name));
    }
    paper.caption = fmt::format("{}; {} ({}). {}", figure.title, figure.subtitle, fmt::join(lines, ", "), source_of(result, drawn.cells));
    figure.title.clear();
    figure.subtitle.clear();
    figure.width_px = 360.0;
    figure.height_px = 200.0 + 20.0 * static_cast<double>(std::max<std::size_t>(figure.series.size(), 2)); // a line of the legend each
    paper.figure = std::move(figure);
    return paper;
}

} // namespace

std::vector<PaperFigure> paper_figures(const StudyResult& result) {
    std::vector<PaperFigure> figures;
    for (const Decision& decision : decide(result))
        if (std::optional<plots::DotPlot> dots = ranking_of(result, decision)) {
            const StudyComparison& pair = result.study.comparisons[decision.comparison];
            dots->title.clear();
            dots->subtitle.clear();
            figures.push_back(
                {file_name_of(fmt::format("ranking_{}-{}", pair.tested, pair.against)), drawing_of(*dots),
                 fmt::format(
                     "What {} changes against {}, in per cent of the old value, better to the right. Dots: the median of the changes that "
                     "are real, else of those within aim, the smaller of the middle two; lines: what numerical error, noise of the "
                     "candela tables and 0.1° of aim leave open; "
                     "ticks: single routes. Hollow: within that. Numbers at the right: the same in the reading's unit. Source: "
                     "study.json of the study {}{}.",
                     pair.tested, pair.against, result.study.name, part_of_drives(result)),
                 two_columns_mm, decision_table(result, {decision})});
        }
    for (const StudyFigure& drawn : result.figures)
        if ((!drawn.plot.places.empty() || drawn.plot.name.starts_with("figures/axis_")) &&
            std::holds_alternative<plots::Figure>(drawn.plot.figure))
            figures.push_back(lines_for_paper(result, drawn));
    return figures;
}

Document paper_tables(const StudyResult& result) {
    const std::vector<Decision> decisions = decide(result);
    Section section{result.study.title, {study_sentence(result)}};
    for (DocumentPart& block : answer_section(result, decisions).blocks)
        if (auto* const matrix = std::get_if<PlaceMatrix>(&block)) {
            matrix->caption += part_of_drives(result);
            section.blocks.push_back(std::move(block));
        }
    Table decided = decision_table(result, decisions);
    decided.caption += part_of_drives(result);
    section.blocks.emplace_back(std::move(decided));
    section.blocks.emplace_back("Source: study.json and study.csv of the study " + result.study.name +
                                "; ± 0.1° of aim: what an aim wrong by so much changes.");
    return {result.study.title, {section}};
}

} // namespace fernlicht
