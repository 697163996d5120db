#include "runner/experiments/study/study_document.h"
#include "metrics/readings/reading_labels.h"
#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/study/change_text.h"
#include "runner/experiments/study/study_decision.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"
#include "runner/findings/figures.h"
#include "runner/judge/known_failures.h"
#include "runner/judge/verdict_line.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

std::size_t count_deciding(const StudyResult& result, std::optional<ChangeKind> kind = {}) {
    return static_cast<std::size_t>(
        std::ranges::count_if(result.changes, [&](const Change& change) { return change.decides && (!kind || change.kind == *kind); }));
}

/// Whether anything was held against a limit, a baseline or a repeat, or is missing.
bool was_judged(const StudyResult& result) {
    return !result.complete() || !result.verdicts.empty() ||
           std::ranges::any_of(result.cells, [](const CellResult& cell) { return !cell.verdicts.empty(); });
}

/// Why no deciding reading could be compared, as a sentence; "" where at least one could, and where nothing was to be compared.
std::string nothing_compared(const StudyResult& result) {
    const std::size_t deciding = count_deciding(result);
    if (result.study.comparisons.empty() || deciding > count_deciding(result, ChangeKind::unknown))
        return "";
    if (deciding > 0)
        return fmt::format("Nothing could be compared: of none of {} changes of deciding readings is it known how exact they are.",
                           deciding);
    const auto played = std::ranges::count(result.cells, "", &CellResult::failed);
    return result.changes.size() + result.changes_elsewhere > 0
               ? "Nothing could be compared: no deciding reading is in two cells that are compared."
           : played < std::ssize(result.cells)
               ? fmt::format("Nothing could be compared: cells played: {} of {}.", played, result.cells.size())
               : "Nothing could be compared: no two lamps were played under the same conditions.";
}

std::string lamps_of(const StudyResult& result, const Change& change) {
    return result.lamp_of(change.tested) + " / " + result.lamp_of(change.against);
}

std::string with_unit(const Value& value, const std::string& unit) {
    return value.measured() ? with_bound(value, fmt::format("{:.4g}{}", *value.figure(), unit_suffix(unit))) : "not measured";
}

/// "reach at 5 lx ...: 40 m → 50 m, +10.00 m (+25.0 %) ±0.57; new against old on straight-1 (night)"
std::string change_sentence(const StudyResult& result, const Change& change) {
    const Value found = change.change();
    const CellResult& cell = result.cells[change.tested];
    return fmt::format("{}: {} → {}, {}{}{} {}; {} against {} on {} ({})", reading_label(change.reading),
                       with_unit(change.old_value, change.unit()), with_unit(change.new_value, change.unit()),
                       with_bound(found, fmt::format("{:+.{}f}", found.figure().value_or(0.0), decimals_of(change))),
                       unit_suffix(change.unit()), change.relative() ? fmt::format(" ({:+.1f} %)", 100.0 * *change.relative()) : "",
                       open_words(change, change.uncertainty.value_or(0.0)), result.lamp_of(change.tested), result.lamp_of(change.against),
                       cell.drive, cell.cell.condition);
}

Card card_of(const StudyResult& result, const Change& change) {
    const std::string unit = unit_suffix(change.unit());
    const int decimals = decimals_of(change);
    std::string detail = fmt::format("{} {}{} → {} {}{}; {}", result.lamp_of(change.against), value_cell(change.old_value, decimals).text,
                                     unit, result.lamp_of(change.tested), value_cell(change.new_value, decimals).text, unit,
                                     open_words(change, change.uncertainty.value_or(0.0), unit + " numerical"));
    if (change.noise_effect.value_or(0.0) > 0.0)
        detail += ", " + open_words(change, *change.noise_effect, unit + " by noise");
    if (change.aim_effect)
        detail += fmt::format(", ±{}{} by 0.1° of aim", figure(*change.aim_effect, decimals), unit);
    const CellResult& cell = result.cells[change.tested];
    return {reading_label(change.reading),
            change_cell(change).text,
            unit_label(change.unit()),
            change.relative() ? fmt::format("({} %)", signed_figure(100.0 * *change.relative(), 1)) : "",
            detail,
            Cell(cell.drive + ", " + cell.cell.condition).linked("#" + change.id)};
}

/// Of the page. What all rows have alike stands over it.
Table readings_table(const StudyResult& result) {
    const bool several_lamps = result.study.comparisons.size() > 1;
    const bool several_conditions = std::ranges::any_of(
        result.cells, [&](const CellResult& cell) { return cell.cell.condition != result.cells.front().cell.condition; });
    const bool loaded =
        std::ranges::any_of(result.changes, [](const Change& change) { return change.decides && change.load_effect.has_value(); });
    const std::string heads =
        std::string("row") + (several_lamps ? "|new / old<" : "") + "|drive<" + (several_conditions ? "|condition<" : "") +
        "|reading<|old|new|change|%|± numerical|± noise|± aim|± flux|± height|" + (loaded ? "± load|" : "") + "unit<|is<";
    Table table{.name = "readings", .caption = "", .columns = columns_of(heads), .rows = {}, .sortable = true, .led_to = true};
    if (!several_lamps && !result.study.comparisons.empty())
        table.caption = fmt::format("new: {}; old: {}", result.study.comparisons.front().tested, result.study.comparisons.front().against);
    for (std::size_t i = 0; i < result.changes.size(); ++i) {
        const Change& change = result.changes[i];
        if (!change.decides)
            continue;
        const CellResult& cell = result.cells[change.tested];
        std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{{change.id, static_cast<double>(i)}});
        if (several_lamps)
            cells.emplace_back(lamps_of(result, change));
        cells.emplace_back(cell.drive);
        if (several_conditions)
            cells.emplace_back(cell.cell.condition);
        const std::optional<double> share = change.relative();
        const auto effect = [&](const std::optional<double>& by) { return by ? Cell(figure(*by, decimals_of(change)), *by) : Cell(""); };
        cells.insert(cells.end(), {Cell(reading_label(change.reading)).hinted(name_of(change.reading)),
                                   value_cell(change.old_value, decimals_of(change)), value_cell(change.new_value, decimals_of(change)),
                                   change_cell(change), share ? Cell(signed_figure(100.0 * *share, 1), 100.0 * *share) : Cell(""),
                                   open_cell(change, change.uncertainty), open_cell(change, change.noise_effect), effect(change.aim_effect),
                                   effect(change.flux_effect), effect(change.height_effect)});
        if (loaded)
            cells.push_back(effect(change.load_effect));
        cells.insert(cells.end(), {unit_label(change.unit()), change_name(change.kind)});
        if (change.kind != ChangeKind::real)
            table.quiet.push_back(table.rows.size() - 1);
    }
    return table;
}

/// What is red or known, and cells that were not played.
Table failures_table(const StudyResult& result) {
    Table table{"failures", "Outside limits, baselines or history, or not measured", columns_of("what<|where<|found<|repeat with`"), {}};
    const auto add = [&](const std::string& where, const Verdict& verdict) {
        if (verdict.kind != VerdictKind::pass || is_red(verdict))
            table.rows.push_back(
                {verdict.name, where, verdict.known.empty() ? verdict.text : verdict.text + "; " + verdict.known, verdict.rerun});
    };
    for (const Verdict& verdict : result.verdicts)
        add("study", verdict);
    for (const CellResult& cell : result.cells) {
        if (!cell.failed.empty())
            add(cell.cell.name, {VerdictKind::not_measured, "not played", cell.failed, cell.command});
        for (const Verdict& verdict : cell.verdicts)
            add(cell.cell.name, verdict);
    }
    return table;
}

/// What is red or known, a paragraph each, with the command that repeats it. Who reads a hundred of them opens the page.
std::vector<std::string> lines_not_green(const StudyResult& result) {
    constexpr std::size_t most = 100;
    std::vector<std::string> lines;
    std::size_t more = 0;
    const Report suites = suites_of(result), judged = as_report(result);
    for (std::size_t i = 0; i < suites.played.size(); ++i)
        for (const Verdict& verdict : suites.played[i].verdicts) {
            if (verdict.kind == VerdictKind::pass && !is_red(verdict))
                continue;
            if (lines.size() == most) {
                ++more;
                continue;
            }
            const std::string line = verdict_line(verdict, suites.played[i].drive + ": ");
            const bool may_be_known =
                verdict.known.empty() && verdict.name != "history" && !verdict.name.starts_with("known failure ") &&
                std::ranges::find(judged.played[i].verdicts, verdict.name, &Verdict::name) != judged.played[i].verdicts.end();
            lines.push_back(line.substr(0, line.find_last_not_of("\n.") + 1) +
                            (verdict.rerun.empty() ? "." : fmt::format(". Repeat with `{}`", verdict.rerun)) +
                            (may_be_known ? fmt::format("; `--known` calls it `{}`", verdict_id(judged.played[i], verdict)) : ""));
        }
    if (more > 0)
        lines.push_back(fmt::format("And {} more, all in report.html.", more));
    return lines;
}

/// The verdict as people say it.
std::string verdict_words(const StudyResult& result) {
    const auto is_any = [&](auto holds) {
        return std::ranges::any_of(result.verdicts, holds) ||
               std::ranges::any_of(result.cells, [&](const CellResult& cell) { return std::ranges::any_of(cell.verdicts, holds); });
    };
    const auto is_any_red = [&](auto of) { return is_any([&](const Verdict& one) { return is_red(one) && of(one.name); }); };
    const auto is_any_failed = [&](auto of) {
        return is_any([&](const Verdict& one) { return is_red(one) && one.kind == VerdictKind::fail && of(one.name); });
    };
    const auto is_of_history = [](const std::string& name) { return name == unchanged_verdict; };
    const auto is_of_baseline = [](const std::string& name) { return name.starts_with("baseline"); };
    const auto is_of_list = [](const std::string& name) { return name.starts_with("known failure "); };
    const auto is_of_limit = [&](const std::string& name) { return !is_of_history(name) && !is_of_baseline(name) && !is_of_list(name); };
    switch (overall(result)) {
    case VerdictKind::pass: {
        const auto of_baseline = [](const Verdict& one) { return one.name.starts_with("baseline"); };
        const auto is_as_accepted = [&](const CellResult& cell) {
            return std::ranges::any_of(cell.verdicts, of_baseline) && std::ranges::none_of(cell.verdicts, [&](const Verdict& one) {
                       return of_baseline(one) && one.kind != VerdictKind::pass;
                   });
        };
        const auto held = std::ranges::count_if(result.cells, is_as_accepted);
        return held == 0 ? "Within limits"
                         : fmt::format("Within limits; {} of {} as in the baselines", held, counted(result.cells.size(), "cell"));
    }
    case VerdictKind::fail:
        return is_any_failed(is_of_limit)   ? "Limits exceeded"
               : is_any_red(is_of_history)  ? "Changed since the accepted night"
               : is_any_red(is_of_baseline) ? "Differs from the baselines"
                                            : "The list of known failures is out of date";
    case VerdictKind::flaky:
        return "Flaky";
    case VerdictKind::not_measured:
        break;
    }
    return "Not all was measured";
}

/// What the study was played for comes first: better, worse, undecided.
Section decision_section(const StudyResult& result, const std::vector<Decision>& decisions) {
    const std::string nothing = nothing_compared(result);
    Section section{nothing.empty() ? decision_heading(result, decisions) : "Nothing was compared", {}};
    if (!nothing.empty())
        section.blocks.emplace_back(nothing);
    for (const Decision& decision : decisions) {
        const StudyComparison& pair = result.study.comparisons[decision.comparison];
        Listing parts(decision_parts(result, decision));
        parts.caption = decisions.size() == 1 ? fmt::format("{} against {}", pair.tested, pair.against) : decision_count(result, decision);
        section.blocks.emplace_back(std::move(parts));
    }
    if (!result.warnings.empty()) {
        Listing warnings(result.warnings);
        warnings.caption = result.warnings.size() == 1 ? "Warning" : "Warnings";
        section.blocks.emplace_back(std::move(warnings));
    }
    if (!was_judged(result))
        section.blocks.emplace_back("No limits were set.");
    if (!result.played_in_part.empty())
        section.blocks.emplace_back(result.played_in_part + ".");
    if (Table table = decision_table(result, decisions); !table.rows.empty())
        section.blocks.emplace_back(std::move(table));
    if (const std::vector<std::string> same = same_results(result, decisions); !same.empty())
        section.blocks.emplace_back(Listing(same));
    return section;
}

/// "country-1, reach_5lx_target_own_m: 61.2 m, limit at least 60 m": the first few limits that all that was played keeps.
Listing limits_held(const StudyResult& result) {
    constexpr std::size_t most = 5;
    std::vector<std::string> held;
    const auto add = [&](const std::string& where, const std::vector<Verdict>& verdicts) {
        for (const Verdict& verdict : verdicts)
            if (verdict.line > 0)
                held.push_back(fmt::format("{}{}: {}", where, verdict.name, verdict.text));
    };
    add("", result.verdicts);
    for (const CellResult& cell : result.cells)
        add(cell.cell.name + ", ", cell.verdicts);
    Listing list{{}, "Limits that hold"};
    list.items.insert(list.items.end(), held.begin(), held.begin() + static_cast<std::ptrdiff_t>(std::min(most, held.size())));
    if (held.size() > most)
        list.items.emplace_back(fmt::format("and {} more", held.size() - most));
    return list;
}

/// Only where something was judged or is missing.
Section verdict_section(const StudyResult& result) {
    Section section{verdict_words(result), {}, 2, false, verdict_name(overall(result))};
    if (!result.interrupted.empty())
        section.blocks.emplace_back("The study did not end; --resume goes on.");
    if (Table failures = failures_table(result); !failures.rows.empty())
        section.blocks.emplace_back(std::move(failures));
    else if (Listing held = limits_held(result); !held.items.empty())
        section.blocks.emplace_back(std::move(held));
    return section;
}

Section largest_section(const StudyResult& result) {
    const std::string nothing = nothing_compared(result);
    if (result.largest.empty())
        return {"The largest changes",
                {nothing.empty() ? "No deciding reading changed beyond numerical uncertainty, noise of the candela tables and 0.1° of aim."
                                 : nothing}};
    Cards cards;
    for (const std::size_t i : result.largest)
        cards.push_back(card_of(result, result.changes[i]));
    return {
        "The largest changes",
        {std::move(cards),
         "Each deciding reading on the route that it changes most on, not on the median one as above; size is the change over the larger "
         "of "
         "both values. Real is what exceeds numerical uncertainty and the noise of the candela tables, and what 0.1° of aim would do."}};
}

Section lamps_section(const StudyResult& result) {
    Section section{"The lamps themselves", {}};
    Listing lamps;
    for (const LampComparison& pair : result.lamps)
        lamps.items.emplace_back(lamp_verdict(pair));
    if (!lamps.items.empty())
        section.blocks.emplace_back(std::move(lamps));
    constexpr std::size_t most = 5;
    for (const LampComparison& pair : result.lamps) {
        const std::vector<std::string> all = sentences_of(pair.difference);
        Listing told{{}, fmt::format("{} against {} ({})", pair.tested, pair.against, pair.side)};
        told.items.insert(told.items.end(), all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size())));
        if (all.size() > most)
            told.items.emplace_back(fmt::format("and {} more, all in study.json", all.size() - most));
        section.blocks.emplace_back(std::move(told));
        Table places = named_places_table(pair.difference);
        places.name = fmt::format("places-{}-{}-{}", pair.tested, pair.against, pair.side);
        places.folded = places.off_terminal = true;
        section.blocks.emplace_back(std::move(places));
    }
    return section;
}

/// Driver's views of the same moment with two lamps.
Section views_section(const StudyResult& result) {
    Section section{"What the driver sees", {}};
    for (const StudyComparison& pair : result.study.comparisons) {
        std::vector<std::pair<std::size_t, std::size_t>> pairs = result.pairs_of(pair);
        pairs.resize(std::min(pairs.size(), max_pictured_places));
        for (const auto& [tested, against] : pairs)
            for (const StoredFrame& now : result.cells[tested].frames)
                for (const StoredFrame& before : result.cells[against].frames)
                    if (now.tick == before.tick && now.view == before.view && !now.png.empty() && !before.png.empty()) {
                        const std::string what = fmt::format("{}, after {:.1f} s ({})", result.cells[tested].title, now.time_s,
                                                             result.cells[tested].cell.condition);
                        if (now.shown_by == before.shown_by)
                            section.blocks.emplace_back(PictureOverlay{what, {pair.against, pair.tested}, {before.png, now.png}});
                        else
                            section.blocks.emplace_back(fmt::format(
                                "{}: pictures of {} and {} are not laid over each other, as they have no common exposure, "
                                "white and tone: `{}` and `{}`.",
                                what, pair.tested, pair.against, printable(now.shown_by, 200), printable(before.shown_by, 200)));
                    }
    }
    return section;
}

Table cells_table(const StudyResult& result) {
    Table table{"cells", "", columns_of("cell<|condition<|95 % of the road within [%]|frame [ms]|repeat with`"), {}};
    const auto figure_of = [](const std::optional<double>& value, double scale, int decimals) {
        return value ? Cell(figure(scale * *value, decimals), scale * *value) : Cell("not measured");
    };
    for (const CellResult& cell : result.cells)
        if (cell.failed.empty())
            table.rows.push_back(
                {cell.is_kept ? Cell(cell.cell.name).linked("cells/" + cell.cell.name + "/report.html") : Cell(cell.cell.name),
                 cell.cell.condition, figure_of(cell.error_share, 100.0, 2), figure_of(cell.frame_s, 1e3, 1), cell.command});
        else
            table.rows.push_back({cell.cell.name, cell.cell.condition, "", "not played: " + cell.failed, cell.command});
    return table;
}

} // namespace

std::string study_sentence(const StudyResult& result) {
    if (result.study.comparisons.empty())
        return "Nothing was to be compared.";
    if (std::string nothing = nothing_compared(result); !nothing.empty())
        return nothing;
    std::vector<std::string> sentences;
    for (const Decision& decision : decide(result))
        sentences.push_back(decision_sentence(result, decision));
    return fmt::format("{}", fmt::join(sentences, " "));
}

Document document(const StudyResult& result, const std::vector<std::string>& papers) {
    Section lamps = lamps_section(result), over{"Over the axes", {}}, reach{"Reach over the drive", {}}, glare{"Glare over the drive", {}},
            maps{"Lux from above", {"All maps in one scale, 0.1 to 100 lx; below each pair the ratio of new to old."}}, cells{"Cells", {}};
    Listing runs_of_axes;
    for (const StudyFigure& figure : result.figures)
        if (figure.plot.name.starts_with("figures/axis_"))
            runs_of_axes.items.emplace_back(figure.title);
    if (!runs_of_axes.items.empty())
        over.blocks.emplace_back(std::move(runs_of_axes));
    for (const StudyFigure& figure : result.figures)
        for (const auto& [beginning, section] : {std::pair("figures/lamps_", &lamps),
                                                 {"figures/axis_", &over},
                                                 {"figures/reach_", &reach},
                                                 {"figures/glare-", &glare},
                                                 {"figures/lux", &maps},
                                                 {"figures/work-precision", &cells}})
            if (figure.plot.name.starts_with(beginning))
                section->blocks.emplace_back(figure.plot);
    if (!result.tells_all)
        cells.blocks.emplace_back(
            fmt::format("Of so many cells ({}) only readings that decide or have limits are told, and the reports are "
                        "kept of those that are pictured or red: `fernlicht study --only NAME` collects any other from the store.",
                        result.cells.size()));
    if (result.cells.size() > max_pictured_places * result.study.lamps.size())
        cells.blocks.emplace_back(
            fmt::format("Pictures are of the first {} places; the others' are in the reports of their cells.", max_pictured_places));
    if (!result.played_by.empty())
        cells.blocks.emplace_back(result.played_by + ".");
    cells.blocks.emplace_back(cells_table(result));
    Listing files({Cell("study.json").linked("study.json"), Cell("study.csv").linked("study.csv")});
    for (const std::string& paper : papers)
        files.items.push_back(Cell((paper == papers.front() ? "for papers: " : "") + paper).linked(paper));
    const Section readings{
        "Deciding readings, route by route",
        {"Click a heading to sort, again to reverse. ± numerical is the numerical uncertainty of the change, ± noise what three standard "
         "deviations of the noise of the candela tables would do. ± aim, flux, height, load: what 0.1°, 10 %, 10 mm of mounting height and "
         "75 kg over the rear axle would do, up or down, to either lamp; aim alone decides what is real. Each line is the row of its "
         "number "
         "in study.json and study.csv, which have all other readings too.",
         files, readings_table(result)}};
    const std::vector<Decision> decisions = decide(result);
    Document document{short_text(result.study.title, 160), {}};
    const auto add = [&](Section section, bool folded) {
        section.folded = folded;
        if (!section.blocks.empty())
            document.sections.push_back(std::move(section));
    };
    Section answer = answer_section(result, decisions);
    if (was_judged(result) && overall(result) != VerdictKind::pass && !answer.blocks.empty())
        answer.blocks.emplace_back(verdict_words(result) + ": what and where stands below.");
    if (!result.played_in_part.empty() && !answer.blocks.empty())
        answer.blocks.emplace_back(result.played_in_part + ".");
    if (!result.warnings.empty() && !answer.blocks.empty())
        answer.blocks.emplace_back(counted(result.warnings.size(), "warning") + ": " + result.warnings.front() + ".");
    add(std::move(answer), false);
    add(decision_section(result, decisions), false);
    if (was_judged(result))
        document.sections.push_back(verdict_section(result));
    for (Section* const section : {&over, &reach, &glare})
        add(std::move(*section), false);
    add(largest_section(result), false);
    for (const Section& section : {lamps, aims_section(result), readings, cars_section(result), views_section(result), maps, cells})
        add(section, true);
    add_lamp_files(result, document);
    return document;
}

Document study_summary(const StudyResult& result) {
    Section section;
    const auto say = [&](std::string line) {
        if (!line.empty())
            section.blocks.emplace_back(std::move(line));
    };
    const auto judge = [&](const std::string& where, const std::vector<Verdict>& verdicts) {
        for (const Verdict& verdict : verdicts) {
            const std::string line = verdict_line(verdict, where);
            say(line.substr(0, line.find_last_not_of('\n') + 1));
        }
    };
    say(result.study.title + (was_judged(result) ? std::string(": ") + verdict_text(overall(result)) : ""));
    for (const Decision& decision : decide(result))
        say(decision_count(result, decision));
    say(study_sentence(result));
    say(result.played_in_part);
    say(result.interrupted.empty() ? "" : "incomplete: " + result.interrupted);
    for (const CellResult& cell : result.cells)
        say(cell.failed.empty() ? "" : fmt::format("NOT PLAYED {}: {}", cell.cell.name, cell.failed));
    judge("", result.verdicts);
    for (const CellResult& cell : result.cells)
        judge(cell.cell.name + ": ", cell.verdicts);
    for (const LampComparison& lamps : result.lamps)
        say(lamp_verdict(lamps));
    for (const std::string& same : same_results(result, decide(result)))
        say(same);
    for (const std::size_t i : result.largest)
        say(change_sentence(result, result.changes[i]));
    return {result.study.title, {section}};
}

Document study_paper(const StudyResult& result) {
    Table table{"readings", "", columns_of("new / old<|drive<|condition<|reading<|old|new|change|±|unit<|is<"), {}};
    const auto rounded = [](const Value& value, int decimals, bool is_change) {
        return value.measured() ? cell_of(value, fmt::format(fmt::runtime(is_change ? "{:+.{}f}" : "{:.{}f}"), *value.figure(), decimals))
                                : Cell("");
    };
    for (const Change& change : result.changes)
        if (change.decides)
            table.rows.push_back(
                {lamps_of(result, change), result.cells[change.tested].drive, result.cells[change.tested].cell.condition,
                 reading_label(change.reading), rounded(change.old_value, decimals_of(change), false),
                 rounded(change.new_value, decimals_of(change), false), rounded(change.change(), decimals_of(change), true),
                 change.uncertainty
                     ? Cell(fmt::format("{:.{}f}", change.total_uncertainty(), decimals_of(change)), change.total_uncertainty())
                     : Cell(""),
                 unit_label(change.unit()), change_name(change.kind)});
    Section section{was_judged(result) ? verdict_words(result) : "No limits were set", {}};
    if (!result.interrupted.empty())
        section.blocks.emplace_back("The study did not end: " + result.interrupted + ".");
    for (std::string& line : lines_not_green(result))
        section.blocks.emplace_back(std::move(line));
    section.blocks.emplace_back(study_sentence(result));
    if (!result.played_in_part.empty())
        section.blocks.emplace_back(result.played_in_part + ".");
    section.blocks.emplace_back(std::move(table));
    section.blocks.emplace_back("Medians over what was played of the drive unless said otherwise. ± is the change's numerical uncertainty "
                                "and the noise of the candela tables; within aim means that 0.1° of aim would do as much.");
    return {result.study.title, {section}};
}

} // namespace fernlicht
