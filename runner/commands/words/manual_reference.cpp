#include "runner/commands/words/exit_codes.h"
#include "runner/commands/words/help.h"
#include "runner/commands/words/manual.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace fernlicht {
namespace {

std::string text_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    const std::string value = option.get_positional() || takes_value(option) ? value_name(option) : "";
    return fmt::format("`{}{}{}`: {}", fmt::join(names, ", "), names.empty() || value.empty() ? "" : " ", value, meaning(option));
}

void each(const CLI::App& command, const std::function<void(const CLI::App&)>& take) {
    for (const CLI::App* one : commands_below(command)) {
        take(*one);
        each(*one, take);
    }
}

} // namespace

Document commands_document(const CLI::App& program) {
    std::map<std::string, int> commands_with;
    int commands = 0;
    each(program, [&](const CLI::App& command) {
        commands += commands_below(command).empty();
        for (const CLI::Option* option : command.get_options())
            ++commands_with[text_of(*option)];
    });
    const auto everywhere = [&](const std::string& text) { return commands_with.at(text) >= commands; };
    Document document{"Commands", {{"Of every command", {}}}};
    Listing shared;
    for (const auto& [text, count] : commands_with)
        if (everywhere(text))
            shared.items.emplace_back(text);
    document.sections.front().blocks.emplace_back(std::move(shared));
    each(program, [&](const CLI::App& command) {
        std::string usage;
        for (const CLI::Option* option : command.get_options([](const CLI::Option* one) { return one->get_positional(); }))
            usage += option->get_required() ? " " + value_name(*option) : " [" + value_name(*option) + "]";
        Section& section = document.sections.emplace_back(Section{full_name(command), {}, command.get_parent()->get_parent() ? 3 : 2});
        section.blocks.emplace_back(fmt::format("{}{}: {}", full_name(command), usage, command.get_description()));
        if (!command.get_footer().empty())
            section.blocks.emplace_back(command.get_footer());
        Listing options;
        for (const CLI::Option* option : command.get_options())
            if (const std::string text = text_of(*option); !everywhere(text))
                options.items.emplace_back(text);
        if (!options.items.empty())
            section.blocks.emplace_back(std::move(options));
    });
    return document;
}

Document exit_codes_document() {
    Listing codes;
    for (const ExitMeaning& one : exit_meanings)
        codes.items.emplace_back(fmt::format("**{}**: {}", static_cast<int>(one.code), one.meaning));
    return {"Exit codes", {{"", {std::move(codes)}}}};
}

} // namespace fernlicht
