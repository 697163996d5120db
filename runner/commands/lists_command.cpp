// Commands that list what there is: techniques, readings, signals.
#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/findings/lists.h"
#include "runner/write/document.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// A command that prints a document in the form asked for, or its JSON where it has one.
void add_list(CLI::App& app, std::function<int()>& chosen, const char* name, const char* about, Document (*list)(), std::string (*json)()) {
    struct Form {
        bool json = false;
        const OutputFormat* printed = nullptr;
    };
    const auto form = std::make_shared<Form>();
    CLI::App* command = app.add_subcommand(name, about);
    std::vector<CLI::Option*> others;
    if (json)
        others.push_back(command->add_flag("--json", form->json, "print JSON"));
    add_print_flags(*command, form->printed, others);
    command->callback([form, list, json, &chosen] {
        chosen = [form, list, json] {
            fmt::print("{}", form->json ? json() : (form->printed ? form->printed->of_document : document_text)(list()));
            return 0;
        };
    });
}

} // namespace

void add_techniques_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    add_list(
        app, chosen, "techniques", "list techniques and shadow methods: what each computes and ignores",
        [] { return techniques_document(techniques(), shadow_method_names()); },
        [] { return techniques_json(techniques(), shadow_method_names()); });
}

void add_readings_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    add_list(app, chosen, "readings", "list what is read of a drive: names, units, which way is better, definitions", readings_document,
             nullptr);
}

void add_signals_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    add_list(app, chosen, "signals", "list the signals of lamp control: name, unit, range, who writes them, and whether a CAN bus may",
             signals_document, signals_json);
}

} // namespace fernlicht
