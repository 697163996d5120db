#include "runner/commands/commands.h"

#include "metrics/readings/reading_words.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {

void add_readings_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto markdown = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("readings", "list what is read of a drive: names, units, which way is better, definitions");
    command->add_flag("--markdown", *markdown, "prints the table of docs/readings.md");
    command->callback([markdown, &chosen] {
        chosen = [markdown] {
            fmt::print("{}", *markdown ? readings_markdown() : readings_text());
            return 0;
        };
    });
}

} // namespace fernlicht
