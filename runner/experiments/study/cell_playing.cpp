#include "runner/experiments/study/cell_playing.h"

#include "runner/experiments/run/run_report.h"
#include "runner/experiments/study/study_progress.h"
#include "runner/files/durable_files.h"
#include "runner/files/trace_file.h"
#include "runner/findings/run_context.h"
#include "runner/play/progress.h"
#include "runner/play/stage.h"
#include "runner/workers/worker_pool.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <new>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

/// A drive whose results are judged later, by its limits of then.
Drive unjudged_drive(const Study& study, const StudyCell& cell) {
    Drive drive = cell_drive(study, cell);
    drive.title.clear();
    drive.limits.clear();
    return drive;
}

RunOptions run_options(const StudyOptions& options, const fs::path& folder) {
    RunOptions run = options.run;
    run.folder = folder;
    run.judged = false;
    run.baselines.clear();
    run.known.reset();
    return run;
}

FilesRead inputs_of(const Report& report, const PlannedCell& planned) {
    FilesRead inputs = report.context.inputs;
    add_inputs(inputs, *planned.road);
    add_inputs(inputs, *planned.others);
    return inputs;
}

/// Without the program's name, or the runtime's words.
std::string last_word(const WorkerEnd& end) {
    std::string said = end.said;
    for (const std::string_view before : {"fernlicht: ", "  what():  "})
        if (said.starts_with(before))
            said.erase(0, before.size());
    return printable(sentence_of_failure(said), 400);
}

void tell_cell(TraceSpan& span, const PlannedCell& planned) {
    if (span)
        span.tell("cell", planned.cell.name);
}

/// What is killed from outside, as by the kernel where memory is short, passes where nothing is beside it.
bool may_pass_alone(const WorkerEnd& end) { return end.ending == WorkerEnding::killed && (end.code == SIGKILL || end.code == SIGTERM); }

/// A container's limits (control groups, version 2); infinite where there are none.
double limit_of_container(const char* file, double per_unit) {
    double limit = 0.0, period = 1.0;
    std::ifstream in(file);
    if (!(in >> limit)) // "max", or no such file
        return std::numeric_limits<double>::infinity();
    in >> period;
    return limit / (period > 0.0 ? period : 1.0) * per_unit;
}

double memory_mib() {
    const double machine = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1048576.0;
    return std::min(machine, limit_of_container("/sys/fs/cgroup/memory.max", 1.0 / 1048576.0));
}

} // namespace

std::string sentence_of_failure(const std::string& what) {
    if (what == std::bad_alloc().what())
        return "memory ran out";
    if (what == std::generic_category().message(EAGAIN)) // of a thread
        return "no thread could be started: it has as much memory, or as many threads, as it may";
    return what;
}

bool play_into(const CellStore& store, const Study& study, const StudyPlan& plan, const PlannedCell& planned, const StudyOptions& options) {
    TraceSpan span("cell", "study");
    tell_cell(span, planned);
    const Workplace place = store.new_workplace(planned.key); // whatever happens, nothing of it stays
    RunOptions run = run_options(options, place.folder());
    run.no_times = no_times_beside_others;
    const Report report = run_drives({unjudged_drive(study, planned.cell)}, run);
    if (!report.complete)
        return false;
    store.keep({planned.key, study.name, planned.cell.name, report.context.started_utc, plan.inputs(planned), {}, 0, {}},
               files_below(place.folder()), inputs_of(report, planned));
    return true;
}

bool play_timed(const Study& study, const PlannedCell& planned, const StudyOptions& options, const fs::path& folder) {
    TraceSpan span("cell", "study");
    tell_cell(span, planned);
    return run_drives({unjudged_drive(study, planned.cell)}, run_options(options, folder)).complete;
}

Jobs jobs_for(int asked, const RunContext& context, const StudyResources& resources) {
    const bool is_software = context.gl_renderer.starts_with("llvmpipe") || context.gl_renderer.starts_with("softpipe");
    const int cores = static_cast<int>(std::clamp(limit_of_container("/sys/fs/cgroup/cpu.max", 1.0), 1.0,
                                                  std::max(1.0, static_cast<double>(std::thread::hardware_concurrency()))));
    int usual = std::max(1, (is_software ? cores : std::min(4, cores)) / std::max(1, resources.cores));
    if (resources.memory_mib > 0.0)
        usual = std::clamp(usual, 1, std::max(1, static_cast<int>(memory_mib() / resources.memory_mib)));
    return {asked > 0 ? asked : usual, resources.cores > 0 ? resources.cores : asked == 1 ? cores : 1};
}

std::vector<std::string> playing_command(const Study& study, const StudyPlan& plan, const std::vector<std::size_t>& cells,
                                         const StudyOptions& options) {
    std::error_code ignored;
    std::string program = fs::read_symlink("/proc/self/exe", ignored).string();
    if (constexpr std::string_view built_anew = " (deleted)"; program.ends_with(built_anew))
        program.resize(program.size() - built_anew.size());
    std::vector<std::string> words{program.empty() ? "fernlicht" : program, "study", fs::absolute(study.file).string(), "--play"};
    const auto add = [&](const char* flag, const std::string& value) {
        if (!value.empty())
            words.insert(words.end(), {flag, value});
    };
    for (const std::size_t i : cells)
        add("--expect", plan.cells[i].cell.name + "=" + plan.cells[i].key);
    add("--store", fs::absolute(options.store).string());
    add("--backend", options.run.backend);
    add("--frames", frames_text(options.run.ticks));
    add("--repeat", options.run.repeats > 1 ? fmt::format("{}", options.run.repeats) : "");
    add("--cell-cores", fmt::format("{}", std::max(1, options.resources.cores)));
    if (!options.run.accuracy)
        words.emplace_back("--no-accuracy");
    words.emplace_back("--quiet");
    return words;
}

std::map<std::size_t, PlayedInWorker> play_in_workers(const CellStore& store, const Study& study, const StudyPlan& plan,
                                                      const std::vector<std::size_t>& cells, const Jobs& jobs,
                                                      const StudyOptions& options) {
    const fs::path logs = options.folder / "logs";
    make_folder(logs);
    std::vector<std::size_t> order = cells;
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return plan.cells[i].moments; });
    const auto log_of = [&](std::size_t i) { return logs / (plan.cells[i].cell.name + ".log"); };
    StudyProgress progress(order.size(), options.run.quiet);
    std::map<std::size_t, PlayedInWorker> outcome;
    std::vector<std::size_t> again;
    WorkerPool pool{static_cast<std::size_t>(jobs.at_once),
                    {60.0 * options.resources.minutes, static_cast<std::uint64_t>(options.resources.memory_mib)},
                    [] { return !Interruption::requested(); },
                    [&](std::size_t running) { progress.beat(running); }};
    StudyOptions of_worker = options;
    of_worker.resources.cores = jobs.cores;
    const auto command = [&](std::size_t i) {
        // This very program, whatever is built meanwhile.
        WorkerCommand one{playing_command(study, plan, {i}, of_worker), fmt::format("/proc/{}/exe", ::getpid()), {}, log_of(i)};
        if (is_tracing()) {
            const fs::path trace = logs / (plan.cells[i].cell.name + ".trace.json");
            std::error_code ignored;
            fs::remove(trace, ignored); // of a try before this one
            join_trace_of_process(trace);
            one.words.insert(one.words.end(), {"--trace", trace.string()});
        }
        store.note_failure(plan.cells[i].key, "");
        return one;
    };
    const auto ended = [&](std::size_t i, const WorkerEnd& end, bool alone) {
        if (end.ending == WorkerEnding::ended_by_us)
            return; // not reached
        if (may_pass_alone(end) && !alone && jobs.at_once > 1) {
            again.push_back(i);
            return;
        }
        PlayedInWorker& played = outcome[i] = {"", end.seconds, end.cpu_s, end.peak_memory_mib};
        if (store.find(plan.cells[i].key)) {
            // However it ended then.
        } else if (end.ending == WorkerEnding::exited && end.code == 0)
            played.failed = "its process ended well, and the store does not have the cell: was it pruned meanwhile?";
        else {
            played.failed = store.failure(plan.cells[i].key);
            if (played.failed.empty()) {
                played.failed =
                    fmt::format("its process {}{}", ending_text(end, pool.limits), end.said.empty() ? "" : ": " + last_word(end));
            } else
                played.failed += memory_words(end, pool.limits);
            store.note_failure(plan.cells[i].key, played.failed);
            played.failed += end.said.empty() ? " (it printed nothing)" : fmt::format(" (log: logs/{}.log)", plan.cells[i].cell.name);
        }
        std::error_code ignored;
        if (played.failed.empty())
            fs::remove(log_of(i), ignored);
        progress.ended(plan.cells[i].cell.name, played.seconds, played.failed);
    };
    run_workers(
        order.size(), pool, [&](std::size_t k) { return command(order[k]); },
        [&](std::size_t k, const WorkerEnd& end) { ended(order[k], end, false); });
    pool.at_once = 1;
    const std::vector<std::size_t> alone = again;
    run_workers(
        alone.size(), pool, [&](std::size_t k) { return command(alone[k]); },
        [&](std::size_t k, const WorkerEnd& end) { ended(alone[k], end, true); });
    std::error_code ignored;
    fs::remove(logs, ignored); // where it is empty
    return outcome;
}

double frame_s_by_itself(const Study& study, const std::string& cell, const CellStore& store, const StudyOptions& options) {
    const Workplace place = store.new_workplace("timed");
    const std::string out = (place.folder() / "out").string();
    std::vector<std::string> words{"fernlicht",     "study",  fs::absolute(study.file).string(), "--timed", "--only", cell, "--out", out,
                                   "--no-accuracy", "--quiet"};
    for (const auto& [flag, value] :
         {std::pair<std::string, std::string>("--backend", options.run.backend), {"--frames", frames_text(options.run.ticks)}})
        if (!value.empty())
            words.insert(words.end(), {flag, value});
    WorkerPool pool{1, {60.0 * options.resources.minutes, static_cast<std::uint64_t>(options.resources.memory_mib)}, [] {
                        return !Interruption::requested();
                    }};
    WorkerEnd ended;
    run_workers(
        1, pool,
        [&](std::size_t) {
            return WorkerCommand{words, fmt::format("/proc/{}/exe", ::getpid()), {}, place.folder() / "log"};
        },
        [&](std::size_t, const WorkerEnd& end) { ended = end; });
    if (ended.ending != WorkerEnding::exited || ended.code > 1) // 1: beyond a limit, and timed
        throw DeviceError(fmt::format("its process {}: {}", ending_text(ended, pool.limits), last_word(ended)));
    const std::optional<double> frame_s = read_report(fs::path(out) / "cells" / cell).played.front().throughput.view_s;
    if (!frame_s)
        throw DeviceError("too few moments were played to time a frame");
    return *frame_s;
}

} // namespace fernlicht
