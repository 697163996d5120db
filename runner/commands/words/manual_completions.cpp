#include "runner/commands/words/manual.h"

#include "runner/commands/words/help.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>

namespace fernlicht {
namespace {

/// The program and all commands below it.
void each_command(const CLI::App& command, const std::function<void(const CLI::App&)>& take) {
    take(command);
    for (const CLI::App* one : commands_below(command))
        each_command(*one, take);
}

std::vector<const CLI::Option*> flags_of(const CLI::App& command) {
    return command.get_options([](const CLI::Option* option) { return !option->get_positional(); });
}

/// "-h", "--help"
std::vector<std::string> words_of(const CLI::Option& flag) {
    std::vector<std::string> words;
    for (const std::string& name : flag.get_snames())
        words.push_back("-" + name);
    for (const std::string& name : flag.get_lnames())
        words.push_back("--" + name);
    return words;
}

std::vector<std::string> names_below(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* one : commands_below(command))
        names.push_back(one->get_name());
    return names;
}

std::string with_before(std::string text, const std::string& escaped, const std::string& before) {
    for (std::size_t at = 0; (at = text.find_first_of(escaped, at)) != std::string::npos; at += before.size() + 1)
        text.insert(at, before);
    return text;
}

/// In single quotes for bash and zsh; fish takes backslashes there.
std::string in_quotes(const std::string& text) {
    std::string out = "'";
    for (const char c : text)
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}
std::string in_quotes_for_fish(const std::string& text) { return "'" + with_before(text, "\\'", "\\") + "'"; }

/// As the name of a shell's function: "_fernlicht_can_record".
std::string function_name(const CLI::App& command) {
    std::string name = "_" + full_name(command);
    for (char& c : name)
        if (c == ' ' || c == '-')
            c = '_';
    return name;
}

std::string zsh_text(const std::string& text) { return with_before(text, "\\[]:", "\\"); }

std::string zsh_flag(const CLI::Option& flag, const std::string& word) {
    std::string spec = flag.get_expected_max() > 1 && takes_value(flag) ? "*" : "";
    spec += word + (!takes_value(flag) ? "" : word.starts_with("--") ? "=" : "+") + "[" + zsh_text(flag.get_description()) + "]";
    if (!takes_value(flag))
        return spec;
    const std::vector<std::string> choices = choices_of(flag);
    return spec + (choices.empty() ? ":value:_files" : fmt::format(":value:({})", fmt::join(choices, " ")));
}

} // namespace

std::string bash_completions(const CLI::App& program) {
    std::string below, flags, choices;
    each_command(program, [&](const CLI::App& command) {
        const std::string name = in_quotes(full_name(command));
        if (const std::vector<std::string> names = names_below(command); !names.empty())
            below += fmt::format("    {}) commands='{}' ;;\n", name, fmt::join(names, " "));
        std::vector<std::string> words;
        for (const CLI::Option* flag : flags_of(command)) {
            const std::vector<std::string> of_flag = words_of(*flag), values = choices_of(*flag);
            words.insert(words.end(), of_flag.begin(), of_flag.end());
            for (const std::string& word : of_flag)
                if (takes_value(*flag))
                    choices += fmt::format("    {}) values={} ;;\n", in_quotes(full_name(command) + " " + word),
                                           values.empty() ? "files" : in_quotes(fmt::format("{}", fmt::join(values, " "))));
        }
        flags += fmt::format("    {}) flags='{}' ;;\n", name, fmt::join(words, " "));
    });
    return fmt::format(R"(# Completions of bash for fernlicht. Written by `fernlicht completions bash`.
_fernlicht_below() {{
    case $1 in
{0}    *) commands= ;;
    esac
}}

_fernlicht() {{
    local command=fernlicht commands flags='' values='' word i=1 current=${{COMP_WORDS[COMP_CWORD]}} last=${{COMP_WORDS[COMP_CWORD - 1]}}
    _fernlicht_below "$command"
    while ((i < COMP_CWORD)) && [[ " $commands " == *" ${{COMP_WORDS[i]}} "* ]]; do
        command+=" ${{COMP_WORDS[i++]}}"
        _fernlicht_below "$command"
    done
    if [[ $current == = ]]; then # --flag=
        current=
    elif [[ $last == = ]]; then # --flag=value
        last=${{COMP_WORDS[COMP_CWORD - 2]}}
    fi
    case $command in
{1}    esac
    case "$command $last" in
{2}    esac
    COMPREPLY=()
    if [[ $values == files ]]; then
        return # to the shell's own, by -o default
    elif [[ -n $values ]]; then
        word=$values
    elif [[ $current == -* ]]; then
        word=$flags
    else
        word=$commands
    fi
    mapfile -t COMPREPLY < <(compgen -W "$word" -- "$current")
}}
complete -o default -F _fernlicht fernlicht
)",
                       below, flags, choices);
}

std::string zsh_completions(const CLI::App& program) {
    std::string text = "#compdef fernlicht\n# Completions of zsh for fernlicht. Written by `fernlicht completions zsh`.\n";
    each_command(program, [&](const CLI::App& command) {
        std::string specs, called;
        for (const CLI::Option* flag : flags_of(command))
            for (const std::string& word : words_of(*flag))
                specs += " \\\n        " + in_quotes(zsh_flag(*flag, word));
        if (commands_below(command).empty()) {
            text += fmt::format("\n{}() {{\n    _arguments{} \\\n        '*:file:_files'\n}}\n", function_name(command), specs);
            return;
        }
        std::string list;
        for (const CLI::App* one : commands_below(command)) {
            list += "\n        " + in_quotes(zsh_text(one->get_name()) + ":" + one->get_description());
            called += fmt::format("        {}) {} ;;\n", one->get_name(), function_name(*one));
        }
        text += fmt::format(R"(
{0}() {{
    local curcontext=$curcontext state line
    typeset -A opt_args
    local -a commands=({1}
    )
    _arguments -C{2} \
        '1: :->command' '*:: :->rest'
    case $state in
    command) _describe -t commands 'command' commands ;;
    rest)
        case $line[1] in
{3}        esac
        ;;
    esac
}}
)",
                            function_name(command), list, specs, called);
    });
    return text + "\nif [[ $funcstack[1] == _fernlicht ]]; then\n    _fernlicht \"$@\"\nelse\n    compdef _fernlicht fernlicht\nfi\n";
}

std::string fish_completions(const CLI::App& program) {
    std::string text = R"(# Completions of fish for fernlicht. Written by `fernlicht completions fish`.
# Whether the line so far begins with these commands, or with --only holds no more.
function __fernlicht_in
    set -l words (commandline -opc)
    set -e words[1]
    if test "$argv[1]" = --only
        set -e argv[1]
        test "$words" = "$argv"
        return
    end
    set -l count (count $argv)
    test (count $words) -ge $count; and test "$words[1..$count]" = "$argv"
end
)";
    each_command(program, [&](const CLI::App& command) {
        const std::string name = full_name(command), words = name.substr(std::min(name.size(), program.get_name().size() + 1));
        for (const CLI::App* one : commands_below(command))
            text += fmt::format("complete -c fernlicht -f -n '__fernlicht_in --only {}' -a {} -d {}\n", words, one->get_name(),
                                in_quotes_for_fish(one->get_description()));
        for (const CLI::Option* flag : flags_of(command)) {
            text += fmt::format("complete -c fernlicht -n '__fernlicht_in {}{}'", command.get_parent() ? "" : "--only ", words);
            for (const std::string& one : flag->get_snames())
                text += " -s " + one;
            for (const std::string& one : flag->get_lnames())
                text += " -l " + one;
            if (const std::vector<std::string> choices = choices_of(*flag); !choices.empty())
                text += fmt::format(" -x -a '{}'", fmt::join(choices, " "));
            else if (takes_value(*flag))
                text += " -r";
            text += " -d " + in_quotes_for_fish(flag->get_description()) + "\n";
        }
    });
    return text;
}

} // namespace fernlicht
