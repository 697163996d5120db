#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/run_files.h"
#include "runner/experiments/study/study_document.h"
#include "runner/experiments/study/study_run.h"
#include "runner/files/log.h"
#include "runner/files/trace_file.h"
#include "runner/judge/verdict_line.h"
#include "runner/write/document.h"
#include "runner/write/report_texts.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct StudyFlags {
    std::filesystem::path file, trace;
    std::string backend = "auto", frames, out;
    std::vector<std::string> only;
    JudgingFlags judging;
    bool strict = false, resume = false, quiet = false, no_accuracy = false, list = false;
};

int list_cells(const std::vector<StudyCell>& cells) {
    for (const StudyCell& cell : cells)
        fmt::print("{:<40} {}\n", cell.name, cell.condition);
    return 0;
}

/// The page last: a disk that fills up takes it before it takes the numbers.
void write_study(const StudyResult& result, const std::filesystem::path& folder) {
    const Document paper = study_paper(result);
    write_file(folder / "study.json", json_text(as_json(result, study_members)));
    write_file(folder / "study.csv", study_csv(result));
    std::vector<std::string> papers;
    for (const OutputFormat& format : output_formats())
        if (format.for_papers)
            write_file(folder / papers.emplace_back(std::string("study") + format.extension), format.of_document(paper));
    write_file(folder / "junit.xml", report_junit(suites_of(result)));
    write_file(folder / "study.yaml", result.study.text);
    write_document(document(result, papers), result, folder, "report");
}

/// All by the study's file, which is the user's own; its drives may be shipped ones.
void annotate_study(const StudyResult& result) {
    const Report suites = suites_of(result);
    for (const PlayedCell& suite : suites.played)
        for (const Verdict& verdict : suite.verdicts)
            annotate_red(verdict, suite.drive + ": ", {result.study.file, 0, 0, {}});
    if (!result.interrupted.empty())
        annotate({result.study.file, 0, 0, {}}, "incomplete", result.interrupted);
}

int study(const StudyFlags& flags, const std::vector<std::string>& command) {
    const Study study = read_study(flags.file);
    if (flags.list) {
        refuse_unaimable(study);
        return list_cells(chosen_cells(study, items_of("--only", flags.only)));
    }
    if (flags.resume && flags.out.empty())
        throw InputError({{}, 0, 0, "--resume"}, "found no --out beside it", "the folder to go on in");
    StudyOptions options;
    options.folder = result_folder(flags.out, study.name);
    options.only = items_of("--only", flags.only);
    options.strict = flags.strict;
    options.resume = flags.resume;
    options.run.backend = flags.backend;
    options.run.ticks = tick_range(flags.frames);
    options.run.quiet = flags.quiet;
    options.run.accuracy = !flags.no_accuracy;
    options.known = take(flags.judging, options.run);
    options.run.command = command;
    options.run.write = [](const Report& report, const std::filesystem::path& cell) { write_report(report, cell); };
    options.write = [&](const StudyResult& result) { write_study(result, options.folder); };
    TraceFile trace(flags.trace, "fernlicht study " + study.name, options.folder);
    const StudyResult result = run_study(study, options);
    fmt::print("{}{}\n", document_text(study_summary(result)), (options.folder / "report.html").string());
    annotate_study(result);
    trace.finish();
    return overall(result) == VerdictKind::pass ? 0 : 1;
}

} // namespace

void add_study_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<StudyFlags>();
    CLI::App* sub = app.add_subcommand("study", "play lamps x drives x techniques x conditions, and report what differs beyond noise");
    sub->add_option("FILE", flags->file, "study file (YAML)")->required();
    sub->add_option("--out", flags->out, "new or empty folder for the report");
    sub->add_flag("--resume", flags->resume,
                  "continue in the --out folder of this study: keep finished cells, play the others, write the report again");
    sub->add_option("--backend", flags->backend, backend_names);
    sub->add_option("--frames", flags->frames, "FIRST:LAST: play these moments of each drive only, counted from 0");
    add_judging_flags(*sub, flags->judging);
    sub->add_flag("--strict", flags->strict, strict_text);
    sub->add_flag("--no-accuracy", flags->no_accuracy, "do not compare moments of each cell with the reference");
    sub->add_option("--only", flags->only, "comma-separated names of cells, * and ? allowed: 'straight*,*xenon'")->allow_extra_args(false);
    add_trace_flag(*sub, flags->trace);
    sub->add_flag("--list", flags->list, "list the cells and play none");
    sub->add_flag("--quiet", flags->quiet, "show no progress");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return study(*flags, command); }; });
}

} // namespace fernlicht
