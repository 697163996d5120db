// Commands in processes of their own, several at a time, each with limits of time and memory: whatever one of them does, the others go on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace fernlicht {

struct WorkerCommand {
    std::vector<std::string> words;       ///< the first is what it is called by
    std::filesystem::path program;        ///< what is started; "": the first word, a path
    std::vector<std::string> environment; ///< "NAME=value", beside that of this process
    std::filesystem::path log;            ///< takes what it prints when it ended, behind what is there
};

struct WorkerLimits {
    double time_s = 3600.0;       ///< then it is asked to end, and killed five seconds later
    std::uint64_t memory_mib = 0; ///< of its own data; 0: none
};

enum class WorkerEnding { exited, killed, timed_out, ended_by_us };
struct WorkerEnd {
    WorkerEnding ending = WorkerEnding::exited;
    int code = 0; ///< of exit, or the signal
    double seconds = 0.0, cpu_s = 0.0;
    double peak_memory_mib = 0.0; ///< resident
    std::string said;             ///< the last line that it printed, also where a full disk did not take the log
};
/// "ended with exit code 3", "was killed by SIGSEGV", "was stopped after 605 s; its limit is 600 s"; with what it says of memory.
std::string ending_text(const WorkerEnd& end, const WorkerLimits& limits);
/// ", with 490 MiB of the 500 MiB that it may take"; "" where it took less than 80 %.
std::string memory_words(const WorkerEnd& end, const WorkerLimits& limits);

struct WorkerPool {
    std::size_t at_once = 1;
    WorkerLimits limits;
    std::function<bool()> go_on = [] { return true; }; ///< asked all the time; false: those that run are ended, none is started
    std::function<void(std::size_t running)> beat = [](std::size_t) {}; ///< called twice a second
};

/// Runs `count` commands, at most `at_once` at a time, in order. `command(i)` is asked when i is about to start, `ended` told when it did.
/// A command of no words is left out. Commands die with this process. Throws DeviceError where no process can be made.
void run_workers(std::size_t count, const WorkerPool& pool, const std::function<WorkerCommand(std::size_t)>& command,
                 const std::function<void(std::size_t, const WorkerEnd&)>& ended);

} // namespace fernlicht
