#include "runner/experiments/study/slurm_playing.h"

#include "runner/experiments/study/study_progress.h"
#include "runner/files/described_json.h"
#include "runner/files/durable_files.h"
#include "runner/files/log.h"
#include "runner/findings/run_context.h"
#include "runner/play/progress.h"
#include "runner/workers/slurm.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <set>
#include <thread>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// An array with the cells of each of its tasks, by name.
struct Submitted : SlurmArray {
    std::vector<std::vector<std::string>> cells;
};

JsonMembers submitted_members(Submitted& array) { return {{"name", array.name}, {"id", array.id}, {"cells", array.cells}}; }

struct Submissions {
    std::vector<Submitted> arrays;
};

JsonMembers submissions_members(Submissions& all) {
    return {
        {"schema", json_constant("fernlicht slurm jobs")}, {"schema_version", json_constant(1)}, {"arrays", all.arrays, submitted_members}};
}

bool ends_for_good(const std::string& state) { return state == "TIMEOUT" || state == "OUT_OF_MEMORY" || state == "DEADLINE"; }

class SlurmStudy {
  public:
    SlurmStudy(const CellStore& store, const Study& study, const StudyPlan& plan, const std::vector<std::size_t>& cells,
               const StudyOptions& options, const SlurmPatience& patience)
        : store_(store), study_(study), plan_(plan), options_(options), patience_(patience), folder_(options.folder / "slurm"),
          record_(options.folder / "slurm.json"), most_(most_tasks()), progress_(cells.size(), options.run.quiet) {
        for (const std::size_t i : cells)
            open_[plan.cells[i].cell.name] = {i, 0, {}, {}};
        make_folder(folder_);
        if (fs::exists(record_))
            arrays_ = from_json<Submissions>(CheckedJson::read(record_), submissions_members).arrays;
        for (Submitted& array : arrays_)
            array.tasks = array.cells.size();
    }

    std::map<std::size_t, PlayedInWorker> play() {
        adopt();
        submit_missing();
        while (!open_.empty()) {
            if (Interruption::requested()) {
                cancel_arrays({arrays_.begin(), arrays_.end()});
                tell(LogLevel::warning, "interrupted: all jobs are cancelled; --resume goes on");
                break;
            }
            wait();
            look();
        }
        return outcome_;
    }

  private:
    struct Open {
        std::size_t index = 0;
        int submissions = 0;
        std::optional<Clock::time_point> gone; ///< since its task is not active any more
        std::string state;                     ///< in which the task ended
    };

    /// Arrays whose answer was lost, and those of an earlier call: what is active is not submitted again.
    void adopt() {
        for (Submitted& array : arrays_)
            if (array.id.empty())
                while (!Interruption::requested()) {
                    if (const std::optional<std::string> id = array_id(array.name)) {
                        array.id = *id;
                        break;
                    }
                    wait();
                }
        std::erase_if(arrays_, [](const Submitted& array) { return array.id.empty(); });
        std::optional<SlurmTasks> active;
        while (!arrays_.empty() && !Interruption::requested() && !(active = active_tasks({arrays_.begin(), arrays_.end()})))
            wait();
        for (const Submitted& array : arrays_)
            for (std::size_t task = 0; active && task < array.cells.size(); ++task)
                if (active->contains({array.id, task}))
                    for (const std::string& cell : array.cells[task])
                        if (const auto open = open_.find(cell); open != open_.end())
                            open->second.submissions = 1;
    }

    void submit_missing() {
        std::vector<std::string> names;
        for (const auto& [name, open] : open_)
            if (open.submissions == 0)
                names.push_back(name);
        submit(names);
    }

    /// So many to a task that one array holds them all, and at least as many as were asked for.
    void submit(const std::vector<std::string>& names) {
        if (names.empty())
            return;
        const std::size_t per = std::max<std::size_t>(static_cast<std::size_t>(options_.per), (names.size() + most_ - 1) / most_);
        Submitted array;
        std::vector<std::string> commands;
        for (std::size_t from = 0; from < names.size(); from += per) {
            const std::vector<std::string> some(names.begin() + static_cast<std::ptrdiff_t>(from),
                                                names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), from + per)));
            std::vector<std::size_t> places;
            for (const std::string& name : some) {
                Open& open = open_.at(name);
                ++open.submissions;
                open.gone.reset();
                places.push_back(open.index);
                store_.note_failure(plan_.cells[open.index].key, "");
            }
            array.cells.push_back(some);
            commands.push_back(shell_quoted(playing_command(study_, plan_, places, options_)));
        }
        array.tasks = commands.size();
        const std::string whose = fs::absolute(options_.folder).string() + utc_now();
        array.name = fmt::format("fernlicht-{}-{}", content_hash(whose.data(), whose.size()).substr(0, 10), arrays_.size() + 1);
        arrays_.push_back(array);
        keep_record(); // before it is submitted: whatever happens in between, its name is known
        arrays_.back().id = submit_array(array.name, commands, resources(per), folder_);
        keep_record();
        if (!options_.run.quiet)
            tell(LogLevel::info, fmt::format("submitted {} tasks as job array {}", array.tasks, arrays_.back().id));
    }

    SlurmResources resources(std::size_t per) const {
        const StudyResources& asked = options_.resources;
        return {asked.minutes * static_cast<double>(per),
                static_cast<std::uint64_t>(asked.memory_mib),
                std::max(1, asked.cores),
                asked.partition,
                asked.gpus,
                asked.at_once};
    }

    void keep_record() {
        Submissions all{arrays_};
        write_durably(record_, as_json(all, submissions_members).dump(1) + "\n");
    }

    void wait() {
        const double longer = std::min(10.0, 1.0 + std::chrono::duration<double>(Clock::now() - began_).count() / 60.0);
        const auto until =
            Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience_.ask_every_s * longer));
        while (Clock::now() < until && !Interruption::requested())
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }

    void end(const std::string& name, const std::string& failed) {
        outcome_[open_.at(name).index].failed = failed;
        open_.erase(name);
        progress_.ended(name, 0.0, failed); // how long its task took is the cluster's affair
    }

    void look() {
        const auto active = active_tasks({arrays_.begin(), arrays_.end()});
        std::set<std::string> running;
        for (const Submitted& array : arrays_)
            for (std::size_t task = 0; active && task < array.cells.size(); ++task)
                if (const auto found = active->find({array.id, task}); found != active->end())
                    for (const std::string& cell : array.cells[task])
                        running.insert(cell);
        std::vector<std::string> names, lost;
        for (const auto& [name, open] : open_)
            names.push_back(name);
        for (const std::string& name : names) {
            const PlannedCell& one = plan_.cells[open_.at(name).index];
            if (store_.find(one.key))
                end(name, "");
            else if (active && !running.contains(name) && is_given_up(name))
                lost.push_back(name);
        }
        submit(lost);
        tell_waiting(active);
    }

    /// Once a minute what is waited for, and why tasks do not begin.
    void tell_waiting(const std::optional<SlurmTasks>& active) {
        std::size_t running = 0, pending = 0;
        std::string reason;
        for (const auto& [task, what] : active.value_or(SlurmTasks())) {
            ++(what.state == "PENDING" ? pending : running);
            if (what.state == "PENDING" && reason.empty())
                reason = what.reason;
        }
        progress_.beat(running);
        if (std::chrono::duration<double>(Clock::now() - told_).count() < 60.0 || options_.run.quiet)
            return;
        told_ = Clock::now();
        if (!active)
            tell(LogLevel::warning, "the Slurm controller does not answer; still waiting");
        else if (pending > 0)
            tell(LogLevel::info, fmt::format("{} tasks running, {} pending ({})", running, pending, reason));
    }

    /// Of a cell without a task and without results. True where it is to be submitted again; one that failed is ended.
    bool is_given_up(const std::string& name) {
        Open& open = open_.at(name);
        const std::string& key = plan_.cells[open.index].key;
        if (!open.gone) {
            open.gone = Clock::now();
            open.state = state_of(name);
        }
        if (const std::string why = store_.failure(key); !why.empty())
            return end(name, why), false;
        if (ends_for_good(open.state))
            return end(name, fmt::format("its task ended as {}{}", open.state, log_of(name))), false;
        if (std::chrono::duration<double>(Clock::now() - *open.gone).count() < patience_.late_files_s)
            return false;
        if (open.submissions < patience_.submissions)
            return true;
        end(name, fmt::format("its task was lost {} times, the last one as {}{}", open.submissions,
                              open.state.empty() ? "not known" : open.state, log_of(name)));
        return false;
    }

    /// The last array that has it, and its task.
    std::pair<const Submitted*, std::size_t> task_of(const std::string& name) const {
        for (auto array = arrays_.rbegin(); array != arrays_.rend(); ++array)
            for (std::size_t task = 0; task < array->cells.size(); ++task)
                if (std::ranges::find(array->cells[task], name) != array->cells[task].end())
                    return {&*array, task};
        return {nullptr, 0};
    }
    std::string state_of(const std::string& name) const {
        const auto [array, task] = task_of(name);
        return array ? ended_state(array->id, task) : "";
    }
    std::string log_of(const std::string& name) const {
        const auto [array, task] = task_of(name);
        return array ? fmt::format(" (log: slurm/{}-{}.log)", array->name, task) : "";
    }

    const CellStore& store_;
    const Study& study_;
    const StudyPlan& plan_;
    const StudyOptions& options_;
    SlurmPatience patience_;
    fs::path folder_, record_;
    std::size_t most_;
    Clock::time_point began_ = Clock::now(), told_ = Clock::now();
    std::vector<Submitted> arrays_;
    std::map<std::string, Open> open_;
    std::map<std::size_t, PlayedInWorker> outcome_;
    StudyProgress progress_;
};

} // namespace

std::map<std::size_t, PlayedInWorker> play_on_slurm(const CellStore& store, const Study& study, const StudyPlan& plan,
                                                    const std::vector<std::size_t>& cells, const StudyOptions& options,
                                                    const SlurmPatience& patience) {
    if (cells.empty())
        return {};
    return SlurmStudy(store, study, plan, cells, options, patience).play();
}

} // namespace fernlicht
