// The command line: options end here; below are plain values.
#include "runner/commands/commands.h"
#include "runner/commands/words/exit_codes.h"
#include "runner/commands/words/help.h"
#include "runner/commands/words/old_flags.h"
#include "runner/commands/words/parse_errors.h"
#include "runner/files/log.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/library_folders.h"
#include "scenarios/values/version.h"
#include <CLI/CLI.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace {

/// As --help lists them.
fernlicht::AddCommand* const commands[] = {
    fernlicht::add_new_command,        fernlicht::add_check_command,        fernlicht::add_open_command,
    fernlicht::add_run_command,        fernlicht::add_live_command,         fernlicht::add_film_command,
    fernlicht::add_study_command,      fernlicht::add_bench_command,        fernlicht::add_compare_command,
    fernlicht::add_fit_command,        fernlicht::add_importance_command,   fernlicht::add_masks_command,
    fernlicht::add_rate_command,       fernlicht::add_installation_command, fernlicht::add_improve_command,
    fernlicht::add_accuracy_command,   fernlicht::add_aliasing_command,     fernlicht::add_shadows_command,
    fernlicht::add_reference_command,  fernlicht::add_list_commands,        fernlicht::add_can_command,
    fernlicht::add_lamp_command,       fernlicht::add_model_command,        fernlicht::add_import_command,
    fernlicht::add_storyboard_command, fernlicht::add_doctor_command,       fernlicht::add_stability_command,
    fernlicht::add_accept_command,     fernlicht::add_baselines_command,    fernlicht::add_store_command,
    fernlicht::add_history_command,    fernlicht::add_migrate_command,      fernlicht::add_manual_commands};

using enum fernlicht::ExitCode;

int complain(fernlicht::ExitCode code, const std::exception& error) {
    fernlicht::tell_end(error, static_cast<int>(code));
    return static_cast<int>(code);
}

/// Of every command, and of the commands below it: how it says what it says while it works.
void add_message_flags(CLI::App& command) {
    static const std::map<std::string, fernlicht::LogLevel> levels{{"error", fernlicht::LogLevel::error},
                                                                   {"warning", fernlicht::LogLevel::warning},
                                                                   {"info", fernlicht::LogLevel::info},
                                                                   {"debug", fernlicht::LogLevel::debug}};
    const auto below = command.get_subcommands([](const CLI::App*) { return true; });
    for (CLI::App* one : below)
        add_message_flags(*one);
    if (!below.empty())
        return;
    const auto take = [](const std::string& found) {
        const auto level = levels.find(found);
        if (level == levels.end())
            throw fernlicht::InputError({{}, 0, 0, "--log-level"}, "found '" + fernlicht::printable(found) + "'",
                                        "error, warning, info or debug");
        fernlicht::log_settings().level = level->second;
    };
    command.add_option_function<std::string>("--log-level", take, "messages on standard error: this level and above (default: info)")
        ->option_text("error|warning|info|debug")
        ->group("Messages");
    command.add_flag("--log-json", fernlicht::log_settings().json, "write messages as JSON, an object a line")->group("Messages");
    command
        .add_option_function<std::string>(
            "--annotate",
            [](const std::string& found) {
                if (found != "github")
                    throw fernlicht::InputError({{}, 0, 0, "--annotate"}, "found '" + fernlicht::printable(found) + "'", "github");
                fernlicht::log_settings().github = true;
            },
            "also write what is red as annotations for the pages of a CI server (docs/ci.md)")
        ->option_text("github")
        ->group("Messages");
}

void refuse_unknown_command(const CLI::App& app, const std::vector<std::string>& line, std::size_t at = 1) {
    const std::string& word = line[at];
    std::vector<std::string> commands;
    bool known = word.starts_with('-'); // a flag
    const CLI::App* called = nullptr;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        called = command->check_name(word) ? command : called;
        known = known || called;
        if (!command->get_group().empty()) // else hidden
            commands.push_back(command->get_name());
    }
    if (const std::string old = known ? "" : fernlicht::old_word_in({line[0], word}); !old.empty())
        throw fernlicht::InputError({}, old);
    if (!known) {
        std::string near = fernlicht::nearest_name(word, commands);
        if (!near.starts_with(word.substr(0, 1)))
            near.clear();
        throw fernlicht::InputError({},
                                    fmt::format("'{}' is no command{}", fernlicht::printable(word), at > 1 ? " of " + line[at - 1] : ""),
                                    near.empty() ? fmt::format("one of {}", fmt::join(commands, ", ")) : near);
    }
    if (called && called->get_require_subcommand_min() > 0 && at + 1 < line.size())
        refuse_unknown_command(*called, line, at + 1);
}

/// The words behind the program in CLI11's order, which is from the last: fernlicht:NAME is the path of a shipped file where there is one.
std::vector<std::string> words_of(const std::vector<std::string>& command) {
    constexpr std::string_view ours = "fernlicht:";
    std::vector<std::string> words(command.rbegin(), command.rend());
    if (!words.empty())
        words.pop_back();
    for (std::string& word : words) {
        const std::size_t at = word.find(ours);
        if (at == 0 || (at != std::string::npos && word[at - 1] == '=')) // --flag=..., high=...
            if (const std::filesystem::path file = fernlicht::shipped_path(word.substr(at + ours.size())); !file.empty())
                word.replace(at, std::string::npos, file.string());
    }
    return words;
}

/// So that a log says what ended a program that has nothing to report yet. Calls nothing that a signal's handler may not.
extern "C" void tell_and_end(int signal) {
    constexpr std::string_view plain = "fernlicht: ended by SIGTERM\n", json = "{\"level\":\"error\",\"message\":\"ended by SIGTERM\"}\n";
    const std::string_view told = fernlicht::log_settings().json ? json : plain;
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, told.data(), told.size());
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

} // namespace

int fernlicht::command_line(int argc, char** argv) {
    ::signal(SIGCHLD, SIG_DFL); // else, where a supervisor ignores it, nobody learns how a process ended
    CLI::App app("plays scripted night drives offscreen and measures what the headlamps do", "fernlicht");
    app.formatter(help_formatter());
    app.get_formatter()->label("Positionals", "Arguments");
    app.set_help_flag("-h,--help", "show this help");
    app.set_version_flag("--version", fernlicht::program_version, "print the version and end");
    app.require_subcommand(1);
    std::function<int()> chosen;
    const std::vector<std::string> command(argv, argv + argc);
    log_settings().json = std::ranges::find(command, "--log-json") != command.end(); // a line that cannot be parsed is told so, too
    std::signal(SIGTERM, tell_and_end);
    try {
        for (fernlicht::AddCommand* add : commands)
            add(app, command, chosen);
        add_message_flags(app);
        if (argc > 1)
            refuse_unknown_command(app, command);
        app.parse(words_of(command));
        if (std::exchange(log_settings().github, log_settings().github && !log_settings().json) && log_settings().json)
            throw InputError({{}, 0, 0, "--annotate"}, "found beside --log-json", "one of them: both write lines to standard error");
        const int code = chosen();
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) // a full disk, say; a reader that is gone ended the program by SIGPIPE
            throw DeviceError("standard output cannot be written");
        return code;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) { // --help, --version
            app.exit(error);
            return static_cast<int>(within_limits);
        }
        return complain(users_input, in_our_words(error, app, command));
    } catch (const fernlicht::InputError& error) {
        return complain(users_input, error);
    } catch (const fernlicht::DeviceError& error) {
        return complain(device, error);
    } catch (const std::system_error& error) { // output, files, threads
        return complain(device, error);
    } catch (const std::exception& error) {
        return complain(ours, error);
    }
}
