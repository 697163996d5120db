#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "renderer/technique.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/run_files.h"
#include "runner/commands/watch.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/run/run_document.h"
#include "runner/experiments/run/run_drives.h"
#include "runner/files/log.h"
#include "runner/files/page_link.h"
#include "runner/files/trace_file.h"
#include "runner/judge/verdict_line.h"
#include "runner/write/document.h"
#include "scenarios/studies/study.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace fernlicht {
namespace {

/// The flags as typed.
struct RunFlags {
    std::vector<std::filesystem::path> drives;
    std::vector<std::string> lamps;
    std::filesystem::path recipe, trace;
    RunOptions options;
    std::string road, technique, dressing, resolution, frames, capture, out;
    const OutputFormat* tables = nullptr;
    JudgingFlags judging;
    std::vector<std::string> road_folders;
    std::string replay, ego, can_start, can_channel;
    std::optional<std::string> can_log, shadows, aim;
    bool lenient = false, no_accuracy = false, watch = false;
};

DriveEdits edits_of(const RunFlags& flags) {
    DriveEdits edits;
    edits.lamps = lamps_of(flags.lamps);
    edits.lamp_recipe = flags.recipe;
    if (flags.aim)
        edits.aim = *flags.aim == "auto"    ? BeamAim::automatic
                    : *flags.aim == "as-is" ? BeamAim::as_is
                                            : (refuse_flag("--aim", *flags.aim, aim_expected), BeamAim::as_is);
    if (!flags.road.empty())
        edits.road = flags.road;
    if (!flags.technique.empty())
        edits.technique = std::string(technique_named(flags.technique, {}, "--technique").name);
    if (flags.shadows)
        edits.shadows = name(shadow_method_named(*flags.shadows, {}, "--shadows"));
    set_dressing(edits, flags.dressing);
    if (!flags.resolution.empty())
        edits.resolution = resolution_of(flags.resolution);
    for (const std::string& folder : flags.road_folders)
        edits.road_folders.emplace_back(folder);
    edits.lenient = flags.lenient;
    edits.ego = flags.ego;
    if (!flags.replay.empty())
        edits.replay = flags.replay;
    if (flags.can_log)
        edits.can_log = *flags.can_log == "none" ? "" : *flags.can_log;
    if (!flags.can_start.empty())
        edits.can_start_ns = nanoseconds_of("--can-start", flags.can_start);
    if (!flags.can_channel.empty())
        edits.can_channel = flags.can_channel;
    if (!flags.capture.empty()) {
        if (flags.capture != "all")
            refuse_flag("--capture", flags.capture, "all");
        edits.capture_all = true;
    }
    return edits;
}

/// Where the user's files say what a verdict is about: the limit's line, or the drive.
InputError::Where place_of(const Verdict& verdict, const std::string& name, const std::vector<Drive>& drives) {
    const auto drive = std::ranges::find(drives, name, &Drive::name);
    if (drive == drives.end())
        return {};
    return {drive->file, verdict.line, 0, {}};
}

/// What is not plainly green, one line each, and how many there are of each kind.
void print_verdicts(const Report& report, const std::vector<Drive>& drives) {
    for (const PlayedCell& played : report.played)
        for (const Verdict& verdict : played.verdicts) {
            const std::string subject = fmt::format("{}, {}: ", played.drive, played.lamp_set);
            fmt::print("{}", verdict_line(verdict, subject));
            annotate_red(verdict, subject, place_of(verdict, played.drive, drives));
        }
    for (const Verdict& verdict : report.listed) {
        fmt::print("{}", verdict_line(verdict, "known failures: "));
        annotate_red(verdict, "known failures: ", {});
    }
    const VerdictCounts counts = count_verdicts(report);
    if (counts.all() == 0)
        return;
    std::string line;
    const auto add = [&](std::size_t count, const char* what) {
        if (count > 0)
            line += fmt::format("{}{} {}", line.empty() ? "verdicts: " : ", ", count, what);
    };
    add(counts.pass, "passed");
    add(counts.fail, "failed");
    add(counts.not_measured, "not measured");
    add(counts.flaky, "flaky");
    add(counts.known, "known");
    add(counts.unexpected_pass, "passed unexpectedly");
    fmt::print("{}\n", line);
}

/// What whoever changes a lamp looks at: readings that decide, and those that have limits.
std::vector<std::pair<std::string, std::string>> figures_of(const Report& report) {
    std::vector<std::pair<std::string, std::string>> figures;
    for (const PlayedCell& played : report.played)
        for (const Reading& reading : played.readings) {
            const std::string name = reading.name();
            const auto fits = [&](const std::string& pattern) { return matches(pattern, name); };
            const auto is_limit = [&](const Verdict& verdict) { return verdict.name == name; };
            if (!std::ranges::any_of(decides_by_default(), fits) && std::ranges::none_of(played.verdicts, is_limit))
                continue;
            const std::optional<double> figure = reading.value.figure();
            figures.emplace_back(fmt::format("{}, {}: {}", played.drive, played.lamp_set, name),
                                 figure ? with_bound(reading.value, fmt::format("{:.4g} {}", *figure, reading.unit())) : "not measured");
        }
    return figures;
}

/// What stays of a lamp whose file is replaced: filaments get dimmer with less than their file's voltage, and warm.
void tell_kept_sources(const RunFlags& flags, const std::vector<Drive>& drives) {
    if (flags.lamps.empty())
        return;
    for (const Drive& drive : drives)
        for (const MountedLamp& lamp : drive.lamp_sets.front().lamps)
            if (lamp.source == SourceKind::filament && lamp.name.find("high") == std::string::npos) {
                tell(LogLevel::info,
                     fmt::format("{}: --lamp replaces the file alone: the lamp stays a filament at {:g} V; an LED is a lamp set "
                                 "with source: led (docs/drives.md)",
                                 drive.name, lamp.voltage_v));
                break;
            }
}

int run(const RunFlags& flags, const std::vector<std::string>& command, WatchTurn& turn) {
    RunOptions options = flags.options;
    options.ticks = tick_range(flags.frames);
    options.accuracy = !flags.no_accuracy;
    options.known = take(flags.judging, options);
    options.write = [&](const Report& report, const std::filesystem::path& folder) {
        write_report(report, folder, flags.tables);
        turn.page_written();
    };
    options.write_plot = [&options](const Plot& plot) { write_plot(plot, options.folder / plot.name); };
    options.command = command;
    const DriveEdits edits = edits_of(flags);
    std::vector<Drive> drives;
    for (const std::filesystem::path& named : flags.drives) {
        const std::filesystem::path file = named_file("drive", named, "DRIVE");
        turn.reads(file);
        drives.push_back(read_drive(file, edits));
        turn.reads(drives.back().opened);
        turn.reads(drives.back().road_file);
    }
    refuse_equal_names(drives);
    tell_kept_sources(flags, drives);
    options.folder = turn.folder(result_folder(flags.out, drives.front().name));
    TraceFile trace(flags.trace, "fernlicht run " + drives.front().name, options.folder);
    const Report report = run_drives(drives, options);
    const VerdictKind verdict = overall(report);
    for (const std::string& warning : report.warnings)
        tell(LogLevel::warning, warning);
    turn.reads(report.context.inputs);
    turn.tell_figures(figures_of(report));
    print_verdicts(report, drives);
    for (const ComparedDrive& drive : compared_drives(report))
        if (const std::string sentence = key_sentence(drive); !sentence.empty())
            fmt::print("{}: {}\n", drive.name, sentence);
    if (!report.complete) {
        tell(LogLevel::warning, "incomplete: " + report.interrupted);
        annotate({}, "incomplete", report.interrupted);
    }
    fmt::print("{}\n", page_link(turn.page()));
    trace.finish();
    return report.complete && verdict == VerdictKind::pass ? 0 : 1;
}

} // namespace

void add_run_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<RunFlags>();
    CLI::App* sub = app.add_subcommand("run", "play drives, measure, and write a report");
    add_shared(*sub, "DRIVES", flags->drives)->required();
    add_shared(*sub, "--lamp", flags->lamps);
    add_recipe_flag(*sub, flags->recipe);
    add_shared(*sub, "--aim", flags->aim);
    add_shared(*sub, "--road", flags->road);
    add_shared(*sub, "--road-folder", flags->road_folders);
    add_shared(*sub, "--lenient", flags->lenient);
    sub->add_option("--ego", flags->ego, "entity of the storyboard that is the own car")->option_text("NAME");
    sub->add_option("--replay", flags->replay, "drive-log-DRIVE.csv of a run: take its poses and lamps again")->option_text("FILE");
    add_shared(*sub, "--can-log", flags->can_log);
    add_shared(*sub, "--can-start", flags->can_start)->default_str("that of the log's first frame");
    sub->add_option("--can-channel", flags->can_channel, "take frames of this channel alone")->option_text("NAME");
    add_shared(*sub, "--technique", flags->technique);
    add_shared_taken(*sub, "--shadows", [flags](const std::string& method) { flags->shadows = method; }); // hears of an empty text, too
    add_shared(*sub, "--dressing", flags->dressing);
    add_shared(*sub, "--backend", flags->options.backend);
    add_light_pass_flag(*sub, flags->options.light_pass);
    add_shared(*sub, "--resolution", flags->resolution);
    add_shared(*sub, "--frames", flags->frames);
    sub->add_option("--capture", flags->capture, "store every moment")->option_text("all");
    add_judging_flags(*sub, flags->judging);
    add_shared(*sub, "--strict", flags->options.strict);
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    add_shared(*sub, "--trace", flags->trace);
    sub->add_flag("--profile", flags->options.profile, "time each pass, which slows rendering");
    sub->add_flag("--contact-sheet", flags->options.contact_sheet,
                  "add a sheet of one moment in every technique, tone mapper and shadow method");
    add_shared(*sub, "--no-accuracy", flags->no_accuracy);
    add_shared(*sub, "--quiet", flags->options.quiet);
    sub->footer("All cars of a storyboard have halogen low beams. `--can-log none` plays a drive by its own script.");
    add_watch_flag(*sub, flags->watch);
    sub->callback([flags, command, &chosen] {
        chosen = [flags, command] {
            if (flags->watch && !flags->trace.empty())
                throw InputError({{}, 0, 0, "--watch"}, "found together with --trace", "one of them");
            return watched(flags->watch, [&](WatchTurn& turn) { return run(*flags, command, turn); });
        };
    });
}

} // namespace fernlicht
