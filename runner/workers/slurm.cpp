#include "runner/workers/slurm.h"

#include "runner/files/child_process.h"
#include "runner/files/durable_files.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

struct Answer {
    int code = -1;
    std::string said, complained;
};

std::string all_of(int file) {
    std::string text;
    std::array<char, 4096> buffer{};
    while (true) {
        const ssize_t got = ::read(file, buffer.data(), buffer.size());
        if (got > 0)
            text.append(buffer.data(), static_cast<std::size_t>(got));
        else if (got == 0 || errno != EINTR)
            return text;
    }
}

/// What it complains goes to a file without a name, so that neither can fill up.
Answer ask(std::vector<std::string> words) {
    int said[2] = {-1, -1};
    std::FILE* const complained = std::tmpfile();
    if (!complained || ::pipe2(said, O_CLOEXEC) != 0)
        throw DeviceError(fmt::format("{} cannot be started: {}", words.front(), std::generic_category().message(errno)));
    const auto close_all = [&] {
        ::close(said[0]);
        std::fclose(complained);
    };
    Answer answer;
    try {
        const pid_t program = start_program(std::move(words), {.out = said[1], .error = ::fileno(complained)});
        ::close(said[1]);
        answer.said = all_of(said[0]);
        const int status = end_of_program(program);
        answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    } catch (const DeviceError& error) {
        ::close(said[1]);
        close_all();
        throw DeviceError(std::string(error.what()) + "; Slurm's programs must be on the PATH");
    }
    ::lseek(::fileno(complained), 0, SEEK_SET);
    answer.complained = all_of(::fileno(complained));
    close_all();
    return answer;
}

/// The same where no answer is an answer, too: a machine that cannot start it now may do so when it is asked again.
Answer ask_again_later(std::vector<std::string> words) {
    try {
        return ask(std::move(words));
    } catch (const DeviceError& error) {
        Answer none;
        none.code = 127;
        none.complained = error.what();
        return none;
    }
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// "KEY=value" of scontrol's answers; "" where there is none.
std::string value_in(const std::string& text, const std::string& key) {
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1))
        if (at == 0 || std::isspace(static_cast<unsigned char>(text[at - 1]))) {
            std::size_t from = text.find('=', at);
            if (from == std::string::npos)
                break;
            from = text.find_first_not_of(' ', from + 1);
            if (from == std::string::npos)
                break;
            return text.substr(from, text.find_first_of(" \n", from) - from);
        }
    return {};
}

} // namespace

std::string submit_array(const std::string& name, const std::vector<std::string>& commands, const SlurmResources& resources,
                         const fs::path& folder) {
    const fs::path list = fs::absolute(folder) / (name + ".commands"), script = fs::absolute(folder) / (name + ".sh");
    write_durably(list, fmt::format("{}\n", fmt::join(commands, "\n")));
    write_durably(script, "#!/bin/sh\n# Line SLURM_ARRAY_TASK_ID + 1 of the list is this task's command, quoted for a shell.\n"
                          "command=$(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" \"$1\")\neval \"exec $command\"\n");
    const auto seconds = static_cast<long>(std::ceil(60.0 * resources.minutes));
    std::vector<std::string> words{
        "sbatch",
        "--parsable",
        "--requeue",
        "--job-name=" + name,
        fmt::format("--array=0-{}{}", commands.size() - 1, resources.at_once > 0 ? fmt::format("%{}", resources.at_once) : ""),
        fmt::format("--output={}", (fs::absolute(folder) / (name + "-%a.log")).string()),
        "--open-mode=append",
        fmt::format("--time={}:{:02}", seconds / 60, seconds % 60),
        fmt::format("--cpus-per-task={}", resources.cores),
        "--export=ALL"};
    if (resources.memory_mib > 0)
        words.push_back(fmt::format("--mem={}M", resources.memory_mib));
    if (!resources.partition.empty())
        words.push_back("--partition=" + resources.partition);
    if (!resources.gpus.empty())
        words.push_back("--gres=" + resources.gpus);
    words.insert(words.end(), {script.string(), list.string()});
    const Answer answer = ask(words);
    std::string id = answer.said.substr(0, answer.said.find_first_of(";\n"));
    if (answer.code != 0 || id.empty())
        throw DeviceError(fmt::format("sbatch refused the job array: {}", first_line(answer.complained)));
    return id;
}

std::optional<SlurmTasks> active_tasks(const std::vector<SlurmArray>& arrays) {
    SlurmTasks tasks;
    std::vector<std::string> names;
    for (const SlurmArray& array : arrays)
        names.push_back(array.name);
    if (names.empty())
        return tasks;
    const Answer answer =
        ask_again_later({"squeue", "--noheader", "--array",
                         ("--states=PENDING,RUNNING,SUSPENDED,COMPLETING,CONFIGURING,REQUEUED,REQUEUE_HOLD,REQUEUE_FED,RESIZING,"
                          "SIGNALING,STAGE_OUT,STOPPED,SPECIAL_EXIT,RESV_DEL_HOLD"),
                         fmt::format("--name={}", fmt::join(names, ",")), "--format=%F %K %T %r"});
    if (answer.code != 0)
        return std::nullopt;
    std::istringstream lines(answer.said);
    std::string id, task;
    for (SlurmTask one; lines >> id >> task >> one.state && std::getline(lines >> std::ws, one.reason);)
        if (!task.empty() && task.find_first_not_of("0123456789") == std::string::npos)
            tasks[{id, std::stoul(task)}] = one;
    return tasks;
}

std::optional<std::string> array_id(const std::string& name) {
    const Answer answer = ask_again_later({"squeue", "--noheader", "--array", "--name=" + name, "--format=%F"});
    return answer.code == 0 ? std::optional(first_line(answer.said)) : std::nullopt;
}

std::string ended_state(const std::string& array_id, std::size_t task) {
    const Answer answer = ask_again_later({"scontrol", "show", "job", fmt::format("{}_{}", array_id, task)});
    return answer.code == 0 ? value_in(answer.said, "JobState") : "";
}

std::size_t most_tasks() {
    const Answer answer = ask({"scontrol", "show", "config"});
    const std::string most = value_in(answer.said, "MaxArraySize");
    if (answer.code != 0 || most.empty() || most.find_first_not_of("0123456789") != std::string::npos)
        throw DeviceError(fmt::format("no Slurm controller answers: {}", first_line(answer.complained)));
    return std::max<std::size_t>(2, std::stoul(most)) - 1;
}

std::vector<std::string> cancel_arrays(const std::vector<SlurmArray>& arrays) {
    std::vector<std::string> failed;
    for (const SlurmArray& array : arrays) {
        std::string why;
        try {
            if (const Answer answer = ask({"scancel", "--name=" + array.name}); answer.code != 0)
                why = answer.complained.empty() ? fmt::format("scancel ended with {}", answer.code) : first_line(answer.complained);
        } catch (const DeviceError& error) {
            why = error.what();
        }
        if (!why.empty())
            failed.push_back(fmt::format("job array {} may still run: {}; cancel it by scancel --name={}",
                                         array.id.empty() ? array.name : array.id, why, array.name));
    }
    return failed;
}

} // namespace fernlicht
