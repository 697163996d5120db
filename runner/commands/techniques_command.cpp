#include "runner/commands/commands.h"

#include "runner/findings/technique_list.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {

void add_techniques_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    struct Form {
        bool json = false, markdown = false;
    };
    const auto form = std::make_shared<Form>();
    CLI::App* command = app.add_subcommand("techniques", "list techniques and shadow methods: what each computes and ignores");
    CLI::Option* json = command->add_flag("--json", form->json, "print JSON");
    command->add_flag("--markdown", form->markdown, "print docs/techniques.md")->excludes(json);
    command->callback([form, &chosen] {
        chosen = [form] {
            const auto list = form->json ? techniques_json : form->markdown ? techniques_markdown : techniques_text;
            fmt::print("{}", list(techniques(), shadow_method_names()));
            return 0;
        };
    });
}

} // namespace fernlicht
