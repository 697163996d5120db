#include "runner/commands/can/can_command.h"

#include "runner/commands/commands.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <vector>

namespace fernlicht {

void add_can_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    CLI::App* can = app.add_subcommand("can", "tools for candump logs of a CAN bus");
    can->require_subcommand(0, 1);
    add_can_merge(*can, chosen);
    add_can_cut(*can, chosen);
    add_can_convert(*can, chosen);
    add_can_decode(*can, chosen);
    add_can_record(*can, chosen);
    can->allow_extras(); // behind the tools, which would inherit it; told here, with the tool that may have been meant
    can->callback([can, &chosen] {
        if (!can->get_subcommands().empty() && can->remaining().empty())
            return;
        std::vector<std::string> tools;
        for (const CLI::App* tool : can->get_subcommands([](const CLI::App*) { return true; }))
            tools.push_back(tool->get_name());
        chosen = [word = can->remaining().empty() ? std::string() : can->remaining().front(), tools]() -> int {
            const std::string near = nearest_name(word, tools);
            throw InputError({}, word.empty() ? "found no tool behind can" : "found '" + printable(word) + "' behind can",
                             near.empty() ? fmt::format("one of {}", fmt::join(tools, ", ")) : fmt::format("a tool, {} perhaps", near));
        };
    });
}

} // namespace fernlicht
