#include "runner/experiments/study/slurm_playing.h"

#include "runner/experiments/study/study_progress.h"
#include "runner/files/described_json.h"
#include "runner/files/durable_files.h"
#include "runner/files/log.h"
#include "runner/findings/figures.h"
#include "runner/findings/run_context.h"
#include "runner/play/progress.h"
#include "runner/workers/slurm.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <set>
#include <span>
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
            open_[plan.cells[i].cell.name].index = i;
        make_folder(folder_);
        if (fs::exists(record_))
            arrays_ = from_json<Submissions>(CheckedJson::read(record_), submissions_members).arrays;
    }

    std::map<std::size_t, PlayedInWorker> play() {
        for (adopt(); !Interruption::requested(); wait()) {
            look();
            if (open_.empty())
                return outcome_;
        }
        const std::vector<std::string> failed = cancel_arrays({arrays_.begin(), arrays_.end()});
        for (const std::string& why : failed)
            tell(LogLevel::warning, "interrupted: " + why);
        if (failed.empty())
            tell(LogLevel::warning, "interrupted: all jobs are cancelled; --resume goes on");
        return outcome_;
    }

  private:
    struct Open {
        std::size_t index = 0;
        int submissions = 0;
        bool due = true;                          ///< to be submitted
        bool alone = true;                        ///< in its task
        std::pair<std::string, std::size_t> task; ///< array and number; the array is "" while its answer is not known
        std::string log;                          ///< of its task
        std::optional<Clock::time_point> gone;    ///< since its task is not active any more
        std::string state;                        ///< in which the task ended
    };

    /// What an earlier call submitted and is still active is not submitted again.
    void adopt() {
        std::optional<SlurmTasks> active;
        while (!Interruption::requested() && !(settle() && (active = active_tasks({arrays_.begin(), arrays_.end()}))))
            wait();
        for (const Submitted& array : arrays_)
            for (std::size_t task = 0; active && task < array.cells.size(); ++task)
                if (active->contains({array.id, task}))
                    for (const std::string& cell : array.cells[task])
                        if (const auto open = open_.find(cell); open != open_.end()) {
                            put_into(open->second, array, task);
                            open->second.submissions = 1;
                            has_begun_ = true;
                        }
    }

    static void put_into(Open& open, const Submitted& array, std::size_t task) {
        open.due = false;
        open.alone = array.cells[task].size() == 1;
        open.task = {array.id, task};
        open.log = fmt::format(" (log: slurm/{}-{}.log)", array.name, task);
        open.gone.reset();
    }

    /// Arrays whose answer was lost get their id, or are taken back where they were never there. False while the controller does not say.
    bool settle() {
        for (std::size_t i = 0; i < arrays_.size();) {
            const std::optional<std::string> id = arrays_[i].id.empty() ? array_id(arrays_[i].name) : arrays_[i].id;
            if (!id)
                return false;
            if (id->empty())
                take_back(i);
            else if (arrays_[i].id.empty())
                begin(arrays_[i++], *id);
            else
                ++i;
        }
        return true;
    }

    void begin(Submitted& array, const std::string& id) {
        array.id = id;
        has_begun_ = true;
        for (const std::vector<std::string>& task : array.cells)
            for (const std::string& cell : task)
                if (const auto open = open_.find(cell); open != open_.end())
                    open->second.task.first = id;
        keep_record();
    }

    void take_back(std::size_t i) {
        for (const std::vector<std::string>& task : arrays_[i].cells)
            for (const std::string& cell : task)
                if (const auto open = open_.find(cell); open != open_.end()) {
                    open->second.submissions -= open->second.due ? 0 : 1;
                    open->second.due = true;
                }
        std::error_code ignored;
        for (const char* ending : {".commands", ".sh"})
            fs::remove(folder_ / (arrays_[i].name + ending), ignored);
        arrays_.erase(arrays_.begin() + static_cast<std::ptrdiff_t>(i));
        keep_record();
    }

    /// One array, `per` cells to a task. Throws DeviceError where it is the first and sbatch refuses; later ones are tried again.
    void submit(const std::vector<std::string>& names, std::size_t per) {
        if (names.empty() || Clock::now() < submit_from_)
            return;
        Submitted array;
        std::vector<std::string> commands;
        const std::string whose = fs::absolute(options_.folder).string() + utc_now();
        array.name = fmt::format("fernlicht-{}-{}", content_hash(whose.data(), whose.size()).substr(0, 10), ++named_);
        for (std::size_t from = 0; from < names.size(); from += per) {
            array.cells.emplace_back(names.begin() + static_cast<std::ptrdiff_t>(from),
                                     names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), from + per)));
            std::vector<std::size_t> places;
            for (const std::string& name : array.cells.back()) {
                Open& open = open_.at(name);
                ++open.submissions;
                put_into(open, array, array.cells.size() - 1);
                places.push_back(open.index);
                store_.note_failure(plan_.cells[open.index].key, "");
            }
            commands.push_back(shell_quoted(playing_command(study_, plan_, places, options_)));
        }
        arrays_.push_back(array);
        keep_record(); // before it is submitted: whatever happens in between, its name is known
        try {
            begin(arrays_.back(), submit_array(array.name, commands, resources(per), folder_));
        } catch (const DeviceError& error) {
            settle(); // the answer alone may be lost
            if (const auto there = std::ranges::find(arrays_, array.name, &SlurmArray::name); there == arrays_.end() || there->id.empty()) {
                if (!has_begun_)
                    throw;
                return note_refusal(error.what());
            }
        }
        refusals_ = 0;
        if (!options_.run.quiet)
            tell(LogLevel::info,
                 fmt::format("submitted {} as job array {}{}", counted(commands.size(), "task"), arrays_.back().id, again_words(names)));
    }

    /// Of cells that were lost before.
    std::string again_words(const std::vector<std::string>& names) const {
        constexpr std::size_t named = 5;
        if (open_.at(names.front()).submissions < 2)
            return "";
        return fmt::format(", once more: {}{}", fmt::join(std::span(names).first(std::min(named, names.size())), ", "),
                           names.size() > named ? fmt::format(" and {} more", names.size() - named) : "");
    }

    void note_refusal(const std::string& why) {
        refusal_ = why;
        submit_from_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience_.refused_every_s));
        if (++refusals_ == 1)
            tell(LogLevel::warning, fmt::format("{}; it is asked again every {:g} s", why, patience_.refused_every_s));
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
        progress_.ended(name, 0.0, failed); // how long its task took is the cluster's affair
        if (const std::string& key = plan_.cells[open_.at(name).index].key; !failed.empty() && store_.failure(key).empty())
            store_.note_failure(key, failed);
        outcome_[open_.at(name).index].failed = failed;
        open_.erase(name);
    }

    /// Asks for what is waited for, once for all, and submits what is due. First submissions have as many cells to a task as were asked
    /// for, more where one array would not hold them; a cell that was lost has a task of its own, so that it takes no other with it.
    void look() {
        settle();
        const std::optional<SlurmTasks> active = active_tasks(awaited());
        std::vector<std::string> names, missing, lost;
        for (const auto& [name, open] : open_)
            names.push_back(name);
        for (const std::string& name : names) {
            Open& open = open_.at(name);
            if (const std::optional<std::string> ended = open.due ? why_refused(active) : how_ended(open, active))
                end(name, *ended);
            else if (open.due)
                (open.submissions == 0 ? missing : lost).push_back(name);
        }
        submit(missing, std::max(static_cast<std::size_t>(options_.per), (missing.size() + most_ - 1) / most_));
        lost.resize(std::min(lost.size(), most_)); // the others when it is looked again
        submit(lost, 1);
        tell_waiting(active);
    }

    /// Arrays in which a cell is waited for.
    std::vector<SlurmArray> awaited() const {
        std::set<std::string> ids;
        for (const auto& [name, open] : open_)
            if (!open.due)
                ids.insert(open.task.first);
        std::vector<SlurmArray> some;
        std::ranges::copy_if(arrays_, std::back_inserter(some), [&](const Submitted& array) { return ids.contains(array.id); });
        return some;
    }

    /// nullopt while there is hope, or another task is active.
    std::optional<std::string> why_refused(const std::optional<SlurmTasks>& active) const {
        if (refusals_ < patience_.refusals || !active || !active->empty())
            return std::nullopt;
        return fmt::format("{}, {} times", refusal_, refusals_);
    }

    /// Why the cell has no results; "" where it has some, nullopt while it may get some. One whose task was lost becomes due.
    std::optional<std::string> how_ended(Open& open, const std::optional<SlurmTasks>& active) const {
        const auto task = active ? active->find(open.task) : SlurmTasks::const_iterator();
        const bool listed = active && task != active->end();
        if (listed || (active && open.task.first.empty())) {
            open.gone.reset(); // it may have been put back into the queue
            if (!listed || open.alone || task->second.state == "PENDING")
                return std::nullopt; // its results come when it ends; the store is not asked in vain
        }
        const std::string& key = plan_.cells[open.index].key;
        if (store_.find(key))
            return "";
        if (listed || !active)
            return std::nullopt;
        if (!open.gone) {
            open.gone = Clock::now();
            open.state = ended_state(open.task.first, open.task.second);
        }
        if (const std::string why = store_.failure(key); !why.empty())
            return why;
        if (open.alone && ends_for_good(open.state))
            return fmt::format("its task ended as {}{}", open.state, open.log);
        if (std::chrono::duration<double>(Clock::now() - *open.gone).count() < patience_.late_files_s)
            return std::nullopt;
        open.due = open.submissions < patience_.submissions;
        if (open.due)
            return std::nullopt;
        return fmt::format("its task was lost {} times{}{}", open.submissions,
                           open.state.empty() ? "; Slurm no longer knows how it last ended" : ", the last one as " + open.state, open.log);
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

    const CellStore& store_;
    const Study& study_;
    const StudyPlan& plan_;
    const StudyOptions& options_;
    SlurmPatience patience_;
    fs::path folder_, record_;
    std::size_t most_;
    Clock::time_point began_ = Clock::now(), told_ = Clock::now(), submit_from_ = Clock::now();
    bool has_begun_ = false; ///< a task of this study is, or was, on the cluster
    int named_ = 0;          ///< arrays of this call
    int refusals_ = 0;       ///< by sbatch, in a row
    std::string refusal_;
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
