#include "runner/experiments/study/study_run.h"

#include "metrics/regulation/installed_aim.h"
#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/run/run_report.h"
#include "runner/experiments/study/study_document.h"
#include "runner/files/log.h"
#include "runner/files/output_folder.h"
#include "runner/findings/moment_columns.h"
#include "runner/findings/run_context.h"
#include "runner/play/aim_lamps.h"
#include "runner/play/capture.h"
#include "runner/play/progress.h"
#include "runner/play/shadows/choose_shadows.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"
#include "scenarios/values/pose.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

struct Planned {
    StudyCell cell;
    Drive drive;
    bool left_hand_traffic = false;
};

/// Where the study's file has the lamp.
[[noreturn]] void refuse_aim(const Study& study, const StudyLamp& lamp, const std::string& found, const char* expected) {
    throw InputError({study.file, lamp.line, lamp.column, "lamps." + lamp.name + ".aim"}, found, expected);
}

/// Lamps that the aim of a drive finds nothing in, by the first cell of each; those of other road users are the drive's own affair.
void refuse_unaimable(const Study& study, const std::vector<Planned>& planned) {
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const Planned& one : planned)
        if (seen.emplace(one.cell.lamp, one.cell.drive).second) {
            Drive traffic = one.drive, own = one.drive;
            traffic.lamp_sets.clear();
            aim_lamps(traffic);
            own.traffic_rows.clear();
            try {
                aim_lamps(own);
            } catch (const InputError& error) {
                refuse_aim(study, study.lamps[one.cell.lamp], fmt::format("a drive's aim: auto cannot aim it ({})", error.what()),
                           "aim: as-is, or the file of a beam with a cut-off");
            }
        }
}

/// Axes may put a drive on another road, or elsewhere on it.
bool is_same_road(const Planned& a, const Planned& b) {
    const auto start_of = [](const Planned& one) { return std::tie(one.drive.start.road, one.drive.start.lane, one.drive.start.s_m); };
    return a.cell.drive == b.cell.drive && a.cell.technique == b.cell.technique && a.cell.mirror == b.cell.mirror &&
           a.drive.road_file == b.drive.road_file && a.drive.mirrored_road == b.drive.mirrored_road && start_of(a) == start_of(b) &&
           a.drive.via == b.drive.via;
}

std::vector<Planned> plan(const Study& study, const std::vector<std::string>& only) {
    const TraceSpan span("plan", "study");
    std::vector<Planned> planned;
    for (const StudyCell& cell : chosen_cells(study, only)) {
        planned.push_back({cell, cell_drive(study, cell), false});
        refuse_auto_shadows(planned.back().drive); // each cell would choose for itself
    }
    const Planned* last = nullptr;
    bool left_hand = false;
    for (Planned& one : planned) { // roads and techniques too, once each
        if (!last || !is_same_road(*last, one))
            left_hand = left_hand_traffic(Stage(one.drive));
        one.left_hand_traffic = left_hand;
        last = &one;
    }
    refuse_unaimable(study, planned);
    return planned;
}

/// As the study has them at its usual aim, which is 1 % down: other aims are asked for. Lamps that stay as they are where the condition
/// mirrors were made for the other side.
std::vector<CheckedLampFile> check_lamp_files(const Study& study, const std::vector<Planned>& planned, bool strict) {
    LampFileChecks checks;
    for (const Planned& one : planned) {
        const StudyLamp& lamp = study.lamps[one.cell.lamp];
        const bool stays = study.conditions.mirror[one.cell.mirror] && !lamp.mirrors;
        checks.add(one.drive, one.left_hand_traffic != stays, degrees(std::atan(-0.01) - std::atan(lamp.file_aim_percent / 100.0)));
    }
    if (strict)
        checks.refuse_meaningless();
    return checks.files();
}

/// The files of one lamp set against those of another, sides apart where they differ.
std::vector<LampComparison> compare_lamp_files(const Study& study) {
    const auto find = [&](const std::string& name) { return *std::ranges::find(study.lamps, name, &StudyLamp::name); };
    std::vector<LampComparison> out;
    for (const StudyComparison& pair : study.comparisons) {
        const StudyLamp now = find(pair.tested), before = find(pair.against);
        const bool alike = now.left == now.right && before.left == before.right;
        for (const bool left : {true, false}) {
            if (alike && !left)
                continue;
            const fs::path &file = left ? now.left : now.right, &other = left ? before.left : before.right;
            out.push_back(
                {pair.tested, pair.against,
                 alike  ? "left and right"
                 : left ? "left"
                        : "right",
                 file, other,
                 difference_of(read_lamp(file, {.recipe = now.recipe}), read_lamp(other, {.recipe = before.recipe}), study.noise_relative),
                 now.recipe, before.recipe, now.aim == BeamAim::automatic || before.aim == BeamAim::automatic});
        }
    }
    return out;
}

std::string resolved_name(const Drive& drive) { return file_name_of(drive.name) + ".yaml"; }

/// Played from the same resolved drive, the same bytes of every file and over the same moments.
bool is_same_cell(const fs::path& folder, const Drive& drive, const TickRange& ticks) {
    FilesRead ignored;
    if (!fs::is_regular_file(folder / resolved_name(drive)) || read_file(folder / resolved_name(drive), ignored) != write_drive(drive))
        return false;
    const Report report = read_report(folder);
    std::map<std::string, std::string> hashes;
    for (const FileRead& input : report.context.inputs)
        hashes[input.path.string()] = input.xxh128;
    const auto is_known = [&](const FileRead& file) { return file.path == drive.file || hashes[file.path.string()] == file.xxh128; };
    return report.played.size() == 1 && report.played.front().ticks_planned == ticks_to_play(drive, ticks) &&
           std::ranges::all_of(drive.opened, is_known);
}

/// True where the cell's folder holds what is wanted. Clears what a stopped run left there.
bool is_finished(const fs::path& folder, const Planned& planned, const StudyOptions& options) {
    if (!fs::exists(folder))
        return false;
    if (is_marked_incomplete(folder)) {
        fs::remove_all(folder);
        return false;
    }
    if (!is_same_cell(folder, planned.drive, options.run.ticks))
        throw InputError({folder, 0, 0, "--resume"}, "found a cell that was played with other files or settings",
                         "the study as it was begun");
    return true;
}

/// As `--frames` takes it; "" for all moments.
std::string frames_text(const TickRange& ticks) {
    if (ticks.last == TickRange{}.last)
        return ticks.first > 0 ? fmt::format("{}:", ticks.first) : "";
    return fmt::format("{}:{}", ticks.first, ticks.last);
}

/// A range that lies beyond some drives leaves their cells out; one that lies beyond all is a mistake.
void refuse_no_moments(const Study& study, const std::vector<Planned>& planned, const TickRange& ticks) {
    int most = 0;
    for (const Planned& one : planned) {
        if (ticks_to_play(one.drive, ticks) > 0)
            return;
        most = std::max(most, tick_count(one.drive));
    }
    throw InputError({study.file, 0, 0, "--frames"}, fmt::format("found a range from {} on", ticks.first),
                     fmt::format("moments of a drive, the longest of which has 0 to {}", most - 1));
}

/// Before a study that ended is written anew: what it kept is what is asked for now.
void refuse_other_cells(const std::vector<Planned>& planned, const StudyOptions& options) {
    for (const Planned& one : planned)
        if (const fs::path cell = options.folder / "cells" / one.cell.name; fs::exists(cell) && !is_marked_incomplete(cell))
            is_finished(cell, one, options);
}

/// A new folder, or with --resume that of a study that was stopped, or of one that ended, whose report is then written anew.
OutputFolder folder_for(const std::vector<Planned>& planned, const StudyOptions& options) {
    if (!options.resume && is_marked_incomplete(options.folder) && fs::is_directory(options.folder / "cells"))
        throw InputError({options.folder, 0, 0, "--out"}, "holds a study that did not end",
                         "--resume to go on with it, or a new or an empty folder");
    if (!options.resume)
        return OutputFolder(options.folder);
    if (is_marked_incomplete(options.folder) || !fs::is_regular_file(options.folder / "study.json"))
        return OutputFolder::left_incomplete(options.folder);
    refuse_other_cells(planned, options);
    write_file(options.folder / "INCOMPLETE", "This study's report is being written anew.\n");
    return OutputFolder::left_incomplete(options.folder);
}

std::string repeating(const StudyOptions& options, const fs::path& folder, const Planned& planned) {
    std::vector<std::string> words{options.run.command.empty() ? "fernlicht" : options.run.command.front(), "run",
                                   (folder / resolved_name(planned.drive)).string()};
    if (const std::string frames = frames_text(options.run.ticks); !frames.empty()) {
        words.emplace_back("--frames");
        words.push_back(frames);
    }
    if (!options.run.accuracy)
        words.emplace_back("--no-accuracy");
    return shell_quoted(words);
}

/// Fills a cell's result from the report in its folder. Throws InputError when that is no complete report of one drive.
void read_cell_report(const fs::path& study_folder, CellResult& cell) {
    const std::string folder = "cells/" + cell.cell.name;
    const Report report = read_report(study_folder / folder);
    if (report.played.size() != 1)
        throw InputError({study_folder / folder / "report.json", 0, 0, "drives"}, fmt::format("found {}", report.played.size()),
                         "one drive with one lamp set");
    const PlayedCell& only = report.played.front();
    PlayedResult played = played_result(only, read_moments(study_folder / folder, report, 0), folder);
    static_cast<Steps&>(played) = cell; // the drive's, not the report's
    static_cast<PlayedResult&>(cell) = std::move(played);
}

/// Plays the cell or takes it as it lies there; false when the user stopped it.
bool play_cell(const Planned& planned, const StudyOptions& options, CellResult& result, RunContext& context) {
    TraceSpan span("cell", "study");
    if (span)
        span.tell("cell", planned.cell.name);
    const fs::path folder = options.folder / "cells" / planned.cell.name;
    result.reused = is_finished(folder, planned, options);
    if (!result.reused) {
        RunOptions run = options.run;
        run.folder = folder;
        run.choice = {"--only", planned.cell.name};
        const Report report = run_drives({planned.drive}, run);
        context = report.context;
        if (!report.complete) {
            result.failed = report.interrupted;
            return false;
        }
    }
    read_cell_report(options.folder, result);
    return true;
}

/// To the maps of what was played, drive by drive.
void add_lanes(const std::vector<Planned>& planned, StudyResult& result) {
    std::map<std::array<std::size_t, 3>, std::vector<std::size_t>> alike; // axes may move the car
    for (std::size_t i = 0; i < result.cells.size(); ++i)
        if (result.cells[i].failed.empty())
            alike[{result.cells[i].cell.drive, result.cells[i].cell.mirror, result.cells[i].cell.point}].push_back(i);
    for (const auto& [key, indices] : alike) {
        std::vector<CellResult*> cells;
        for (const std::size_t i : indices)
            cells.push_back(&result.cells[i]);
        add_map_edges(planned[indices.front()].drive, std::move(cells));
    }
}

} // namespace

std::vector<StudyCell> chosen_cells(const Study& study, const std::vector<std::string>& only) {
    std::vector<StudyCell> cells = cells_of(study), chosen;
    for (const std::string& pattern : only)
        if (std::ranges::none_of(cells, [&](const StudyCell& cell) { return matches(pattern, cell.name); }))
            throw InputError({study.file, 0, 0, "--only"}, fmt::format("found '{}', which fits no cell", printable(pattern)),
                             "a pattern like '*xenon*'; --list names the cells");
    std::ranges::copy_if(cells, std::back_inserter(chosen), [&](const StudyCell& cell) {
        return only.empty() || std::ranges::any_of(only, [&](const std::string& pattern) { return matches(pattern, cell.name); });
    });
    return chosen;
}

void refuse_unaimable(const Study& study) {
    for (const StudyLamp& lamp : study.lamps) {
        if (lamp.aim != BeamAim::automatic)
            continue;
        std::vector<fs::path> seen{fs::path()}; // where the study names none
        for (const auto& [file, is_high] : {std::pair(lamp.left, false), {lamp.right, false}, {lamp.high, true}}) {
            if (std::ranges::find(seen, file) != seen.end())
                continue;
            seen.push_back(file);
            if (const AimMark mark = aim_mark(read_lamp(file, {.recipe = lamp.recipe}).table, is_high); !mark.v_deg)
                refuse_aim(study, lamp,
                           fmt::format("found auto, and nothing to aim by in {}: {}", printable(file.string(), 400), mark.why_not),
                           "as-is, or the file of a beam with a cut-off");
        }
    }
}

StudyResult run_study(const Study& study, const StudyOptions& options) {
    refuse_unaimable(study);
    StudyResult result;
    result.study = study;
    const std::vector<Planned> planned = plan(study, options.only);
    refuse_no_moments(study, planned, options.run.ticks);
    result.call = options.run.command;
    result.only = fmt::format("{}", fmt::join(options.only, ","));
    result.frames = frames_text(options.run.ticks);
    result.lamp_files = check_lamp_files(study, planned, options.strict);
    result.lamps = compare_lamp_files(study);
    // A machine that cannot draw says so before there is a folder.
    result.context = make_context(open_device(options.run.backend).info(), options.run.command, planned.front().drive.seed);
    OutputFolder folder = folder_for(planned, options);
    const Interruption listening;
    for (std::size_t i = 0; i < planned.size(); ++i) {
        CellResult cell;
        cell.cell = planned[i].cell;
        cell.title = planned[i].drive.title;
        cell.step_s = planned[i].drive.step_s;
        cell.moments = ticks_to_play(planned[i].drive, options.run.ticks);
        cell.moments_of_drive = tick_count(planned[i].drive);
        for (const SpeedPoint& point : planned[i].drive.speed)
            cell.step_m = std::max(cell.step_m, point.speed_mps * cell.step_s);
        cell.look_step_m = planned[i].drive.seeing.visibility ? planned[i].drive.seeing.visibility->step_m : 0.0;
        cell.grid_cell_m = planned[i].drive.extent ? planned[i].drive.extent->cell_m : cell.grid_cell_m;
        std::ranges::copy_if(planned[i].drive.views, std::back_inserter(cell.maps),
                             [](const View& view) { return view.projection == Projection::map; });
        cell.command = repeating(options, options.folder / "cells" / cell.cell.name, planned[i]);
        if (result.interrupted.empty() && !options.run.quiet)
            tell(LogLevel::info, fmt::format("cell {} of {}: {}", i + 1, planned.size(), cell.cell.name));
        try {
            if (!result.interrupted.empty()) {
                cell.failed = "not reached";
                result.missing.push_back("cell " + cell.cell.name);
            } else if (!play_cell(planned[i], options, cell, result.context) || Interruption::requested())
                result.interrupted = "interrupted by the user";
        } catch (const InputError& error) {
            if (error.where().key == "--resume")
                throw;
            cell.failed = error.what();
        } catch (const std::exception& error) {
            cell.failed = error.what();
        }
        result.cells.push_back(std::move(cell));
    }
    std::optional<TraceSpan> comparing(std::in_place, "compare cells", "study");
    add_lanes(planned, result);
    compare_cells(result);
    comparing.reset();
    if (options.known)
        apply_known_failures(result, *options.known, options.run.today);
    add_aim_warnings(result);
    std::optional<TraceSpan> writing(std::in_place, "write figures and report", "write");
    result.figures = study_figures(result, options.folder);
    options.write(result);
    writing.reset();
    if (result.complete())
        folder.finish();
    return result;
}

} // namespace fernlicht
