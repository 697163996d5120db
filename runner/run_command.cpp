#include "runner/run_command.h"

#include "runner/flag_values.h"
#include "runner/output_folder.h"
#include "runner/run_context.h"
#include "runner/run_drives.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct Flags {
    std::vector<std::filesystem::path> drives;
    std::vector<std::string> lamps;
    std::string road, technique, resolution, frames, capture, backend = "auto", out, references, known, today;
    int repeats = 1;
    bool across_devices = false, quiet = false, profile = false, contact_sheet = false, no_accuracy = false;
};

DriveEdits edits_of(const Flags& flags) {
    DriveEdits edits;
    for (const std::string& lamp : flags.lamps) {
        const std::size_t at = lamp.find('=');
        edits.lamps.emplace_back(at == std::string::npos ? "" : lamp.substr(0, at), at == std::string::npos ? lamp : lamp.substr(at + 1));
    }
    if (!flags.road.empty())
        edits.road = flags.road;
    if (!flags.technique.empty())
        edits.technique = flags.technique;
    if (!flags.resolution.empty())
        edits.resolution = resolution_of(flags.resolution);
    if (!flags.capture.empty()) {
        if (flags.capture != "all")
            refuse_flag("--capture", flags.capture, "all");
        edits.capture_all = true;
    }
    return edits;
}

/// The only place that asks the clock for the day.
std::string today_of(const Flags& flags) {
    if (flags.today.empty())
        return utc_now().substr(0, 10);
    if (!is_date(flags.today))
        refuse_flag("--today", flags.today, "a date, e.g. 2026-12-31");
    if (flags.known.empty())
        refuse_flag("--today", flags.today, "--known beside it: nothing else asks for the day");
    return flags.today;
}

const char* word_for(const Verdict& verdict) {
    if (verdict.expectation == Expectation::unexpected_pass)
        return "UNEXPECTED PASS";
    if (verdict.expectation == Expectation::known)
        return "known";
    return verdict.kind == VerdictKind::fail ? "FAIL" : verdict.kind == VerdictKind::flaky ? "FLAKY" : "NOT MEASURED";
}

void print_verdict(const Verdict& verdict, const std::string& subject) {
    if (verdict.kind != VerdictKind::pass || is_red(verdict))
        fmt::print("{} {}{}: {}{}{}\n", word_for(verdict), subject, verdict.name, verdict.text, verdict.known.empty() ? "" : "; ",
                   verdict.known);
}

/// What is not plainly green, one line each, and how many there are of each kind.
void print_verdicts(const Report& report) {
    for (const PlayedVariant& played : report.played)
        for (const Verdict& verdict : played.verdicts)
            print_verdict(verdict, fmt::format("{}, {}: ", played.drive, played.variant));
    for (const Verdict& verdict : report.listed)
        print_verdict(verdict, "known failures: ");
    for (const std::string& warning : report.warnings)
        fmt::print("warning: {}\n", warning);
    const VerdictCounts counts = count_verdicts(report);
    if (counts.all() == 0)
        return;
    std::string line;
    const auto add = [&](std::size_t count, const char* what) {
        if (count > 0)
            line += fmt::format("{}{} {}", line.empty() ? "" : ", ", count, what);
    };
    add(counts.pass, "passed");
    add(counts.fail, "failed");
    add(counts.not_measured, "not measured");
    add(counts.flaky, "flaky");
    add(counts.known, "known");
    add(counts.unexpected_pass, "passed unexpectedly");
    fmt::print("{}\n", line);
}

int run(const Flags& flags, const std::vector<std::string>& command) {
    RunOptions options;
    options.backend = flags.backend;
    options.ticks = tick_range(flags.frames);
    options.quiet = flags.quiet;
    options.profile = flags.profile;
    options.contact_sheet = flags.contact_sheet;
    options.accuracy = !flags.no_accuracy;
    options.references = flags.references;
    options.across_devices = flags.across_devices;
    if (flags.across_devices && flags.references.empty())
        throw InputError({{}, 0, 0, "--across-devices"}, "found no --references", "the folder of accepted results");
    options.repeats = flags.repeats;
    options.command = command;
    if (!flags.known.empty())
        options.known = read_known_failures(flags.known);
    options.today = today_of(flags);
    const DriveEdits edits = edits_of(flags);
    std::vector<Drive> drives;
    for (const std::filesystem::path& file : flags.drives)
        drives.push_back(read_drive(file, edits));
    refuse_equal_names(drives);
    options.folder = flags.out.empty() ? default_output_folder(drives.front().name, utc_now()) : std::filesystem::path(flags.out);
    const Report report = run_drives(drives, options);
    const VerdictKind verdict = overall(report);
    print_verdicts(report);
    if (!report.complete)
        fmt::print("incomplete: {}\n", report.interrupted);
    fmt::print("{}\n", (options.folder / "report.html").string());
    return report.complete && verdict == VerdictKind::pass ? 0 : 1;
}

} // namespace

TickRange tick_range(const std::string& frames) {
    TickRange range;
    if (frames.empty())
        return range;
    const auto [first, last] = two_numbers("--frames", frames, ':', true, "FIRST:LAST with FIRST <= LAST, e.g. 0:59");
    range.first = first < 0 ? 0 : first;
    range.last = last < 0 ? range.last : last;
    if (range.first > range.last)
        refuse_flag("--frames", frames, "FIRST:LAST with FIRST <= LAST, e.g. 0:59");
    return range;
}

void add_run_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<Flags>();
    CLI::App* sub = app.add_subcommand("run", "play drives, measure, and write a report");
    sub->add_option("DRIVE", flags->drives, "drive files (YAML)")->required();
    sub->add_option("--lamp", flags->lamps, "[SIDE=]FILE: use this lamp file, on all lamps or on those whose name holds SIDE (left, right)")
        ->allow_extra_args(false);
    sub->add_option("--road", flags->road, "OpenDRIVE file to drive on instead");
    sub->add_option("--technique", flags->technique, "how to light the scene");
    sub->add_option("--backend", flags->backend, "auto, egl, egl-device=N or osmesa");
    sub->add_option("--resolution", flags->resolution, "WIDTHxHEIGHT of the perspective views");
    sub->add_option("--frames", flags->frames, "FIRST:LAST moments to play, from 0");
    sub->add_option("--capture", flags->capture, "all: store every frame");
    sub->add_option("--references", flags->references, "folder of accepted results to judge against");
    sub->add_flag("--across-devices", flags->across_devices,
                  "where nothing is accepted for this class of device, judge by the spread over two or more others");
    sub->add_option("--repeat", flags->repeats, "plays of each lamp set; results that differ in a byte are flaky, which is red")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    sub->add_option("--known", flags->known, "YAML list of known failures and flakes, each with reason and expiry");
    sub->add_option("--today", flags->today, "YYYY-MM-DD by which known failures expire; else the clock's day, UTC");
    sub->add_option("--out", flags->out, "folder for the report; must not exist or be empty");
    sub->add_flag("--profile", flags->profile, "time each pass (slows the frames down)");
    sub->add_flag("--contact-sheet", flags->contact_sheet, "add one moment drawn in every technique");
    sub->add_flag("--no-accuracy", flags->no_accuracy, "leave out how far a few moments lie from the reference");
    sub->add_flag("--quiet", flags->quiet, "no progress");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return run(*flags, command); }; });
}

} // namespace fernlicht
