#include "runner/files/child_process.h"

#include "scenarios/values/errors.h"

#include <cerrno>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

extern char** environ; // NOLINT: POSIX's

namespace fernlicht {

pid_t start_program(std::vector<std::string> words, const ChildStreams& streams) {
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    for (const auto& [from, to] : {std::pair(streams.in, STDIN_FILENO), {streams.out, STDOUT_FILENO}, {streams.error, STDERR_FILENO}})
        if (from >= 0)
            ::posix_spawn_file_actions_adddup2(&actions, from, to);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    pid_t program = -1;
    const int error = ::posix_spawnp(&program, pointers.front(), &actions, &attributes, pointers.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        throw DeviceError(fmt::format("{} cannot be started: {}", printable(words.front()), std::generic_category().message(error)));
    return program;
}

int end_of_program(pid_t program) {
    int status = 0;
    while (::waitpid(program, &status, 0) < 0 && errno == EINTR)
        ;
    return status;
}

} // namespace fernlicht
