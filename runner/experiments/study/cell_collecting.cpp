#include "runner/experiments/study/cell_collecting.h"

#include "metrics/readings/reading_key.h"
#include "runner/experiments/run/run_judging.h"
#include "runner/experiments/run/run_report.h"
#include "runner/files/picture_file.h"
#include "runner/findings/run_context.h"
#include "runner/play/stage.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

std::string folder_name_of(const PlannedCell& planned) { return "cells/" + planned.cell.name; }

/// By the drive that lies in the cell's folder.
std::string repeating(const StudyOptions& options, const PlannedCell& planned) {
    std::vector<std::string> words{options.run.command.empty() ? "fernlicht" : options.run.command.front(), "run",
                                   (options.folder / folder_name_of(planned) / planned.resolved_file).string()};
    if (const std::string frames = frames_text(options.run.ticks); !frames.empty()) {
        words.emplace_back("--frames");
        words.push_back(frames);
    }
    if (options.run.backend != RunOptions().backend)
        words.insert(words.end(), {"--backend", options.run.backend});
    if (!options.run.accuracy)
        words.emplace_back("--no-accuracy");
    return shell_quoted(words);
}

/// Throws InputError for what is no complete report of one drive with one lamp set.
Report report_of_cell(const fs::path& folder) {
    Report report = read_report(folder);
    if (report.played.size() != 1)
        throw InputError({folder / "report.json", 0, 0, "drives"}, fmt::format("found {}", report.played.size()),
                         "one drive with one lamp set");
    return report;
}

/// Limits first, as a run has them; what is said of repeats was found when it was played.
void judge(const Drive& drive, const PlannedCell& planned, const StudyOptions& options, const fs::path& folder, Report& report) {
    PlayedCell& played = report.played.front();
    played.title = lit_title(drive.title, drive.technique);
    std::vector<Verdict> verdicts = limit_verdicts(drive, played);
    std::ranges::move(played.verdicts, std::back_inserter(verdicts));
    played.verdicts = std::move(verdicts);
    RunOptions run = options.run;
    run.folder = folder;
    run.known.reset(); // of the whole study
    report.context.command = shell_quoted(options.run.command);
    report.context.inputs = drive.opened;
    add_inputs(report.context.inputs, *planned.road);
    add_inputs(report.context.inputs, *planned.others);
    judge_whole(report, run);
    const std::string rerun = playing_anew(options, planned.cell);
    for (Verdict& verdict : played.verdicts)
        verdict.rerun = rerun;
}

} // namespace

std::string playing_anew(const StudyOptions& options, const StudyCell& cell) {
    return repeat_command(options.run.command, {"--only", cell.name});
}

CellResult unplayed_cell(const Study& study, const StudyPlan& plan, const PlannedCell& planned) {
    CellResult cell;
    const Drive drive = cell_drive(study, planned.cell);
    cell.cell = planned.cell;
    cell.inputs = plan.inputs(planned);
    cell.key = planned.key;
    cell.title = planned.title;
    cell.step_s = drive.step_s;
    cell.moments = planned.moments;
    cell.moments_of_drive = planned.moments_of_drive;
    for (const SpeedPoint& point : drive.speed)
        cell.step_m = std::max(cell.step_m, point.speed_mps * cell.step_s);
    cell.look_step_m = drive.seeing.visibility ? drive.seeing.visibility->step_m : 0.0;
    cell.grid_cell_m = drive.extent ? drive.extent->cell_m : cell.grid_cell_m;
    std::ranges::copy_if(drive.views, std::back_inserter(cell.maps), [](const View& view) { return view.projection == Projection::map; });
    return cell;
}

std::string changed_since(const Drive& drive, const PlannedCell& planned) {
    const std::vector<std::string> changes =
        input_changes(planned.own_inputs, cell_inputs(drive, *planned.road, *planned.others, planned.settings));
    return changes.empty() ? "" : fmt::format("{} while the study was played; start it again", fmt::join(changes, ", "));
}

void judge_cell(const Study& study, const PlannedCell& planned, const StudyOptions& options, CellResult& result) {
    const fs::path folder = options.folder / folder_name_of(planned);
    const Drive drive = cell_drive(study, planned.cell);
    if (const std::string changed = changed_since(drive, planned); !changed.empty())
        throw DeviceError(changed);
    Report report = report_of_cell(folder);
    judge(drive, planned, options, folder, report);
    write_file(folder / planned.resolved_file, write_drive(drive));
    options.judge_cell(report, folder);
    PlayedResult played = played_result(report.played.front(), read_moments(folder, report, 0), folder_name_of(planned), study.decide);
    for (StoredFrame& frame : played.frames)
        if (!frame.png.empty())
            frame.shown_by = read_png_tags(options.folder / frame.png).shown_by;
    static_cast<Steps&>(played) = result; // the drive's, not the report's
    static_cast<PlayedResult&>(result) = std::move(played);
    result.command = repeating(options, planned);
}

void drop_pictures(const StudyOptions& options, bool keeps_folder, CellResult& cell) {
    cell.frames = {};
    cell.reaches = {};
    cell.glares = {};
    cell.maps = {};
    if (keeps_folder || std::ranges::any_of(cell.verdicts, is_red))
        return;
    cell.is_kept = false;
    cell.series = nullptr;
    std::error_code ignored;
    fs::remove_all(options.folder / "cells" / cell.cell.name, ignored);
    cell.command = playing_anew(options, cell.cell);
}

void collect_cell(const CellStore& store, const Study& study, const PlannedCell& planned, const StudyOptions& options, CellResult& result) {
    const std::optional<StoredCell> stored = store.find(planned.key);
    if (!stored)
        throw InputError({store.folder(), 0, 0, {}}, "found nothing of cell " + planned.cell.name, "what playing it gives");
    PackedFiles files;
    try {
        files = store.load(*stored);
    } catch (const InputError& damage) {
        store.forget(planned.key);
        store.note_failure(planned.key, "its results in the store were damaged, and were taken out when it was collected");
        throw DeviceError(fmt::format("its results in the store are damaged, and it must be played again ({})", damage.what()));
    }
    const fs::path folder = options.folder / folder_name_of(planned);
    fs::remove_all(folder);
    write_files(files, folder);
    try {
        judge_cell(study, planned, options, result);
    } catch (const InputError& error) { // of what was kept whole, but not as this program reads it
        if (error.where().file.string().starts_with(folder.string())) {
            store.forget(planned.key);
            store.note_failure(planned.key, error.what());
        }
        throw;
    }
}

} // namespace fernlicht
