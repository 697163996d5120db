
#include "runner/commands/commands.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/model_command.h"
#include "runner/commands/words/shared_flags.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/program_module.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fernlicht {
namespace {

constexpr rlim_t max_memory_bytes = rlim_t{4} << 30;
constexpr unsigned max_seconds = 300;

/// What the program wrote to one of its channels, as long as it lives.
std::string all_from(int descriptor) {
    std::string text;
    char buffer[4096];
    for (ssize_t count = 0; (count = ::read(descriptor, buffer, sizeof buffer)) != 0;)
        if (count > 0 && text.size() < 100'000)
            text.append(buffer, static_cast<std::size_t>(count));
        else if (count < 0 && errno != EINTR)
            break;
    ::close(descriptor);
    return text;
}

struct Ended {
    int status = 0;
    std::string said;
};

/// Both of its channels into one pipe; only async-signal-safe calls between fork and exec.
Ended run(const std::filesystem::path& program, const std::filesystem::path& file, const std::filesystem::path& out, char forward) {
    const std::string words[] = {program.string(), file.string(), out.string(), std::string(1, forward)};
    const char* arguments[] = {words[0].c_str(), words[1].c_str(), words[2].c_str(), words[3].c_str(), nullptr};
    int channel[2];
    if (::pipe(channel) != 0)
        throw DeviceError(std::string("no pipe to fernlicht-import: ") + std::strerror(errno));
    const pid_t child = ::fork();
    if (child < 0)
        throw DeviceError(std::string("fernlicht-import cannot be started: ") + std::strerror(errno));
    if (child == 0) {
        ::dup2(channel[1], 1);
        ::dup2(channel[1], 2);
        ::close(channel[0]);
        ::close(channel[1]);
        const rlimit memory{max_memory_bytes, max_memory_bytes}, core{0, 0};
        ::setrlimit(RLIMIT_AS, &memory);
        ::setrlimit(RLIMIT_CORE, &core);
        ::alarm(max_seconds);
        ::execv(arguments[0], const_cast<char* const*>(arguments));
        ::_exit(127);
    }
    ::close(channel[1]);
    Ended ended;
    ended.said = all_from(channel[0]);
    while (::waitpid(child, &ended.status, 0) < 0 && errno == EINTR) {
    }
    return ended;
}

std::string last_line(std::string text) {
    while (text.ends_with('\n'))
        text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

} // namespace

int import_command(const ImportRequest& request) {
    std::error_code error;
    if (request.out.extension() != ".glb")
        throw InputError({{}, 0, 0, "OUT"}, "found '" + printable(request.out.string()) + "'", "a name that ends in .glb");
    check_target("OUT", request.out, request.force);
    const std::filesystem::path program = request.program.empty() ? program_part("fernlicht-import") : request.program;
    if (!std::filesystem::exists(program, error))
        throw DeviceError("there is no " + program.string() +
                          ": it is built where OpenSceneGraph (libopenscenegraph-dev) is installed, and packaged as fernlicht-import");
    const Ended ended = run(program, request.file, request.out, request.forward);
    if (WIFSIGNALED(ended.status))
        throw InputError({request.file, 0, 0, {}},
                         WTERMSIG(ended.status) == SIGALRM
                             ? fmt::format("not read within {} s", max_seconds)
                             : fmt::format("OpenSceneGraph's reader ended by signal {}", WTERMSIG(ended.status)),
                         "an OpenFlight file that is whole");
    const int code = WEXITSTATUS(ended.status);
    if (code == 2) // its sentence names the file already
        throw InputError({}, last_line(ended.said));
    if (code != 0)
        throw DeviceError(code == 127 ? "fernlicht-import cannot be started" : last_line(ended.said));
    fmt::print("{}", ended.said);
    fmt::print("{}", model_text(read_model(request.out), 1.0));
    return 0;
}

void add_import_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto request = std::make_shared<ImportRequest>();
    const auto forward = std::make_shared<std::string>("y");
    CLI::App* command = app.add_subcommand("import", "convert an OpenFlight database (.flt) to glTF (.glb)");
    command->add_option("FILE", request->file, "OpenFlight, 14.0 to 17.0")->required();
    command->add_option("OUT", request->out, "new file for the glTF, NAME.glb")->required();
    command->add_option("--forward", *forward, "the file's forward axis: y for vehicles, x where x is east and y north")
        ->check(CLI::IsMember({"x", "y"}))
        ->option_text("x|y")
        ->capture_default_str();
    add_shared(*command, "--force", request->force);
    command->callback([request, forward, &chosen] {
        chosen = [request, forward] {
            request->forward = (*forward)[0];
            return import_command(*request);
        };
    });
}

} // namespace fernlicht
