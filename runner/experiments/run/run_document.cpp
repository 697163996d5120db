#include "runner/experiments/run/run_document.h"

#include "runner/experiments/run/run_plots.h"
#include "runner/experiments/run/run_report.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace fernlicht {
namespace {

/// What turned a run red that failed.
const char* failure_word(const Report& report) {
    bool limits = false, baselines = false;
    for (const PlayedCell& played : report.played)
        for (const Verdict& verdict : played.verdicts)
            if (is_red(verdict) && verdict.kind == VerdictKind::fail)
                (verdict.name.starts_with("baseline") ? baselines : limits) = true;
    return limits ? "Limits exceeded" : baselines ? "Differs from the baselines" : "The list of known failures is out of date";
}

const char* verdict_word(const Report& report) {
    const VerdictKind verdict = overall(report);
    return verdict == VerdictKind::fail           ? failure_word(report)
           : verdict == VerdictKind::flaky        ? "Flaky"
           : !report.complete                     ? "Incomplete"
           : verdict == VerdictKind::not_measured ? "Not everything was measured"
           : count_verdicts(report).all() == 0    ? "No limits were set"
                                                  : "Within limits";
}

Table verdict_table(const char* name, const char* caption, const std::string& found) {
    return {name, caption, columns_of("reading`|drive, lamp<|" + found + "<|repeat with`"), {}};
}

Cell milliseconds(double seconds) { return {figure(1e3 * seconds, 2), 1e3 * seconds}; }

Table passes_table(const ComparedDrive& drive) {
    Table table{
        drive.name + "-times", "", columns_of("lamp<|pass<|median [ms]|5 % … 95 % [ms]|min … max [ms]|samples|warm-up dropped"), {}};
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i)
        for (const PassTime& pass : drive.lamp_sets[i]->passes)
            if (const std::optional<Spread> spread = spread_of(pass.seconds)) {
                const bool by_picture = pass.name.starts_with("display: "); // each stored one, none of them dropped
                table.rows.push_back({lamp_cell(drive, i), short_text(pass.name, 40), milliseconds(spread->median),
                                      milliseconds(spread->p05).text + " … " + milliseconds(spread->p95).text,
                                      milliseconds(spread->minimum).text + " … " + milliseconds(spread->maximum).text,
                                      fmt::format("{}", spread->count),
                                      fmt::format("{}", by_picture ? 0 : drive.lamp_sets[i]->warm_up_dropped)});
            }
    return table;
}

Table throughput_table(const ComparedDrive& drive) {
    Table table{
        drive.name + "-throughput",
        "The whole run: rendered, read back, measured, stored",
        columns_of("lamp<|moments|moments [1/s]|all rendering alone: rate [1/s]|all rendering alone: share [%]|driver’s view alone: "
                   "rate [1/s]|driver’s view alone: share [%]|peak memory [MiB]"),
        {}};
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        const Throughput& t = drive.lamp_sets[i]->throughput;
        if (!t.moments_per_s())
            continue;
        std::vector<Cell>& row = table.rows.emplace_back(
            std::vector<Cell>{lamp_cell(drive, i), fmt::format("{}", t.moments), {figure(*t.moments_per_s(), 1), *t.moments_per_s()}});
        for (const std::optional<double>& alone_s : {t.drawing_s, t.view_s}) {
            row.push_back(alone_s ? Cell(figure(1.0 / *alone_s, 1), 1.0 / *alone_s) : Cell("not measured"));
            row.push_back(alone_s ? Cell(figure(100.0 * *t.share_of(alone_s), 0), 100.0 * *t.share_of(alone_s)) : Cell("not measured"));
        }
        row.emplace_back(figure(t.peak_memory_mib, 0), t.peak_memory_mib);
    }
    return table;
}

void add_reaches(const ComparedDrive& drive, Sections& sections) {
    Section section{"Reach over the drive",
                    {"Full lines: from the rendered lux image. Thin broken lines: the twin, in double precision from the candela "
                     "tables. Shaded: ±0.1° of aim."},
                    3};
    for (const Surface surface : {Surface::road, Surface::target})
        for (const double threshold_lx : plotted_thresholds_lx(drive))
            add_plot(section, fmt::format("{}-reach-{:g}lx-{}", drive.name, threshold_lx, surface_name(surface)),
                     reach_figure(drive, surface, threshold_lx));
    if (section.blocks.size() == 1)
        return;
    add_plot(section, drive.name + "-speed", speed_figure(drive));
    add_plots(section, drive.name + "-car", car_figures(drive));
    sections.push_back(std::move(section));
}

void add_if_plotted(Sections& sections, const std::string& title, const std::string& words, const std::string& name,
                    std::vector<plots::Figure> figures) {
    if (!figures.empty())
        add_plots(sections.emplace_back(Section{title, {words}, 3}), name, std::move(figures));
}

void add_pixels(const ComparedDrive& drive, Sections& sections) {
    Section section{
        "Pixels over the drive",
        {"Which parts of each pixel lamp were dark when: the mean level of each column of pixels, over H of that lamp and time. Lines "
         "are the edges of other road users at that very moment, seen from the lamp, whatever control knows of them."},
        3};
    for (const PlayedCell* const played : drive.lamp_sets)
        std::ranges::move(level_plots(*played), std::back_inserter(section.blocks));
    if (section.blocks.size() > 1)
        sections.push_back(std::move(section));
}

void add_costs(const ComparedDrive& drive, Sections& sections) {
    std::optional<plots::Figure> plot = timing_figure(drive);
    Table passes = passes_table(drive);
    const std::string& no_times = drive.lamp_sets.front()->no_times;
    if (!plot && passes.rows.empty() && no_times.empty())
        return;
    Section& section = sections.emplace_back(Section{"What it cost", {}, 3});
    if (!no_times.empty()) {
        section.blocks.emplace_back("Times are not measured: " + no_times + ".");
        return;
    }
    add_plot(section, drive.name + "-times", std::move(plot));
    section.blocks.emplace_back(std::move(passes));
    section.blocks.emplace_back(
        "Only frames rendered with nothing beside them give times: the first after the warm-up, then every tenth of a "
        "kind. Stages of `display` are timed in every stored picture, while the next moments are rendered.");
    section.blocks.emplace_back(throughput_table(drive));
}

/// How the first of the plotted reaches went, small.
Sections lead_of(const ComparedDrive& drive) {
    Section section;
    if (Cards figures = key_figures(drive); !figures.empty())
        section.blocks.emplace_back(std::move(figures));
    for (const Surface surface : {Surface::target, Surface::road}) {
        const std::vector<double> limits_lx = plotted_thresholds_lx(drive);
        std::optional<plots::Figure> course = limits_lx.empty() ? std::nullopt : reach_figure(drive, surface, limits_lx.back());
        if (!course)
            continue;
        course->width_px = 600.0;
        course->height_px = 190.0;
        course->y.label = "reach";
        std::erase_if(course->series, [](const plots::Series& series) { return !series.dash.empty(); }); // the twin's
        course->subtitle = course->title + ", own lane";
        course->title.clear();
        section.blocks.emplace_back(Plot{.name = drive.name + "-course", .figure = std::move(*course)});
        break;
    }
    return section.blocks.empty() ? Sections() : Sections{std::move(section)};
}

} // namespace

Cell lamp_cell(const ComparedDrive& drive, std::size_t index) {
    return Cell::of_series(short_text(drive.lamp_sets[index]->lamp_set, 40), index);
}

Section verdict_section(const Report& report) {
    Table failures = verdict_table("failures", "Outside limits or baselines", "found"),
          flakes = verdict_table("flakes", "Flaky: repeats that differ", "what differs"),
          gaps = verdict_table("not-measured", "Not measured", "why"), known = verdict_table("known-failures", "Known failures", "found"),
          passes = verdict_table("green", "What is green", "found");
    passes.columns.pop_back();
    passes.folded = true;
    const auto add = [&](const Verdict& verdict, const std::string& where) {
        Table& table = !is_red(verdict)                            ? (verdict.kind == VerdictKind::pass ? passes : known)
                       : verdict.kind == VerdictKind::flaky        ? flakes
                       : verdict.kind == VerdictKind::not_measured ? gaps
                                                                   : failures;
        table.rows.push_back(
            {verdict.name, where, verdict.known.empty() ? verdict.text : verdict.text + "; " + verdict.known, verdict.rerun});
        if (&table == &passes)
            table.rows.back().pop_back();
    };
    for (const PlayedCell& played : report.played)
        for (const Verdict& verdict : played.verdicts)
            add(verdict, played.drive + ", " + played.lamp_set);
    for (const Verdict& verdict : report.listed)
        add(verdict, "list of known failures");
    Section section{verdict_word(report), {}};
    const std::vector<ComparedDrive> drives = compared_drives(report);
    const bool judged = count_verdicts(report).all() > 0 || !report.complete;
    for (const ComparedDrive& drive : drives)
        if (const std::string sentence = key_sentence(drive); !sentence.empty()) {
            if (!judged && drives.size() == 1) { // nothing else to lead with
                section.blocks.emplace_back(section.title + ".");
                section.title = sentence;
            } else
                section.blocks.emplace_back((drives.size() > 1 ? drive.name + ": " : "") + sentence + ".");
        }
    if (!report.complete)
        section.blocks.emplace_back("The run did not end: " + report.interrupted + ". What follows is what was done until then.");
    const VerdictCounts counts = count_verdicts(report);
    if (counts.all() > 0)
        section.blocks.emplace_back(fmt::format("{} of {} verdicts are green: limits, and baselines and repeats where they were asked for.",
                                                counts.pass, counts.all()));
    for (Table* const table : {&failures, &flakes, &gaps, &known, &passes}) {
        if (table == &passes && !report.warnings.empty())
            section.blocks.emplace_back(Listing(report.warnings));
        for (std::size_t row = table->rows.size(); table != &passes && row-- > 1;) // the same command once
            if (!table->rows[row].back().text.empty() && table->rows[row].back().text == table->rows[row - 1].back().text)
                table->rows[row].back().text = "as above";
        if (!table->rows.empty())
            section.blocks.emplace_back(std::move(*table));
    }
    if (!report.lamp_files.empty())
        section.blocks.emplace_back(lamp_files_table(report.lamp_files));
    return section;
}

void add_course(const ComparedDrive& drive, Sections& sections) {
    add_reaches(drive, sections);
    add_if_plotted(sections, "Spread over the moments",
                   "The car sways, and its beam with it. Curves: the share of the moments below a value; one that ends below 100 % goes on "
                   "beyond what was looked at. Over a range of distances the way through it spreads the light, too.",
                   drive.name + "-spread", spread_figures(drive));
    add_if_plotted(sections, "Lamps that move",
                   "What the laws and actuators of the drive’s `control` did, and what it was worth against the same lamps held still: "
                   "computed in double precision from the candela tables, without shadows. Bends are those of less than 1500 m radius.",
                   drive.name + "-control", control_figures(drive));
    add_pixels(drive, sections);
    add_signals(drive, sections);
    add_if_plotted(sections, "Seeing and glare",
                   "Computed in double precision from the candela tables, without shadows of trees and houses; a crest of the road hides "
                   "lamps.",
                   drive.name + "-seeing", seeing_figures(drive));
    add_costs(drive, sections);
}

RunPage run_page(const Report& report) {
    RunPage page{verdict_section(report), report.live ? Sections{live_section(*report.live)} : Sections(), {}};
    for (ComparedDrive& drive : compared_drives(report)) {
        RunPage::OfDrive& part = page.drives.emplace_back(RunPage::OfDrive{std::move(drive), {}, {}, {}});
        part.lead = lead_of(part.drive);
        add_extents(part.drive, part.extents);
        for (const auto add : {add_aims, add_course, add_cars, add_accuracy, add_details, add_drawing})
            add(part.drive, part.others);
    }
    return page;
}

RunPage verdict_page(const Report& report) {
    RunPage page{verdict_section(report), {}, {}};
    for (ComparedDrive& drive : compared_drives(report))
        page.drives.push_back({std::move(drive), {}, {}, {}});
    return page;
}

Document document(const Report& report) {
    Document document{"fernlicht run", {verdict_section(report)}};
    if (report.live)
        document.sections.push_back(live_section(*report.live));
    for (const ComparedDrive& drive : compared_drives(report)) {
        document.sections.push_back({drive.name, {}});
        if (Cards figures = key_figures(drive); !figures.empty())
            document.sections.push_back({"At a glance", {std::move(figures)}, 3});
        for (const auto add : {add_extents, add_aims, add_course, add_cars, add_accuracy, add_details, add_drawing})
            add(drive, document.sections);
    }
    return document;
}

} // namespace fernlicht
