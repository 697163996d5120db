#include "runner/commands/words/parse_errors.h"

#include "runner/commands/words/help.h"
#include "runner/commands/words/manual.h"
#include "runner/commands/words/old_flags.h"
#include "runner/findings/figures.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <regex>

namespace fernlicht {
namespace {

/// The command that was called: the lowest.
const CLI::App& called(const CLI::App& command) {
    const auto below = command.get_subcommands();
    return below.empty() ? command : called(*below.back());
}

std::vector<std::string> names_of_flags(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
        for (const std::string& name : option->get_snames())
            names.push_back("-" + name);
    }
    return names;
}

InputError unknown_flag(const CLI::App& command, const std::string& typed) {
    const std::string flag = typed.substr(0, typed.find('='));
    std::string near = nearest_name(flag, names_of_flags(command));
    if (near.size() < 3 || flag.size() < 3 || near[2] != flag[2] ||
        std::max(near.size(), flag.size()) - std::min(near.size(), flag.size()) > 3)
        near.clear();                                       // meant is what at least begins alike
    for (const std::string& name : names_of_flags(command)) // what was cut short
        if (near.empty() && flag.size() > 3 && name.starts_with(flag))
            near = name;
    return InputError({}, fmt::format("unknown flag {}{}", printable(flag),
                                      near.empty() ? fmt::format("; `{} --help` lists all", full_name(command))
                                                   : fmt::format("; did you mean {}?", near)));
}

/// By what the error calls it; nullptr: none of the command's.
const CLI::Option* option_in(const CLI::App& command, const std::string& said) {
    for (const CLI::Option* option : command.get_options())
        if (said == option->get_name() || said == option->get_name(false, true) || said == option->get_single_name() ||
            option->check_name(said))
            return option;
    return nullptr;
}

std::string key_of(const CLI::Option& option) { return option.get_positional() ? option.get_single_name() : option.get_name(); }

InputError about_commands(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* one : commands_below(command))
        names.push_back(one->get_name());
    return InputError({}, command.get_parent() ? full_name(command) + " needs a command" : "found no command",
                      fmt::format("one of {}", fmt::join(names, ", ")));
}

} // namespace

InputError in_our_words(const CLI::ParseError& error, const CLI::App& program, const std::vector<std::string>& line) {
    const CLI::App& command = called(program);
    const std::vector<std::string> left = program.remaining(true);
    for (const std::string& word : left) // first: what else is wrong may follow from it
        if (word.size() > 1 && word.starts_with('-') && word != "--") {
            const std::string old = old_word_in(line);
            return old.empty() ? unknown_flag(command, word) : InputError({}, old);
        }
    const std::string said = error.what();
    const auto is = [&](CLI::ExitCodes code) { return error.get_exit_code() == static_cast<int>(code); };
    if (is(CLI::ExitCodes::ExtrasError) && !left.empty())
        return InputError({}, fmt::format("found '{}' more than `{}` takes", printable(left.front()), full_name(command)), usage(command));
    if (is(CLI::ExitCodes::RequiredError) && said.find("ubcommand") != std::string::npos)
        return about_commands(command);
    std::smatch part;
    static const std::regex two(R"((\S+) (requires|excludes) (\S+))"), many("(.*): At Most ([0-9]+) required but received ([0-9]+)"),
        missing(R"((\S+?):? .*)"), required("(.*) is required"), converted("Could not convert: (\\S+) = .*"),
        mismatch(".* arguments to (\\S+), got ([0-9]+)");
    if (std::regex_match(said, part, two)) {
        const bool both = part[2] == "requires";
        return InputError({{}, 0, 0, part[1]}, fmt::format("found {} {}", both ? "without" : "beside", part[3].str()),
                          both ? "both" : "one of them");
    }
    if (std::regex_match(said, part, many)) {
        const int times = std::stoi(part[3]) / std::max(1, std::stoi(part[2]));
        return InputError({{}, 0, 0, part[1]}, times == 2 ? "given twice" : fmt::format("given {} times", times), "it once");
    }
    if (std::regex_match(said, part, required)) {
        const CLI::Option* const option = option_in(command, part[1]);
        return InputError({}, "found no " + (option ? key_of(*option) : part[1].str()), usage(command));
    }
    const bool named =
        std::regex_match(said, part, converted) || std::regex_match(said, part, mismatch) || std::regex_match(said, part, missing);
    const CLI::Option* const option = named ? option_in(command, part[1]) : nullptr;
    if (!option)
        return InputError({}, said);
    const std::vector<std::string>& given = option->results();
    if (!takes_value(*option))
        return InputError({{}, 0, 0, key_of(*option)}, "found a value with it", "none");
    if (is(CLI::ExitCodes::ArgumentMismatch))
        return InputError({{}, 0, 0, key_of(*option)},
                          given.empty() ? "found nothing behind it" : "found " + counted(given.size(), "value"), expected_value(*option));
    return InputError({{}, 0, 0, key_of(*option)}, fmt::format("found '{}'", printable(fmt::format("{}", fmt::join(given, " ")))),
                      expected_value(*option));
}

} // namespace fernlicht
