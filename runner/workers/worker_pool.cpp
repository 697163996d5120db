#include "runner/workers/worker_pool.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

extern char** environ; // NOLINT: POSIX's

namespace fernlicht {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double grace_s = 5.0, ended_by_us_grace_s = 20.0; ///< schedulers give 30
constexpr auto look_every = std::chrono::milliseconds(5);

struct Worker {
    std::size_t index = 0;
    ::pid_t pid = -1;
    int printed = -1; ///< a file in memory: a disk that is full loses no message
    std::filesystem::path log;
    Clock::time_point started, asked;
    bool timed_out = false, ended_by_us = false;
};

double since(Clock::time_point from) { return std::chrono::duration<double>(Clock::now() - from).count(); }

double seconds_of(const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); }

std::vector<char*> pointers_of(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

std::vector<std::string> environment_with(const std::vector<std::string>& more) {
    std::vector<std::string> all = more;
    for (char** entry = environ; *entry; ++entry) {
        const std::string one = *entry;
        const std::string name = one.substr(0, one.find('=') + 1);
        if (std::ranges::none_of(more, [&](const std::string& known) { return known.starts_with(name); }))
            all.push_back(one);
    }
    return all;
}

/// In the child, between fork and exec: only what needs no lock. Does not return.
[[noreturn]] void become(const char* program, char* const* words, char* const* environment, int log, const WorkerLimits& limits,
                         ::pid_t parent) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) // it died meanwhile
        ::_exit(127);
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE})
        std::signal(signal, SIG_DFL);
    if (limits.memory_mib > 0) {
        const rlimit bytes{limits.memory_mib << 20, limits.memory_mib << 20};
        ::setrlimit(RLIMIT_DATA, &bytes);
    }
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (const int nothing = ::open("/dev/null", O_RDONLY); nothing >= 0)
        ::dup2(nothing, STDIN_FILENO);
    ::dup2(log, STDOUT_FILENO);
    ::dup2(log, STDERR_FILENO);
    ::execve(program, words, environment);
    const char said[] = "this program cannot be started again\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, said, sizeof said - 1);
    ::_exit(126);
}

Worker start_worker(std::size_t index, WorkerCommand command, const WorkerLimits& limits) {
    const int printed = ::memfd_create("printed", MFD_CLOEXEC);
    if (printed < 0)
        throw DeviceError("no process can be started: " + std::generic_category().message(errno));
    std::vector<std::string> environment = environment_with(command.environment);
    const std::vector<char*> words = pointers_of(command.words), variables = pointers_of(environment);
    const std::string program = command.program.empty() ? command.words.front() : command.program.string();
    const ::pid_t parent = ::getpid();
    Worker worker{index, ::fork(), printed, std::move(command.log), Clock::now(), {}, false, false};
    if (worker.pid == 0)
        become(program.c_str(), words.data(), variables.data(), printed, limits, parent);
    if (worker.pid < 0) {
        const int error = errno;
        ::close(printed);
        throw DeviceError("no process can be started: " + std::generic_category().message(error));
    }
    ::setpgid(worker.pid, worker.pid); // here too: whoever is first
    return worker;
}

void send(const Worker& worker, int signal) { ::kill(-worker.pid, signal); }

/// Asks it to end, and kills it when it did not.
void end_worker(Worker& worker, double patience_s) {
    if (worker.asked == Clock::time_point()) {
        worker.asked = Clock::now();
        send(worker, SIGTERM);
    } else if (since(worker.asked) > patience_s)
        send(worker, SIGKILL);
}

/// Into its log, and the last line of it.
std::string take_printed(const Worker& worker) {
    std::string text(static_cast<std::size_t>(std::max<::off_t>(0, ::lseek(worker.printed, 0, SEEK_END))), '\0');
    text.resize(static_cast<std::size_t>(std::max<::ssize_t>(0, ::pread(worker.printed, text.data(), text.size(), 0))));
    ::close(worker.printed);
    if (!text.empty())
        std::ofstream(worker.log, std::ios::app | std::ios::binary) << text;
    while (text.ends_with('\n'))
        text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

/// True where it ended.
bool look_after(Worker& worker, const WorkerPool& pool, bool going_on, WorkerEnd& end) {
    int status = 0;
    rusage usage{};
    const ::pid_t found = ::wait4(worker.pid, &status, WNOHANG, &usage);
    if (found == 0 || (found < 0 && errno == EINTR)) {
        worker.ended_by_us = worker.ended_by_us || (!going_on && !worker.timed_out);
        worker.timed_out = worker.timed_out || (!worker.ended_by_us && since(worker.started) > pool.limits.time_s);
        if (worker.ended_by_us || worker.timed_out)
            end_worker(worker, worker.ended_by_us ? ended_by_us_grace_s : grace_s);
        return false;
    }
    send(worker, SIGKILL); // what it left running
    end.said = take_printed(worker);
    end.seconds = since(worker.started);
    end.cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    end.peak_memory_mib = static_cast<double>(usage.ru_maxrss) / 1024.0;
    end.ending = worker.ended_by_us    ? WorkerEnding::ended_by_us
                 : worker.timed_out    ? WorkerEnding::timed_out
                 : WIFSIGNALED(status) ? WorkerEnding::killed
                                       : WorkerEnding::exited;
    end.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
    return true;
}

/// However this ends, none of them goes on.
struct Workers {
    std::vector<Worker> all;
    Workers() = default;
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    ~Workers() {
        for (const Worker& worker : all) {
            send(worker, SIGKILL);
            ::waitpid(worker.pid, nullptr, 0);
            ::close(worker.printed);
        }
    }
};

} // namespace

std::string ending_text(const WorkerEnd& end, const WorkerLimits& limits) {
    std::string text;
    switch (end.ending) {
    case WorkerEnding::exited:
        text = fmt::format("ended with exit code {}", end.code);
        break;
    case WorkerEnding::killed:
        text = fmt::format("was killed by {}",
                           ::sigabbrev_np(end.code) ? std::string("SIG") + ::sigabbrev_np(end.code) : fmt::format("signal {}", end.code));
        break;
    case WorkerEnding::timed_out:
        text = fmt::format("was stopped after {:.{}f} s; its limit is {:g} s", end.seconds, end.seconds < 2.0 ? 2 : 0, limits.time_s);
        break;
    case WorkerEnding::ended_by_us:
        text = "was interrupted";
        break;
    }
    return text + memory_words(end, limits);
}

std::string memory_words(const WorkerEnd& end, const WorkerLimits& limits) {
    if (limits.memory_mib == 0 || end.ending == WorkerEnding::ended_by_us ||
        end.peak_memory_mib <= 0.8 * static_cast<double>(limits.memory_mib))
        return "";
    return fmt::format(", with {:.0f} MiB of the {} MiB that it may take", end.peak_memory_mib, limits.memory_mib);
}

void run_workers(std::size_t count, const WorkerPool& pool, const std::function<WorkerCommand(std::size_t)>& command,
                 const std::function<void(std::size_t, const WorkerEnd&)>& ended) {
    Workers workers;
    std::size_t next = 0;
    Clock::time_point last_beat;
    while (true) {
        const bool going_on = pool.go_on();
        while (going_on && next < count && workers.all.size() < std::max<std::size_t>(1, pool.at_once)) {
            WorkerCommand one = command(next);
            if (!one.words.empty())
                workers.all.push_back(start_worker(next, std::move(one), pool.limits));
            ++next;
        }
        if (workers.all.empty())
            return;
        for (std::size_t i = 0; i < workers.all.size();) {
            WorkerEnd end;
            if (!look_after(workers.all[i], pool, going_on, end)) {
                ++i;
                continue;
            }
            const std::size_t index = workers.all[i].index;
            workers.all.erase(workers.all.begin() + static_cast<std::ptrdiff_t>(i));
            ended(index, end);
        }
        if (since(last_beat) >= 0.5) {
            last_beat = Clock::now();
            pool.beat(workers.all.size());
        }
        std::this_thread::sleep_for(look_every);
    }
}

} // namespace fernlicht
