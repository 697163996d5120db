#include "metrics/readings/reading_words.h"
#include "report_files.h"
#include "runner/experiments/study/lamp_verdict.h"
#include "runner/experiments/study/study_words.h"
#include "runner/experiments/study/study_writers.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"
#include "runner/write/page_base.h"
#include "runner/write/plots/png.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <kainjow/mustache.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

constexpr std::size_t embedded_bytes = std::size_t{48} << 20; // of pictures as they lie on disk

std::string cell_value(const Value& value) { return value.measured() ? with_bound(value, figure(*value.figure(), 2)) : "not measured"; }

/// For the browser's sorting: a number, or nothing.
std::string sort_key(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

data change_part(const StudyResult& result, std::size_t index) {
    const Change& change = result.changes[index];
    const Value found = change.change();
    data part;
    part.set("id", fmt::format("c{}", index));
    part.set("number", fmt::format("{}", index));
    part.set("lamps", clean_text(lamp_of(result, change.tested) + " / " + lamp_of(result, change.against)));
    part.set("new_lamp", clean_text(lamp_of(result, change.tested)));
    part.set("old_lamp", clean_text(lamp_of(result, change.against)));
    part.set("drive", clean_text(result.cells[change.tested].drive));
    part.set("condition", clean_text(result.cells[change.tested].cell.condition));
    part.set("reading", clean_text(reading_in_words(change.reading)));
    part.set("name", clean_text(name_of(change.reading)));
    part.set("unit", clean_text(unit_in_words(change.unit())));
    part.set("old", cell_value(change.old_value));
    part.set("new", cell_value(change.new_value));
    part.set("old_key", sort_key(change.old_value.figure()));
    part.set("new_key", sort_key(change.new_value.figure()));
    part.set("delta", found.measured() ? with_bound(found, signed_figure(*found.figure(), 2)) : "");
    part.set("delta_key", sort_key(found.figure()));
    part.set("percent", change.relative() ? signed_figure(100.0 * *change.relative(), 1) : "");
    part.set("percent_key", change.relative() ? fmt::format("{}", 100.0 * *change.relative()) : "");
    part.set("uncertainty", change.uncertainty ? fmt::format("{:.2g}", *change.uncertainty) : "");
    part.set("uncertainty_key", sort_key(change.uncertainty));
    part.set("aim", change.by_aim ? figure(*change.by_aim, 2) : "");
    part.set("aim_key", sort_key(change.by_aim));
    part.set("noise", change.by_noise ? fmt::format("{:.2g}", *change.by_noise) : "");
    part.set("noise_key", sort_key(change.by_noise));
    part.set("has_noise", change.by_noise.value_or(0.0) > 0.0);
    part.set("has_aim", change.by_aim.has_value());
    part.set("has_percent", change.relative().has_value());
    part.set("kind", change_name(change.kind));
    part.set("class", change.kind == ChangeKind::real ? "real" : "quiet");
    return part;
}

bool has_several_conditions(const StudyResult& result) {
    return std::ranges::any_of(result.cells,
                               [&](const CellResult& cell) { return cell.cell.condition != result.cells.front().cell.condition; });
}

data verdict_part(const StudyResult& result) {
    const VerdictKind kind = overall(result);
    data part, failures{List::list};
    bool any = false, limits = false;
    const auto add = [&](const std::string& where, const Verdict& verdict) {
        if (verdict.kind == VerdictKind::pass && !is_red(verdict))
            return;
        data row;
        row.set("name", clean_text(verdict.name));
        row.set("where", clean_text(where));
        row.set("text", clean_text(verdict.known.empty() ? verdict.text : verdict.text + "; " + verdict.known));
        row.set("rerun", clean_text(verdict.rerun));
        failures.push_back(row);
        any = true;
        limits = limits || (verdict.kind == VerdictKind::fail && !verdict.name.starts_with("reference"));
    };
    for (const Verdict& verdict : result.verdicts)
        add("study", verdict);
    for (const CellResult& cell : result.cells) {
        if (!cell.failed.empty())
            add(cell.cell.name, {VerdictKind::not_measured, "not played", cell.failed, cell.command});
        for (const Verdict& verdict : cell.verdicts)
            add(cell.cell.name, verdict);
    }
    const bool judged = was_judged(result);
    part.set("class", judged ? verdict_name(kind) : "none");
    part.set("word", !judged                      ? "No limits were set"
                     : kind == VerdictKind::pass  ? "Within limits"
                     : kind == VerdictKind::fail  ? (limits ? "Limits exceeded" : "Differs from the references")
                     : kind == VerdictKind::flaky ? "Flaky"
                                                  : "Not all was measured");
    part.set("mark", !judged ? "–" : kind == VerdictKind::pass ? "✓" : kind == VerdictKind::fail ? "✗" : "?");
    part.set("sentence", study_sentence(result));
    part.set("in_part", played_in_part(result));
    part.set("is_in_part", !played_in_part(result).empty());
    part.set("has_failures", any);
    part.set("failures", failures);
    part.set("incomplete", !result.interrupted.empty());
    part.set("interrupted", clean_text(result.interrupted));
    data lamps{List::list}, words{List::list};
    for (const LampComparison& pair : result.lamps) {
        words.push_back(clean_text(lamp_verdict(pair)));
        data row, sentences{List::list};
        row.set("names", clean_text(fmt::format("{} against {} ({})", pair.tested, pair.against, pair.side)));
        const std::vector<std::string> all = sentences_of(pair.difference);
        for (std::size_t i = 0; i < std::min<std::size_t>(5, all.size()); ++i)
            sentences.push_back(clean_text(all[i]));
        row.set("sentences", sentences);
        row.set("more", all.size() > 5 ? fmt::format("and {} more zones, all in study.json", all.size() - 5) : "");
        lamps.push_back(row);
    }
    part.set("words", words);
    part.set("lamps", lamps);
    part.set("has_lamps", !result.lamps.empty());
    return part;
}

data figure_part(const StudyFigure& figure) {
    data part;
    part.set("svg", figure.svg);
    part.set("title", clean_text(figure.title));
    part.set("link", relative_link("figures/" + figure.name));
    return part;
}

data figures_part(const StudyResult& result, const std::string& prefix) {
    data list{List::list};
    for (const StudyFigure& figure : result.figures)
        if (figure.name.starts_with(prefix))
            list.push_back(figure_part(figure));
    return list;
}

/// Driver's views of the same moment with two lamps, one over the other.
data strip_part(const StudyResult& result, const std::filesystem::path& folder) {
    std::size_t budget = embedded_bytes;
    data strips{List::list};
    for (const StudyComparison& pair : result.study.comparisons)
        for (std::size_t a = 0; a < result.cells.size(); ++a)
            for (std::size_t b = 0; b < result.cells.size(); ++b) {
                const CellResult &now = result.cells[a], &before = result.cells[b];
                if (lamp_of(result, a) != pair.tested || lamp_of(result, b) != pair.against || now.cell.drive != before.cell.drive ||
                    now.cell.condition != before.cell.condition || now.cell.technique != before.cell.technique)
                    continue;
                for (const StoredFrame& frame : now.frames) {
                    const auto other = std::ranges::find_if(
                        before.frames, [&](const StoredFrame& f) { return f.tick == frame.tick && f.view == frame.view; });
                    if (frame.png.empty() || other == before.frames.end() || other->png.empty())
                        continue;
                    FilesRead ignored;
                    const std::string one = read_file(folder / frame.png, ignored), two = read_file(folder / other->png, ignored);
                    if (one.size() + two.size() > budget)
                        continue;
                    budget -= one.size() + two.size();
                    data part;
                    part.set("title", clean_text(fmt::format("{}, after {:.1f} s ({})", now.title, frame.time_s, now.cell.condition)));
                    part.set("new_lamp", clean_text(pair.tested));
                    part.set("old_lamp", clean_text(pair.against));
                    part.set("new_picture", plots::base64(one));
                    part.set("old_picture", plots::base64(two));
                    part.set("new_link", relative_link(frame.png));
                    part.set("old_link", relative_link(other->png));
                    strips.push_back(part);
                }
            }
    return strips;
}

data cells_part(const StudyResult& result) {
    data list{List::list};
    for (const CellResult& cell : result.cells) {
        data part;
        part.set("name", clean_text(cell.cell.name));
        part.set("condition", clean_text(cell.cell.condition));
        part.set("played", cell.failed.empty());
        part.set("failed", clean_text(cell.failed));
        part.set("link", relative_link("cells/" + cell.cell.name + "/report.html"));
        part.set("error", cell.error_share ? figure(100.0 * *cell.error_share, 2) + " %" : "not measured");
        part.set("frame", cell.frame_s ? figure(1e3 * *cell.frame_s, 1) + " ms" : "not measured");
        part.set("command", clean_text(cell.command));
        list.push_back(part);
    }
    return list;
}

} // namespace

std::string study_html(const StudyResult& result, const std::filesystem::path& folder) {
    data page, largest{List::list}, rows{List::list};
    for (const std::size_t i : result.largest)
        largest.push_back(change_part(result, i));
    for (std::size_t i = 0; i < result.changes.size(); ++i)
        if (result.changes[i].decides)
            rows.push_back(change_part(result, i));
    page.set("title", short_text(result.study.title, 160));
    page.set("started", clean_text(result.context.started_utc));
    page.set("style", std::string(report_file("report.css")) + std::string(report_file("study.css")));
    page.set("script", std::string(report_file("study.js")));
    page.set("verdict", verdict_part(result));
    page.set("largest", largest);
    const std::string nothing = nothing_compared(result);
    page.set("nothing", nothing.empty()
                            ? "No deciding reading changed beyond what calculation, noise of the lamps' tables and 0.1° of aim leave open."
                            : nothing);
    page.set("has_largest", !result.largest.empty());
    page.set("rows", rows);
    page.set("several_conditions", has_several_conditions(result));
    page.set("several_lamps", result.study.comparisons.size() > 1);
    for (const StudyComparison& pair : result.study.comparisons)
        page.set("only_lamps", clean_text(fmt::format("new: {}; old: {}", pair.tested, pair.against)));
    page.set("lamp_figures", figures_part(result, "lamps_"));
    page.set("reaches", figures_part(result, "reach-"));
    page.set("glares", figures_part(result, "glare-"));
    page.set("has_glares", std::ranges::any_of(result.figures, [](const StudyFigure& f) { return f.name.starts_with("glare-"); }));
    page.set("maps", figures_part(result, "lux"));
    page.set("work", figures_part(result, "work-precision"));
    page.set("strips", strip_part(result, folder));
    page.set("cells", cells_part(result));
    page.set("command", clean_text(result.context.command));
    page.set("backend", clean_text(result.context.backend + ", " + result.context.gl_renderer));
    kainjow::mustache::mustache page_template{std::string(report_file("study.html.mustache"))};
    std::string html = page_template.render(page);
    if (!page_template.is_valid())
        throw std::logic_error("study.html.mustache: " + page_template.error_message());
    return html;
}

} // namespace fernlicht
