#include "runner/commands/words/exit_codes.h"
#include "runner/commands/words/manual.h"

#include "runner/commands/words/help.h"
#include "scenarios/values/version.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

/// What the whole program shares, in roff.
constexpr const char* of_the_program = R"(.SH ENVIRONMENT
.TP
.B FERNLICHT_DATA
folder with drives, lamps, roads and what else is fernlicht's own; asked before all others
.TP
.BR XDG_DATA_HOME ", " XDG_DATA_DIRS
the folders
.I fernlicht
in these are asked last, so what you put into
.I ~/.local/share/fernlicht/drives
is played by its name
.TP
.B XDG_CACHE_HOME
studies keep played cells in its folder
.I fernlicht
.SH FILES
.TP
.I /usr/share/fernlicht
drives, lamps, roads, studies, ratings; where the program is installed elsewhere,
.I ../share/fernlicht
from its folder
.TP
.I /usr/lib/fernlicht/modules
libraries that few commands open
)";

/// Text as roff takes it: its own signs escaped, none at a line's start.
std::string roff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if ((out.empty() || out.back() == '\n') && (c == '.' || c == '\''))
            out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
    }
    return out;
}

/// As man pages are named: "fernlicht-can".
std::string page_name(const CLI::App& command) {
    std::string name = full_name(command);
    std::ranges::replace(name, ' ', '-');
    return name;
}

/// "--repeat N": names in bold, value in italics.
std::string tag(const CLI::Option& option) {
    if (option.get_positional())
        return "\\fI" + roff(value_name(option)) + "\\fR";
    std::string names;
    for (const std::string& name : option.get_snames())
        names += (names.empty() ? "\\fB\\-" : ", \\fB\\-") + roff(name) + "\\fR";
    for (const std::string& name : option.get_lnames())
        names += (names.empty() ? "\\fB\\-\\-" : ", \\fB\\-\\-") + roff(name) + "\\fR";
    return takes_value(option) ? names + " \\fI" + roff(value_name(option)) + "\\fR" : names;
}

void add_options(const CLI::App& command, bool positional, const std::string& group, std::string& page) {
    for (const CLI::Option* option : command.get_options())
        if (option->get_positional() == positional && option->get_group() == group)
            page += ".TP\n" + tag(*option) + "\n" + roff(meaning(*option)) + "\n";
}

/// `section` and `below` are the macros of its headings.
void add_command(const CLI::App& command, const std::string& section, const std::string& below, std::string& page) {
    std::string usage;
    for (const CLI::Option* option : command.get_options())
        if (option->get_required() || option->get_positional())
            usage += option->get_required() ? " " + tag(*option) : " [" + tag(*option) + "]";
    const bool has_more = !commands_below(command).empty();
    page += fmt::format("{}\\fB{}\\fR [\\fIoptions\\fR]{}{}\n", section == ".SH" ? section + " SYNOPSIS\n" : "", roff(full_name(command)),
                        usage, has_more ? " \\fIcommand\\fR" : "");
    page += (section == ".SH" ? ".SH DESCRIPTION\n" : ".PP\n") + roff(command.get_description()) + "\n";
    if (!command.get_footer().empty())
        page += ".PP\n" + roff(command.get_footer()) + "\n";
    const auto has = [&](bool positional, const std::string& group) {
        return std::ranges::any_of(command.get_options(), [&](const CLI::Option* option) {
            return option->get_positional() == positional && option->get_group() == group;
        });
    };
    for (const std::string& group : command.get_groups())
        for (const bool positional : {true, false})
            if (!group.empty() && has(positional, group)) {
                std::string heading = positional ? "Arguments" : group;
                if (section == ".SH")
                    std::ranges::transform(heading, heading.begin(), [](unsigned char c) { return std::toupper(c); });
                page += section == ".SH" ? ".SH \"" + roff(heading) + "\"\n" : ".PP\n" + roff(heading) + ":\n";
                add_options(command, positional, group, page);
            }
    for (const CLI::App* one : commands_below(command)) {
        page += below + " \"" + roff(full_name(*one)) + "\"\n";
        add_command(*one, below, below, page);
    }
}

} // namespace

std::vector<const CLI::App*> commands_below(const CLI::App& command) {
    return command.get_subcommands([](const CLI::App* one) { return !one->get_name().empty() && !one->get_group().empty(); });
}

std::string full_name(const CLI::App& command) {
    return command.get_parent() ? full_name(*command.get_parent()) + " " + command.get_name() : command.get_name();
}

std::vector<std::string> choices_of(const CLI::Option& option) {
    std::string words = option.get_option_text();
    char between = '|';
    if (const std::string& type = option.get_type_name(); words.empty() && type.find('{') != std::string::npos && type.ends_with('}')) {
        words = type.substr(type.find('{') + 1, type.size() - type.find('{') - 2);
        between = ',';
    }
    const bool is_list = words.find(between) != std::string::npos && std::ranges::all_of(words, [&](unsigned char c) {
                             return std::islower(c) || std::isdigit(c) || c == '-' || c == static_cast<unsigned char>(between);
                         });
    return is_list ? CLI::detail::split(words, between) : std::vector<std::string>{};
}

std::string man_page(const CLI::App& command) {
    std::string title = page_name(command);
    std::ranges::transform(title, title.begin(), [](unsigned char c) { return std::toupper(c); });
    std::string page = fmt::format(".TH \"{}\" \"1\" \"\" \"fernlicht {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n", roff(title),
                                   program_version, roff(page_name(command)), roff(command.get_description()));
    if (command.get_parent()) {
        add_command(command, ".SH", ".SS", page);
        return page + ".SH SEE ALSO\n.BR fernlicht (1)\n";
    }
    page += ".SH SYNOPSIS\n.B fernlicht\n\\fIcommand\\fR [\\fIoptions\\fR]\n.PP\n.B fernlicht\n\\fIcommand\\fR \\fB\\-\\-help\\fR\n"
            ".SH DESCRIPTION\nfernlicht plays scripted night drives through an offscreen renderer and measures what the headlamps do. It "
            "needs neither a window nor a GPU.\n.PP\n"
            "\\fBfernlicht run first\\-light\\fR plays a drive of its own and prints the path of the report.\n.SH COMMANDS\n";
    for (const CLI::App* one : commands_below(command))
        page += ".TP\n.BR " + roff(page_name(*one)) + " (1)\n" + roff(one->get_description()) + "\n";
    page += ".SH OPTIONS\n";
    add_options(command, false, "Options", page);
    page += of_the_program + std::string(".SH EXIT STATUS\n");
    for (const ExitMeaning& one : exit_meanings)
        page += fmt::format(".TP\n.B {}\n{}\n", static_cast<int>(one.code), roff(one.meaning));
    return page;
}

} // namespace fernlicht
