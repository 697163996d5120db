#include "runner/commands/commands.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/manual.h"
#include "runner/commands/words/shared_flags.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <memory>

namespace fernlicht {
namespace {

struct ManFlags {
    std::string command;
    std::filesystem::path out;
};

/// One page to standard output, or all into a folder.
int man(const CLI::App& program, const ManFlags& flags) {
    std::vector<std::string> names;
    for (const CLI::App* one : commands_below(program)) {
        names.push_back(one->get_name());
        if (!flags.out.empty())
            write_file(flags.out / ("fernlicht-" + one->get_name() + ".1"), man_page(*one));
        else if (one->get_name() == flags.command)
            return fmt::print("{}", man_page(*one)), 0;
    }
    if (!flags.command.empty())
        throw InputError({{}, 0, 0, "COMMAND"}, "found '" + printable(flags.command) + "'",
                         fmt::format("one of {}", fmt::join(names, ", ")));
    if (flags.out.empty())
        fmt::print("{}", man_page(program));
    else
        write_file(flags.out / "fernlicht.1", man_page(program));
    return 0;
}

} // namespace

void add_manual_commands(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    add_docs_command(app, chosen);
    const auto flags = std::make_shared<ManFlags>();
    CLI::App* sub = app.add_subcommand("man", "print a man page: man -l <(fernlicht man run)")->group("");
    CLI::Option* const command = sub->add_option("COMMAND", flags->command, "whose page")->default_str("the program's");
    add_shared(*sub, "--out", flags->out)->excludes(command);
    sub->footer("With --out all pages are written.");
    sub->callback([&app, flags, &chosen] { chosen = [&app, flags] { return man(app, *flags); }; });

    static const std::map<std::string, std::string (*)(const CLI::App&)> shells{
        {"bash", bash_completions}, {"fish", fish_completions}, {"zsh", zsh_completions}};
    const auto shell = std::make_shared<std::string>();
    sub = app.add_subcommand("completions", "print what a shell completes: . <(fernlicht completions bash)")->group("");
    sub->add_option("SHELL", *shell, "bash, fish or zsh")->required();
    sub->callback([&app, shell, &chosen] {
        chosen = [&app, shell] {
            const auto found = shells.find(*shell);
            if (found == shells.end())
                throw InputError({{}, 0, 0, "SHELL"}, "found '" + printable(*shell) + "'", "bash, fish or zsh");
            fmt::print("{}", found->second(app));
            return 0;
        };
    });
}

} // namespace fernlicht
