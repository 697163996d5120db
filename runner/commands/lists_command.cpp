// Commands that list what there is: techniques, readings, signals.
#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/findings/lists.h"
#include "runner/write/document.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/drive.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

struct List {
    const char *name, *about;
    Document (*document)();
    std::string (*json)();
};

constexpr List lists[] = {
    {"techniques", "list techniques and shadow methods: what each computes and ignores",
     [] { return techniques_document(techniques(), shadow_method_names()); },
     [] { return techniques_json(techniques(), shadow_method_names()); }},
    {"readings", "list all readings: names, units, which way is better, definitions", readings_document, readings_json},
    {"signals", "list the signals of lamp control: name, unit, range, who writes them, and whether a CAN bus may", signals_document,
     signals_json}};

/// Of a drive, each law of each lamp set once, or of one file.
std::vector<ListedFmu> fmus_of(const std::filesystem::path& file) {
    if (file.extension() == ".fmu") {
        PluginParameters alone;
        alone.library = file;
        return {{file.filename().string(), fmu_ties(alone)}};
    }
    std::vector<ListedFmu> fmus;
    std::vector<PluginParameters> told;
    for (const LampSet& lamp_set : read_drive(named_file("drive", file, "FILE")).lamp_sets)
        for (const PluginParameters& plugin : lamp_set.control ? lamp_set.control->plugins : std::vector<PluginParameters>{})
            if (plugin.fmu && std::ranges::find(told, plugin) == told.end()) {
                told.push_back(plugin);
                fmus.push_back({fmt::format("{}, lamp set {}", plugin.library.filename().string(), lamp_set.name), fmu_ties(plugin)});
            }
    return fmus;
}

} // namespace

void add_list_commands(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    struct Form {
        bool json = false;
        const OutputFormat* printed = nullptr;
        std::filesystem::path file;
    };
    for (const List& list : lists) {
        const auto form = std::make_shared<Form>();
        CLI::App* command = app.add_subcommand(list.name, list.about);
        add_print_flags(*command, form->printed, {add_shared(*command, "--json", form->json)});
        if (list.document == signals_document)
            command->add_option("FILE", form->file,
                                "drive or FMU: list the variables of its FMUs instead, and what each is tied to (docs/control.md)");
        command->callback([form, &list, &chosen] {
            chosen = [form, &list] {
                const std::vector<ListedFmu> fmus = form->file.empty() ? std::vector<ListedFmu>{} : fmus_of(form->file);
                const auto text_of = form->printed ? form->printed->of_document : document_text;
                if (form->file.empty())
                    fmt::print("{}", form->json ? list.json() : text_of(list.document()));
                else if (fmus.empty() && !form->json)
                    fmt::print("{} has no FMU: its lamps move by built-in laws, or not at all\n", form->file.string());
                else
                    fmt::print("{}", form->json ? fmus_json(fmus) : text_of(fmus_document(fmus)));
                return 0;
            };
        });
    }
}

} // namespace fernlicht
