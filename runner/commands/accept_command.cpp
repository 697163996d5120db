#include "runner/commands/accept_command.h"

#include "runner/commands/commands.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/run/run_report.h"
#include "runner/files/output_folder.h"
#include "runner/judge/baselines.h"
#include "runner/judge/reference_results.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// Throws InputError for one that did not end, and where a report of others would lead out of the run's folder.
void refuse_unfit(const PlayedCell& played, const std::filesystem::path& report) {
    if (played.ticks_done != played.ticks_planned)
        throw InputError({report, 0, 0, "ticks_done"}, fmt::format("found '{}'", played.ticks_done),
                         "all moments that were planned: an incomplete run is no baseline");
    for (const StoredFrame& frame : played.frames)
        if (const std::filesystem::path path = frame.exr;
            path.is_absolute() || std::ranges::find(path, std::filesystem::path("..")) != path.end())
            throw InputError({report, 0, 0, "exr"}, "found '" + printable(frame.exr) + "'", "a path below the run's folder");
}

/// "3f2a91c04b7e  straight/halogen/photometric: new"
std::string stored_text(const Baseline& baseline, const Stored& stored) {
    const std::string removed = stored.removed > 0 ? fmt::format(", in place of {}", stored.removed) : "";
    return fmt::format("{}  {}: {}{}", short_id(stored.id), cell_text(baseline.key), stored.is_new ? "new" : "accepted before", removed);
}

struct AcceptFlags {
    std::string run, baselines = "baselines", note;
    bool also = false, replace = false, replace_class = false, readings_only = false;
};

int accept(const AcceptFlags& flags) {
    if (flags.also + flags.replace + flags.replace_class > 1)
        throw InputError({{}, 0, 0, "accept"}, "found more than one of --also, --replace and --replace-class", "one of them");
    if (flags.also && flags.note.empty())
        throw InputError({{}, 0, 0, "--also"}, "found no --note",
                         "the reason why several results are right, e.g. --note \"two drivers round differently\"");
    const Acceptance how = flags.also            ? Acceptance::add
                           : flags.replace       ? Acceptance::replace
                           : flags.replace_class ? Acceptance::replace_class
                                                 : Acceptance::first;
    const Accepted accepted = accept_run(flags.run, flags.baselines, how, flags.note, flags.readings_only);
    std::size_t frames = 0, readings = 0;
    for (std::size_t i = 0; i < accepted.baselines.size(); ++i) {
        frames += accepted.baselines[i].frames.size();
        readings += accepted.baselines[i].readings.size();
        fmt::print("{}\n", stored_text(accepted.baselines[i], accepted.stored[i]));
    }
    for (const std::string& id : accepted.others)
        fmt::print("{} of other inputs stays: `fernlicht baselines remove {}` removes it if it is no longer right\n", id, id);
    fmt::print("accepted into {}: {} lamp sets with {} frames and {} readings{}\n", flags.baselines, accepted.baselines.size(), frames,
               readings, flags.readings_only ? "; frames were left out" : "");
    return 0;
}

/// A folder of `fernlicht study`: its cells are runs.
bool is_study_folder(const std::filesystem::path& folder) {
    std::error_code ignored;
    return std::filesystem::exists(folder / "study.json", ignored) && std::filesystem::is_directory(folder / "cells", ignored);
}

/// In the order of the cells' names.
std::vector<Baseline> read_cells(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> cells;
    for (const std::filesystem::directory_entry& cell : std::filesystem::directory_iterator(folder / "cells"))
        cells.push_back(cell.path());
    std::ranges::sort(cells);
    std::vector<Baseline> all;
    for (const std::filesystem::path& cell : cells)
        std::ranges::move(read_run(cell), std::back_inserter(all));
    return all;
}

} // namespace

std::vector<Baseline> read_run(const std::filesystem::path& run_folder) {
    if (is_reference_folder(run_folder))
        return {read_ray_folder(run_folder)};
    if (is_marked_incomplete(run_folder))
        throw InputError({run_folder, 0, 0, {}}, "holds an incomplete run", "a complete one");
    if (is_study_folder(run_folder))
        return read_cells(run_folder);
    if (std::error_code ignored; !std::filesystem::exists(run_folder / "report.json", ignored))
        throw InputError({run_folder, 0, 0, {}}, "is no folder of a run, a study or a reference",
                         "one that `fernlicht run`, `study` or `reference` wrote");
    const Report report = read_report(run_folder);
    std::vector<Baseline> results;
    for (const PlayedCell& played : report.played) {
        refuse_unfit(played, run_folder / "report.json");
        results.push_back(results_of(played, report.context, run_folder, played.technique));
    }
    return results;
}

Accepted accept_run(const std::filesystem::path& run_folder, const std::filesystem::path& baselines_folder, Acceptance how,
                    const std::string& note, bool readings_only) {
    std::vector<Baseline> results = read_run(run_folder);
    if (readings_only)
        for (Baseline& baseline : results) {
            if (baseline.readings.empty())
                throw InputError({run_folder, 0, 0, "--readings-only"}, "found no readings in " + printable(cell_text(baseline.key), 200),
                                 "a run that measures");
            baseline.frames.clear();
            baseline.frames_left_out = true;
        }
    Accepted accepted;
    accepted.stored = store_baselines(baselines_folder, results, how, note);
    accepted.baselines = std::move(results);
    for (const StoredBaseline& entry : list_baselines(baselines_folder))
        for (std::size_t i = 0; i < accepted.baselines.size(); ++i)
            if (const BaselineKey& key = accepted.baselines[i].key;
                accepted.stored[i].is_new && same_but_inputs(entry.key, key) && entry.key.inputs != key.inputs)
                accepted.others.push_back(short_id(entry.id));
    return accepted;
}

void add_accept_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto flags = std::make_shared<AcceptFlags>();
    CLI::App* command = app.add_subcommand("accept", "take a run's results as baselines for later runs; judges nothing");
    command->add_option("RUN", flags->run, "folder of a complete run or study, or of a `fernlicht reference` picture")->required();
    add_shared(*command, "--baselines", flags->baselines)->capture_default_str();
    command->add_flag(
        "--replace", flags->replace,
        "replace baselines of the same inputs; a changed lamp needs no --replace, and its former baselines stay: `baselines remove`");
    command->add_flag("--replace-class", flags->replace_class, "replace all baselines of this device class; other classes keep theirs");
    command->add_flag("--also", flags->also, "keep the old baselines, too: a run that agrees with either passes; needs --note");
    command->add_flag("--readings-only", flags->readings_only, "store no frames, a thousandth of the size; pictures are then not compared");
    add_shared(*command, "--note", flags->note);
    command->callback([flags, &chosen] { chosen = [flags] { return accept(*flags); }; });
}

} // namespace fernlicht
