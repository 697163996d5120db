#include "runner/experiments/study/study_run.h"

#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/study/cell_collecting.h"
#include "runner/experiments/study/cell_playing.h"
#include "runner/experiments/study/slurm_playing.h"
#include "runner/experiments/study/study_document.h"
#include "runner/files/checked_json.h"
#include "runner/files/durable_files.h"
#include "runner/files/log.h"
#include "runner/files/output_folder.h"
#include "runner/play/progress.h"
#include "runner/workers/slurm.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <memory>
#include <mutex>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <set>
#include <thread>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

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

constexpr const char* plan_schema = "fernlicht plan";

/// The keys of a study's cells and when it began, so that it is known later.
std::string plan_text(const Study& study, const StudyPlan& plan, const std::string& started_utc) {
    nlohmann::ordered_json cells = nlohmann::ordered_json::object();
    for (const PlannedCell& one : plan.cells)
        cells[one.cell.name] = one.key;
    return nlohmann::ordered_json{
               {"schema", plan_schema}, {"schema_version", 1}, {"study", study.name}, {"started_utc", started_utc}, {"cells", cells}}
               .dump(1) +
           "\n";
}

/// Before a study is gone on with: what was begun is what is asked for now.
void refuse_other_cells(const Study& study, const StudyPlan& plan, const CellStore& store, const fs::path& folder) {
    const CheckedJson begun = CheckedJson::read(folder / "plan.json");
    begun.expect_schema(plan_schema, 1);
    if (const std::string name = begun.at("study").text(); name != study.name)
        throw InputError({folder, 0, 0, "--resume"}, fmt::format("holds study '{}'", printable(name)),
                         "the folder of '" + printable(study.name) + "'");
    const CheckedJson cells = begun.at("cells");
    if (cells.size() != plan.cells.size())
        throw InputError({folder, 0, 0, "--resume"},
                         fmt::format("was begun with {} cells, and {} are asked for now", cells.size(), plan.cells.size()),
                         "the same --only as then, or a new folder");
    const PlannedCell* other = nullptr;
    for (const PlannedCell& one : plan.cells) {
        if (cells.has(one.cell.name) && cells.at(one.cell.name).text() == one.key)
            continue;
        other = other ? other : &one;
        // The store may know what the key of then was made of.
        if (const auto begun_with = cells.has(one.cell.name) ? store.find(cells.at(one.cell.name).text()) : std::nullopt)
            throw InputError({folder / "cells" / one.cell.name, 0, 0, "--resume"},
                             fmt::format("was begun otherwise ({})", fmt::join(input_changes(begun_with->inputs, plan.inputs(one)), "; ")),
                             "the study as it was begun");
    }
    if (other)
        throw InputError({folder / "cells" / other->cell.name, 0, 0, "--resume"},
                         "found a cell that was not begun, or begun with other files, settings, another program or another machine",
                         "the study as it was begun");
}

/// Of two that go on in one folder the second is refused. Held on the mark of a study that did not end.
std::unique_ptr<FolderLock> only_process(const fs::path& folder) {
    std::unique_ptr<FolderLock> alone = FolderLock::at_once(folder / "INCOMPLETE");
    if (!alone)
        throw InputError({folder, 0, 0, "--out"}, "is being written by another process", "one process at a time in a folder");
    return alone;
}

/// With --resume a study began when it did, not now.
void begin(const Study& study, const StudyPlan& plan, const StudyOptions& options, StudyResult& result) {
    if (const fs::path file = options.folder / "plan.json"; options.resume && fs::is_regular_file(file))
        if (const CheckedJson begun = CheckedJson::read(file); begun.has("started_utc"))
            result.context.started_utc = begun.at("started_utc").text();
    write_file(options.folder / "plan.json", plan_text(study, plan, result.context.started_utc));
}

/// A new folder, or with --resume that of a study that was stopped, or of one that ended, whose report is then written anew.
OutputFolder folder_for(const Study& study, const StudyPlan& plan, const CellStore& store, const StudyOptions& options) {
    const bool begun = fs::is_regular_file(options.folder / "plan.json");
    if (!options.resume && begun && is_marked_incomplete(options.folder))
        throw InputError({options.folder, 0, 0, "--out"}, "holds a study that did not end",
                         "--resume to go on with it, or a new or an empty folder");
    if (!options.resume)
        return OutputFolder(options.folder);
    if (begun)
        refuse_other_cells(study, plan, store, options.folder);
    if (is_marked_incomplete(options.folder) || !begun)
        return OutputFolder::left_incomplete(options.folder);
    write_file(options.folder / "INCOMPLETE", "This study's report is being written anew.\n");
    return OutputFolder::left_incomplete(options.folder);
}

/// To the maps of what was played, drive by drive.
void add_lanes(const Study& study, StudyResult& result) {
    std::map<std::array<std::size_t, 3>, std::vector<CellResult*>> alike; // axes may move the car
    for (CellResult& cell : result.cells)
        if (cell.failed.empty())
            alike[{cell.cell.drive, cell.cell.mirror, cell.cell.point}].push_back(&cell);
    for (auto& [key, cells] : alike) {
        const Drive drive = cell_drive(study, cells.front()->cell);
        add_map_edges(drive, std::move(cells));
    }
}

/// Keeps what is told of a study, cell by cell as they are collected: of a large one no more than a few pictures.
class Telling {
  public:
    explicit Telling(const StudyOptions& options) : options_(options) {}
    void add(StudyResult& result) {
        CellResult& cell = result.cells.back();
        keep_told_readings(result, cell);
        if (result.cells.size() == 1 || !is_same_place(result.cells[result.cells.size() - 2].cell, cell.cell))
            ++places_;
        if (places_ > max_pictured_places)
            drop_pictures(options_, result.tells_all, cell);
    }

  private:
    const StudyOptions& options_;
    std::size_t places_ = 0;
};

/// Everything that is known before a cell is played.
StudyResult begun_study(const Study& study, const StudyPlan& plan, const StudyOptions& options) {
    StudyResult result;
    result.study = study;
    result.folder = options.folder;
    result.tells_all = plan.cells.size() <= most_told_cells;
    result.context = plan.context;
    result.call = options.run.command;
    result.only = fmt::format("{}", fmt::join(options.only, ","));
    result.frames = frames_text(options.run.ticks);
    result.lamp_files = plan.lamp_files;
    result.lamps = compare_lamp_files(study);
    return result;
}

std::string no_moments(const StudyOptions& options) {
    return fmt::format("its drive has no moment in --frames {}", frames_text(options.run.ticks));
}

/// Sets `failed` where there is nothing to collect, or what there is cannot be read.
void try_cell(CellResult& cell, const std::function<void()>& collect) {
    try {
        collect();
    } catch (const std::exception& error) {
        cell.failed = error.what();
    }
}

std::string played_words(const StudyResult& result, const std::string& how) {
    const auto reused = static_cast<std::size_t>(
        std::ranges::count_if(result.cells, [](const CellResult& cell) { return cell.reused && cell.failed.empty(); }));
    const auto played = static_cast<std::size_t>(
        std::ranges::count_if(result.cells, [](const CellResult& cell) { return !cell.reused && cell.failed.empty(); }));
    return fmt::format("{} of {} cells came from the store", reused, result.cells.size()) +
           (played > 0 ? fmt::format("; {} {} played, {}", played, played == 1 ? "was" : "were", how) : "");
}

void finish(StudyResult& result, const StudyOptions& options, OutputFolder& folder) {
    std::optional<TraceSpan> span(std::in_place, "compare cells", "study");
    add_lanes(result.study, result);
    compare_cells(result);
    span.reset();
    if (options.known)
        apply_known_failures(result, *options.known, options.run.today);
    add_aim_warnings(result);
    add_gaze_warnings(result);
    add_axis_warnings(result);
    span.emplace("write figures and report", "write");
    result.figures = study_figures(result, options.folder);
    options.write(result);
    span.reset();
    if (result.complete())
        folder.finish();
}

void refuse_unwritable(const CellStore& store) {
    if (const std::string why = store.refuses_writing(); !why.empty())
        throw DeviceError(fmt::format(
            "the store of cells cannot be written ({}), and some cells must be played; choose another folder with --store", why));
}

/// True where what the store has of the cell is damaged. Nobody is to wonder why it is played again.
bool is_told_damaged(const CellStore& store, const PlannedCell& one) {
    const std::string damage = store.damage(one.key);
    if (!damage.empty())
        tell(LogLevel::warning, fmt::format("cell {} is played again: in the store {} (key {})", one.cell.name, damage, one.key));
    return !damage.empty();
}

/// Its drive is read anew, and may be gone.
CellResult begun_cell(const Study& study, const StudyPlan& plan, const PlannedCell& one, const StudyOptions& options) {
    CellResult cell;
    cell.cell = one.cell;
    try_cell(cell, [&] { cell = unplayed_cell(study, plan, one); });
    cell.command = playing_anew(options, one.cell); // until there is a folder
    return cell;
}

/// From the store, in the order of the plan, as many at a time as there are cores. What turns out to be damaged there is played once more.
void collect_all(const CellStore& store, const Study& study, const StudyPlan& plan, const StudyOptions& options,
                 const std::map<std::size_t, PlayedInWorker>& played, const Jobs& jobs, StudyResult& result) {
    constexpr const char* not_reached = "not reached";
    std::mutex playing_again;
    const auto collected = [&](std::size_t i) {
        const PlannedCell& one = plan.cells[i];
        CellResult cell = begun_cell(study, plan, one, options);
        const auto found = played.find(i);
        cell.reused = found == played.end();
        if (!cell.failed.empty()) {
            // Its drive cannot be read any more.
        } else if (one.moments == 0)
            cell.failed = no_moments(options);
        else if (found != played.end() && !found->second.failed.empty()) {
            cell.failed = found->second.failed; // where files changed meanwhile that is why, and not what the process saw of it
            try_cell(cell, [&] {
                if (const std::string changed = changed_since(cell_drive(study, one.cell), one); !changed.empty())
                    cell.failed = changed;
            });
        } else if (Interruption::requested() && !store.find(one.key))
            cell.failed = not_reached;
        else
            try_cell(cell, [&] {
                if (options.executor == StudyExecutor::local && !Interruption::requested() &&
                    (!store.find(one.key) || is_told_damaged(store, one))) {
                    const std::lock_guard alone(playing_again);
                    store.forget(one.key);
                    cell.reused = false;
                    if (const auto again = play_in_workers(store, study, plan, {i}, jobs, options);
                        again.contains(i) && !again.at(i).failed.empty())
                        throw DeviceError(again.at(i).failed);
                }
                collect_cell(store, study, one, options, cell);
            });
        return cell;
    };
    Telling telling(options);
    const std::size_t at_once = std::max(1U, std::thread::hardware_concurrency());
    for (std::size_t first = 0; first < plan.cells.size(); first += at_once) {
        std::vector<CellResult> some(std::min(at_once, plan.cells.size() - first));
        oneapi::tbb::parallel_for(std::size_t{0}, some.size(), [&](std::size_t k) { some[k] = collected(first + k); });
        for (CellResult& cell : some) {
            if (cell.failed == not_reached)
                result.missing.push_back("cell " + cell.cell.name);
            result.cells.push_back(std::move(cell));
            telling.add(result);
        }
    }
}

/// One after another by themselves, none from the store.
void play_all_timed(const Study& study, const StudyPlan& plan, const StudyOptions& options, StudyResult& result) {
    for (std::size_t i = 0; i < plan.cells.size(); ++i) {
        const PlannedCell& one = plan.cells[i];
        const fs::path folder = options.folder / "cells" / one.cell.name;
        CellResult& cell = result.cells.emplace_back(begun_cell(study, plan, one, options));
        if (result.interrupted.empty() && !options.run.quiet)
            tell(LogLevel::info, fmt::format("cell {} of {}: {}", i + 1, plan.cells.size(), one.cell.name));
        if (one.moments == 0)
            cell.failed = no_moments(options);
        else if (!result.interrupted.empty()) {
            cell.failed = "not reached";
            result.missing.push_back("cell " + one.cell.name);
        } else
            try_cell(cell, [&] {
                fs::remove_all(folder);
                if (!play_timed(study, one, options, folder)) {
                    result.interrupted = Interruption::words();
                    cell.failed = result.interrupted;
                } else
                    judge_cell(study, one, options, cell);
            });
    }
}

/// When nothing else is left to play. Returns what is said of cells that could not be timed.
std::string time_cells(const Study& study, const StudyPlan& plan, const CellStore& store, const StudyOptions& options,
                       StudyResult& result) {
    std::string said;
    for (std::size_t i = 0; i < plan.cells.size() && !Interruption::requested(); ++i) {
        const std::string& name = plan.cells[i].cell.name;
        if (!result.cells[i].failed.empty() ||
            std::ranges::none_of(study.timed_cells, [&](const std::string& pattern) { return matches(pattern, name); }))
            continue;
        if (!options.run.quiet)
            tell(LogLevel::info, fmt::format("timing cell {}", name));
        try {
            result.cells[i].frame_s = frame_s_by_itself(study, name, store, options);
        } catch (const std::exception& error) {
            said += fmt::format("; cell {} has no time: {}", name, error.what());
        }
    }
    return said;
}

/// Why each cell that the store lacks is not there.
std::map<std::string, std::string> reasons_by_key(const Study& study, const StudyPlan& plan, const CellStore& store) {
    const std::vector<std::size_t> lacking = lacking_cells(store, plan);
    const std::vector<std::vector<std::string>> reasons = reasons_to_play(study, plan, lacking, store);
    std::map<std::string, std::string> by_key;
    for (std::size_t i = 0; i < lacking.size(); ++i) {
        const std::string& key = plan.cells[lacking[i]].key;
        const std::string failure = store.failure(key);
        const bool is_new = reasons[i] == std::vector<std::string>{"new"};
        by_key[key] = !failure.empty() ? failure
                      : is_new         ? "it is not in the store: not played yet, or killed before it could say why"
                                       : fmt::format("it is not in the store as it is asked for now: {}", fmt::join(reasons[i], "; "));
    }
    return by_key;
}

/// Where a plan was made with other files, another program or on another class of machine, what is played here is not what it waits for.
void refuse_others(const StudyPlan& plan, const CellStore& store, const StudyOptions& options) {
    std::string found;
    for (const auto& [cell, key] : options.expected)
        if (const auto one = std::ranges::find(plan.cells, cell, [](const PlannedCell& planned) { return planned.cell.name; });
            one != plan.cells.end() && one->key != key) {
            const std::string why = fmt::format("cell {}: files, program or class of machine are not those of the plan (here: {}, {})",
                                                cell, plan.context.gl_renderer, plan.context.cpu);
            store.note_failure(key, why);
            found = found.empty() ? why : found;
        }
    if (!found.empty())
        throw InputError({{}, 0, 0, "--expect"}, "found " + found, "a plan that was made with these");
}

/// What cannot even be planned here is the reason of every cell that is waited for.
StudyPlan plan_or_note(const Study& study, const CellStore& store, const StudyOptions& options) {
    try {
        const std::vector<StudyCell> all = options.expected.empty() ? std::vector<StudyCell>() : cells_of(study);
        std::set<std::string> names;
        for (const StudyCell& cell : all)
            names.insert(cell.name);
        for (const auto& [cell, key] : options.expected)
            if (!names.contains(cell))
                throw InputError({{}, 0, 0, "--expect"}, "found cell '" + printable(cell) + "', which the study does not have",
                                 "a cell that --list names");
        return plan_study(study, options);
    } catch (const std::exception& error) {
        for (const auto& [cell, key] : options.expected)
            store.note_failure(key, error.what());
        throw;
    }
}

} // namespace

StudyResult run_study(const Study& study, const StudyOptions& options) {
    refuse_unaimable(study);
    const StudyPlan plan = plan_study(study, options);
    StudyResult result = begun_study(study, plan, options);
    const CellStore store(options.store);
    const std::vector<std::size_t> to_play = options.timed ? std::vector<std::size_t>() : lacking_cells(store, plan);
    if (!to_play.empty())
        refuse_unwritable(store);
    if (!to_play.empty() && options.executor == StudyExecutor::slurm)
        most_tasks(); // throws where no controller answers, before there is a folder
    OutputFolder folder = folder_for(study, plan, store, options);
    const std::unique_ptr<FolderLock> alone = only_process(options.folder);
    begin(study, plan, options, result);
    for (const std::size_t i : to_play)
        is_told_damaged(store, plan.cells[i]);
    const Interruption listening;
    if (options.timed) {
        play_all_timed(study, plan, options, result);
        result.played_by = played_words(result, "one after another by themselves");
        const auto untimed =
            std::ranges::count_if(result.cells, [](const CellResult& cell) { return cell.failed.empty() && !cell.frame_s; });
        if (untimed > 0)
            result.played_by += fmt::format("; too few moments to time a frame were played in {} of them", untimed);
    } else {
        const Jobs jobs = jobs_for(options.jobs, plan.context, options.resources);
        const auto played = options.executor == StudyExecutor::slurm ? play_on_slurm(store, study, plan, to_play, options)
                                                                     : play_in_workers(store, study, plan, to_play, jobs, options);
        if (Interruption::requested())
            result.interrupted = Interruption::words();
        collect_all(store, study, plan, options, played, jobs, result);
        result.played_by =
            played_words(result, options.executor == StudyExecutor::slurm ? "by Slurm"
                                                                          : fmt::format("{} at a time, {} {} each", jobs.at_once,
                                                                                        jobs.cores, jobs.cores == 1 ? "core" : "cores"));
        if (options.times_too && options.executor == StudyExecutor::local)
            result.played_by += time_cells(study, plan, store, options, result);
        if (Interruption::requested())
            result.interrupted = Interruption::words();
    }
    finish(result, options, folder);
    return result;
}

StudyResult collect_study(const Study& study, const StudyOptions& options) {
    refuse_unaimable(study);
    const StudyPlan plan = plan_study(study, options);
    StudyResult result = begun_study(study, plan, options);
    const CellStore store(options.store);
    OutputFolder folder = folder_for(study, plan, store, options);
    const std::unique_ptr<FolderLock> alone = only_process(options.folder);
    begin(study, plan, options, result);
    Telling telling(options);
    std::map<std::string, std::string> why_lacking = reasons_by_key(study, plan, store);
    for (const PlannedCell& one : plan.cells) {
        CellResult& cell = result.cells.emplace_back(begun_cell(study, plan, one, options));
        cell.reused = true;
        if (!cell.failed.empty()) {
            // Its drive cannot be read any more.
        } else if (one.moments == 0)
            cell.failed = no_moments(options);
        else if (!store.find(one.key))
            cell.failed = why_lacking.contains(one.key) ? why_lacking[one.key] : "it was in the store and is gone: damaged, or pruned";
        else
            try_cell(cell, [&] { collect_cell(store, study, one, options, cell); });
        telling.add(result);
    }
    result.played_by = played_words(result, "");
    finish(result, options, folder);
    return result;
}

bool play_into_store(const Study& study, const StudyOptions& options) {
    const int cores = std::max(1, options.resources.cores);
    ::setenv("LP_NUM_THREADS", fmt::format("{}", cores).c_str(), 0);
    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(cores));
    const CellStore store(options.store);
    const StudyPlan plan = plan_or_note(study, store, options);
    refuse_others(plan, store, options);
    const Interruption listening;
    bool all_there = true;
    for (const PlannedCell& one : plan.cells) {
        if (one.moments == 0 || (store.find(one.key) && !is_told_damaged(store, one)))
            continue;
        try {
            if (store.find(one.key)) // damaged
                store.forget(one.key);
            if (!play_into(store, study, plan, one, options) || Interruption::requested())
                return false;
        } catch (const std::exception& error) {
            all_there = false;
            const std::string why = sentence_of_failure(error.what());
            tell(LogLevel::error, fmt::format("cell {}: {}", one.cell.name, why));
            store.note_failure(one.key, why);
        }
    }
    return all_there;
}

} // namespace fernlicht
