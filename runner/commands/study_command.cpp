#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/run_files.h"
#include "runner/commands/watch.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/history/history_document.h"
#include "runner/experiments/history/night_of_study.h"
#include "runner/experiments/history/tell_apart_by_playing.h"
#include "runner/experiments/study/study_document.h"
#include "runner/experiments/study/study_run.h"
#include "runner/files/log.h"
#include "runner/files/page_link.h"
#include "runner/files/trace_file.h"
#include "runner/findings/run_context.h"
#include "runner/judge/verdict_line.h"
#include "runner/play/progress.h"
#include "runner/write/document.h"
#include "runner/write/paper.h"
#include "runner/write/report_texts.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <oneapi/tbb/parallel_invoke.h>
#include <set>
#include <unistd.h>

namespace fernlicht {
namespace {

/// The flags as typed.
struct StudyFlags {
    std::filesystem::path file, trace;
    std::string backend = "auto", frames, out;
    std::vector<std::string> only;
    JudgingFlags judging;
    bool strict = false, resume = false, quiet = false, no_accuracy = false, list = false;
    std::string store, history, figures;
    int jobs = 0, per = 1;
    std::vector<std::string> expect;
    std::optional<double> cell_minutes, cell_memory_mib;
    std::optional<int> cell_cores;
    std::string executor = "local", partition, gpus;
    bool timed = false, fails_on_change = false, explain = false, plan = false, play = false, collect = false, watch = false;
};

int list_cells(const std::vector<StudyCell>& cells) {
    for (const StudyCell& cell : cells)
        fmt::print("{:<40} {}\n", cell.name, cell.condition);
    return 0;
}

/// The page last: a disk that fills up takes it before it takes the numbers.
void write_study(const StudyResult& result, const std::filesystem::path& folder, const std::optional<HistoryFindings>& history,
                 bool for_paper) {
    oneapi::tbb::parallel_invoke([&] { write_json(folder / "study.json", result, study_members); },
                                 [&] { write_file(folder / "study.csv", [&](const TakePiece& take) { study_csv(result, take); }); });
    std::vector<std::string> papers;
    {
        Document paper = study_paper(result);
        if (history)
            paper.sections.push_back(changes_section(*history)); // the verdict comes first
        for (const OutputFormat& format : output_formats())
            if (format.for_papers)
                write_file(folder / papers.emplace_back(std::string("study") + format.extension), format.of_document(paper));
    }
    if (for_paper)
        write_paper(paper_figures(result), paper_tables(result), folder / "paper");
    write_file(folder / "junit.xml", report_junit(suites_of(result)));
    write_file(folder / "study.yaml", result.study.text);
    Document page = document(result, papers);
    if (history) {
        std::vector<Section> changes = history_sections(*history);
        page.sections.insert(page.sections.begin(), std::make_move_iterator(changes.begin()), std::make_move_iterator(changes.begin() + 1));
        page.sections.insert(page.sections.end(), std::make_move_iterator(changes.begin() + 1), std::make_move_iterator(changes.end()));
    }
    write_document(page, result, folder, "report");
}

/// Tonight against the last accepted night; nothing without --history, and of a study that was interrupted.
std::optional<HistoryFindings> compare_with_history(const StudyFlags& flags, const StudyResult& result, const StudyOptions& options) {
    if (flags.history.empty() || !result.interrupted.empty())
        return std::nullopt;
    return history_of(flags.history, result, options.folder, {.tell_apart = tell_apart_by_playing(result.study, options)});
}

/// Once its report is written: where its disk is full, cells that were played lack readings.
void remember(const StudyFlags& flags, const StudyResult& result, const StudyOptions& options, const HistoryFindings& findings) {
    Night tonight = night_of_study(result, options.folder);
    take_replays(tonight, findings.replays);
    History(flags.history, History::For::collecting).add(tonight);
    if (!result.played_in_part.empty())
        tell(LogLevel::warning, fmt::format("{}: this night played only part of the study. {}.", flags.history, result.played_in_part));
}

/// Before somebody plans hours of work on it. A store that is not there yet is not made: its name may be mistyped.
void warn_of_unwritable(const CellStore& store, std::size_t cells_to_play) {
    if (cells_to_play == 0)
        return;
    std::error_code ignored;
    std::filesystem::path place = std::filesystem::absolute(store.folder());
    while (!std::filesystem::exists(place, ignored) && place.has_relative_path())
        place = place.parent_path();
    const std::string why = place != std::filesystem::absolute(store.folder())
                                ? ::access(place.c_str(), W_OK) == 0 ? "" : place.string() + ": cannot be written"
                                : store.refuses_writing();
    if (!why.empty())
        tell(LogLevel::warning, fmt::format("the store cannot be written here, so nothing can be played into it: {}", why));
}

/// Why each cell that the store lacks must be played.
int explain_cells(const Study& study, const StudyOptions& options) {
    const StudyPlan plan = plan_study(study, options);
    const CellStore store(options.store);
    const std::vector<std::size_t> cells = lacking_cells(store, plan, true);
    const auto reasons = reasons_to_play(study, plan, cells, store);
    for (std::size_t i = 0; i < cells.size(); ++i)
        fmt::print("{:<40} {}\n", plan.cells[cells[i]].cell.name, fmt::join(reasons[i], "; "));
    std::error_code ignored;
    fmt::print("{} of {} cells would be played; store {}{}\n", cells.size(), plan.cells.size(), options.store.string(),
               std::filesystem::exists(options.store, ignored) ? "" : ", which is not there yet");
    warn_of_unwritable(store, cells.size());
    return 0;
}

/// A line of JSON for each command that plays some of the cells that the store lacks.
int print_plan(const Study& study, const StudyOptions& options) {
    const StudyPlan plan = plan_study(study, options);
    const CellStore store(options.store);
    const std::vector<std::size_t> lacking = lacking_cells(store, plan, true);
    warn_of_unwritable(store, lacking.size());
    const std::size_t per = static_cast<std::size_t>(options.per);
    for (std::size_t from = 0; from < lacking.size(); from += per) {
        const std::vector<std::size_t> some(lacking.begin() + static_cast<std::ptrdiff_t>(from),
                                            lacking.begin() + static_cast<std::ptrdiff_t>(std::min(lacking.size(), from + per)));
        nlohmann::ordered_json cells = nlohmann::ordered_json::array();
        for (const std::size_t i : some)
            cells.push_back(plan.cells[i].cell.name);
        const std::vector<std::string> words = playing_command(study, plan, some, options);
        fmt::print("{}\n", nlohmann::ordered_json{{"cells", cells}, {"words", words}, {"command", shell_quoted(words)}}.dump());
    }
    return 0;
}

/// The study's own, but for what flags say.
StudyResources resources_of(const StudyFlags& flags, const Study& study) {
    StudyResources resources = study.resources;
    resources.minutes = flags.cell_minutes.value_or(resources.minutes);
    resources.memory_mib = flags.cell_memory_mib.value_or(resources.memory_mib);
    resources.cores = flags.cell_cores.value_or(resources.cores);
    if (!flags.partition.empty())
        resources.partition = flags.partition;
    if (!flags.gpus.empty())
        resources.gpus = flags.gpus;
    return resources;
}

void refuse_contradictions(const StudyFlags& flags) {
    if (flags.fails_on_change && flags.history.empty())
        throw InputError({{}, 0, 0, "--fail-on-change"}, "found without --history", "both");
    const int ways = flags.explain + flags.plan + flags.play + flags.collect + flags.list;
    if (ways > 1)
        throw InputError({{}, 0, 0, "study"}, "found several of --list, --explain, --plan, --play and --collect", "one of them");
    if (flags.executor != "local" && (ways > 0 || flags.timed))
        throw InputError({{}, 0, 0, "--executor"}, "found beside --timed, --list, --explain, --plan, --play or --collect",
                         "it without these");
    const auto refuse_without = [](bool is_there, bool may_be, const char* flag, const char* needs) {
        if (is_there && !may_be)
            throw InputError({{}, 0, 0, flag}, std::string("found without ") + needs, "both together");
    };
    const bool slurm = flags.executor == "slurm";
    refuse_without(!flags.partition.empty(), slurm, "--partition", "--executor slurm");
    refuse_without(!flags.gpus.empty(), slurm, "--gpus", "--executor slurm");
    refuse_without(flags.per > 1, slurm || flags.plan, "--per", "--plan or --executor slurm");
    refuse_without(!flags.expect.empty(), flags.play, "--expect", "--play");
    if ((flags.cell_minutes || flags.cell_memory_mib) && ways > 0)
        throw InputError({{}, 0, 0, flags.cell_minutes ? "--cell-minutes" : "--cell-memory-mib"},
                         "found beside --list, --explain, --plan, --play or --collect, which start no processes with limits",
                         "it without these; whoever runs the commands of --plan limits them");
    if (!flags.history.empty() && ways > 0 && !flags.collect)
        throw InputError({{}, 0, 0, "--history"}, "found beside --list, --explain, --plan or --play, which make no night",
                         "it without these");
    if (!flags.out.empty() && ways > 0 && !flags.collect)
        throw InputError({{}, 0, 0, "--out"}, "found beside --list, --explain, --plan or --play, which write no report",
                         "it without these");
    if (flags.watch && (ways > 0 || flags.timed || flags.resume || slurm || !flags.history.empty() || !flags.trace.empty()))
        throw InputError(
            {{}, 0, 0, "--watch"},
            "found beside --list, --explain, --plan, --play, --collect, --timed, --resume, --executor slurm, --history or --trace",
            "it without these");
    if (flags.timed && (ways > 0 || flags.jobs > 1))
        throw InputError({{}, 0, 0, "--timed"}, "found beside what plays several cells at a time or none",
                         "--timed by itself: cells are played one after another");
}

/// What is waited for with --watch: its drives, and lamps as each drive has them.
void read_by(const Study& study, WatchTurn& turn) {
    turn.reads(study.opened);
    for (const std::filesystem::path& drive : study.drives)
        turn.reads(drive);
    for (const StudyLamp& lamp : study.lamps)
        for (const std::filesystem::path* const file : {&lamp.left, &lamp.right, &lamp.high, &lamp.recipe})
            turn.reads(*file);
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const StudyCell& cell : cells_of(study))
        if (seen.emplace(cell.drive, cell.lamp).second) {
            const Drive drive = cell_drive(study, cell);
            turn.reads(drive.opened);
            turn.reads(drive.road_file);
        }
}

/// What a store takes out of its folder must not be a report.
void refuse_store(const std::filesystem::path& out, const std::filesystem::path& store) {
    if (std::error_code ignored; std::filesystem::exists(store, ignored) && !std::filesystem::is_directory(store, ignored))
        throw InputError({store, 0, 0, "--store"}, "is not a folder", "a new one, or one that `fernlicht study` made");
    const std::filesystem::path of_out = std::filesystem::weakly_canonical(out), of_store = std::filesystem::weakly_canonical(store);
    const auto lies_in = [](const std::filesystem::path& inner, const std::filesystem::path& outer) {
        return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
    };
    if (!store.empty() && (lies_in(of_out, of_store) || lies_in(of_store, of_out)))
        throw InputError({{}, 0, 0, "--store"}, "found " + printable(store.string(), 400) + ", where the report is to lie, too",
                         "a folder outside --out, and --out outside it");
}

/// Limits where they are set; all else by the study's file, which is the user's own: its drives may be shipped ones.
void annotate_study(const StudyResult& result) {
    const Report suites = suites_of(result);
    for (std::size_t i = 0; i < suites.played.size(); ++i)
        for (const Verdict& verdict : suites.played[i].verdicts)
            annotate_red(verdict, suites.played[i].drive + ": ",
                         {verdict.line > 0 && i < result.cells.size() ? result.study.drives[result.cells[i].cell.drive] : result.study.file,
                          verdict.line,
                          0,
                          {}});
    if (!result.interrupted.empty())
        annotate({result.study.file, 0, 0, {}}, "incomplete", result.interrupted);
}

int study(const StudyFlags& flags, const std::vector<std::string>& command, WatchTurn& turn) {
    refuse_contradictions(flags);
    if (flags.file == "-")
        refuse_flag("STUDY", "-", "a file: processes of their own read it to play its cells");
    const std::filesystem::path file = named_file("study", flags.file, "STUDY");
    turn.reads(file);
    const Study study = read_study(file);
    if (flags.watch)
        read_by(study, turn);
    if (flags.list) {
        refuse_unaimable(study);
        refuse_unknown_readings(study);
        const std::vector<StudyCell> cells = chosen_cells(study, items_of("--only", flags.only));
        for (const StudyCell& cell : cells)
            cell_drive(study, cell); // throws for what a drive refuses
        return list_cells(cells);
    }
    if (flags.resume && flags.out.empty())
        throw InputError({{}, 0, 0, "--resume"}, "found no --out beside it", "the folder to go on in");
    StudyOptions options;
    options.folder = turn.folder(result_folder(flags.out, study.name));
    options.store = flags.store.empty() && (!flags.timed || !flags.history.empty()) ? default_store() : std::filesystem::path(flags.store);
    refuse_store(options.folder, options.store);
    options.timed = flags.timed;
    options.times_too = !flags.history.empty();
    options.jobs = flags.jobs;
    options.resources = resources_of(flags, study);
    options.executor = flags.executor == "slurm" ? StudyExecutor::slurm : StudyExecutor::local;
    options.per = flags.per;
    options.only = items_of("--only", flags.only);
    for (const std::string& text : flags.expect) {
        if (const std::size_t at = text.rfind('='); at == std::string::npos || at == 0 || text.size() - at != 33 ||
                                                    text.find_first_not_of("0123456789abcdef", at + 1) != std::string::npos)
            throw InputError({{}, 0, 0, "--expect"}, "found '" + printable(text) + "'", "CELL=KEY, as --plan prints it");
        options.expected.emplace_back(text.substr(0, text.rfind('=')), text.substr(text.rfind('=') + 1));
        options.only.push_back(options.expected.back().first);
    }
    options.strict = flags.strict;
    options.resume = flags.resume;
    options.run.backend = flags.backend;
    options.run.ticks = tick_range(flags.frames);
    options.run.quiet = flags.quiet;
    options.run.accuracy = !flags.no_accuracy;
    options.known = take(flags.judging, options.run);
    options.run.command = command;
    options.run.write = [](const Report& report, const std::filesystem::path& cell) { write_report(report, cell); };
    std::string no_history; ///< why; it costs nobody the report
    std::optional<HistoryFindings> findings;
    options.write = [&](StudyResult& result) {
        const auto try_history = [&](const std::function<void()>& does) {
            try {
                does();
            } catch (const std::exception& error) {
                no_history = error.what();
            }
        };
        try_history([&] { findings = compare_with_history(flags, result, options); });
        if (flags.fails_on_change && findings)
            result.verdicts.push_back(
                {findings->is_off_base() ? VerdictKind::fail : VerdictKind::pass, unchanged_verdict,
                 std::get<std::string>(changes_section(*findings).blocks.front()),
                 shell_quoted({command.front(), "history", "explain", "--study", result.study.name, "--history", flags.history})});
        write_study(result, options.folder, findings, flags.figures == "paper");
        turn.page_written();
        if (findings)
            try_history([&] { remember(flags, result, options, *findings); });
    };
    options.judge_cell = [](const Report& report, const std::filesystem::path& cell) { write_judgement(report, cell); };
    if (flags.explain)
        return explain_cells(study, options);
    if (flags.plan)
        return print_plan(study, options);
    if (!flags.history.empty())
        History(flags.history, History::For::collecting); // before hours are spent on what it cannot take
    TraceFile trace(
        flags.trace,
        fmt::format("fernlicht study {}{}", study.name, flags.play ? ": " + fmt::format("{}", fmt::join(options.only, ", ")) : ""),
        flags.play ? std::filesystem::path() : options.folder);
    if (flags.play) {
        const bool all_there = play_into_store(study, options);
        if (Interruption::requested())
            tell(LogLevel::warning, Interruption::words());
        trace.finish();
        return all_there ? 0 : 1;
    }
    const StudyResult result = flags.collect ? collect_study(study, options) : run_study(study, options);
    for (const std::vector<std::string>& warnings : {lamp_warnings(result.lamp_files), result.warnings})
        for (const std::string& warning : warnings)
            tell(LogLevel::warning, warning);
    Document summary = study_summary(result);
    if (findings)
        summary.sections.insert(summary.sections.begin(), changes_section(*findings));
    fmt::print("{}{}\n{}\n", document_text(summary), result.played_by, page_link(turn.page()));
    annotate_study(result);
    trace.finish();
    if (!no_history.empty())
        throw DeviceError("the report is written, but not into the history: " + no_history);
    return overall(result) == VerdictKind::pass ? 0 : met_full_disk(result) ? 3 : 1;
}

} // namespace

void add_study_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<StudyFlags>();
    CLI::App* sub = app.add_subcommand("study", "play lamps x drives x techniques x conditions, and report what differs beyond noise");
    add_shared(*sub, "STUDY", flags->file)->required();
    add_shared(*sub, "--out", flags->out);
    add_shared(*sub, "--resume", flags->resume);
    add_shared(*sub, "--backend", flags->backend);
    add_shared(*sub, "--frames", flags->frames);
    add_judging_flags(*sub, flags->judging);
    add_shared(*sub, "--strict", flags->strict);
    add_shared(*sub, "--no-accuracy", flags->no_accuracy);
    add_shared(*sub, "--only", flags->only);
    add_shared(*sub, "--trace", flags->trace);
    sub->add_option("--figures", flags->figures,
                    "write figures at column width as PDF and SVG, captions, data and LaTeX tables into the folder paper, too")
        ->check(CLI::IsMember({"paper"}))
        ->option_text("paper");
    add_shared(*sub, "--list", flags->list);
    add_shared(*sub, "--store", flags->store);
    sub->add_option("--jobs", flags->jobs, "cells to play at a time")
        ->check(CLI::Range(1, 1024))
        ->default_str("one per core; with a GPU at most 4");
    sub->add_flag("--timed", flags->timed, "play cells one at a time and time them; take none from the store");
    sub->add_option("--cell-minutes", flags->cell_minutes, "stop a cell that takes longer")
        ->check(CLI::Range(0.001, 1e5))
        ->default_str("the study's `resources`");
    sub->add_option("--cell-memory-mib", flags->cell_memory_mib, "memory that a cell may take; 0: no limit")->check(CLI::Range(0.0, 1e7));
    sub->add_option("--cell-cores", flags->cell_cores, "cores for each cell")
        ->check(CLI::Range(1, 1024))
        ->default_str("1; all with --jobs 1");
    sub->add_option("--executor", flags->executor, "where to play: here, or as job arrays of a cluster")
        ->check(CLI::IsMember({"local", "slurm"}))
        ->capture_default_str();
    sub->add_option("--partition", flags->partition, "partition of the cluster to submit to")->option_text("NAME");
    sub->add_option("--gpus", flags->gpus, "GPUs of the cluster for each cell, as --gres has it: gpu:1")->option_text("GRES");
    add_shared(*sub, "--history", flags->history);
    add_shared(*sub, "--fail-on-change", flags->fails_on_change);
    sub->add_flag("--explain", flags->explain, "say of each cell that the store lacks why, and play nothing");
    sub->add_flag("--plan", flags->plan, "print a command for each cell that the store lacks, a line of JSON each, and play nothing");
    sub->add_option("--per", flags->per, "cells for each command of --plan, and for each task of a cluster")
        ->check(CLI::Range(1, 100'000))
        ->capture_default_str();
    sub->add_flag("--play", flags->play, "play missing cells into the store, in this process, and write no report");
    sub->add_option("--expect", flags->expect, "with --play: a cell and the key that --plan gave it")
        ->option_text("CELL=KEY")
        ->allow_extra_args(false);
    sub->add_flag("--collect", flags->collect, "write the report from the store alone, and play nothing");
    add_shared(*sub, "--quiet", flags->quiet);
    sub->footer(
        "With --history the report leads with what changed since the last accepted night, and tonight is added. docs/studies.md tells "
        "more.");
    add_watch_flag(*sub, flags->watch);
    sub->callback([flags, command, &chosen] {
        chosen = [flags, command] { return watched(flags->watch, [&](WatchTurn& turn) { return study(*flags, command, turn); }); };
    });
}

} // namespace fernlicht
