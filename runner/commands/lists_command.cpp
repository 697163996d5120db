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

struct List {
    const char *name, *about;
    Document (*document)();
    std::string (*json)(); ///< nullptr: none
};

constexpr List lists[] = {
    {"techniques", "list techniques and shadow methods: what each computes and ignores",
     [] { return techniques_document(techniques(), shadow_method_names()); },
     [] { return techniques_json(techniques(), shadow_method_names()); }},
    {"readings", "list what is read of a drive: names, units, which way is better, definitions", readings_document, nullptr},
    {"signals", "list the signals of lamp control: name, unit, range, who writes them, and whether a CAN bus may", signals_document,
     signals_json}};

} // namespace

void add_list_commands(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    struct Form {
        bool json = false;
        const OutputFormat* printed = nullptr;
    };
    for (const List& list : lists) {
        const auto form = std::make_shared<Form>();
        CLI::App* command = app.add_subcommand(list.name, list.about);
        std::vector<CLI::Option*> others;
        if (list.json)
            others.push_back(command->add_flag("--json", form->json, "print JSON"));
        add_print_flags(*command, form->printed, others);
        command->callback([form, &list, &chosen] {
            chosen = [form, &list] {
                fmt::print("{}", form->json ? list.json() : (form->printed ? form->printed->of_document : document_text)(list.document()));
                return 0;
            };
        });
    }
}

} // namespace fernlicht
