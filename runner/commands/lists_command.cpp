// Commands that list what there is: techniques, readings, signals.
#include "runner/commands/commands.h"

#include "metrics/readings/reading_labels.h"
#include "runner/findings/technique_list.h"
#include "scenarios/control/signals.h"
#include "scenarios/drives/keys/bus_keys.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

void print_signals() {
    std::size_t longest = 0;
    for (const SignalKind& kind : known_signals())
        longest = std::max(longest, kind.name.size());
    for (const SignalKind& kind : known_signals())
        fmt::print("{:{}}  {:<7} {:>8} to {:<8} {:<10} {:<4} {}\n", kind.name, longest, kind.unit, fmt::format("{:g}", kind.least),
                   fmt::format("{:g}", kind.greatest), kind.writer, may_come_from_bus(kind) ? "bus" : "", kind.meaning);
}

void print_signals_json() {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const SignalKind& kind : known_signals()) {
        nlohmann::ordered_json one{{"name", kind.name}, {"unit", kind.unit}, {"least", kind.least}};
        one["greatest"] = std::isfinite(kind.greatest) ? nlohmann::ordered_json(kind.greatest) : nlohmann::ordered_json("inf");
        one["written_by"] = kind.writer;
        one["from_bus"] = may_come_from_bus(kind);
        one["meaning"] = kind.meaning;
        all.push_back(std::move(one));
    }
    fmt::print("{}\n", all.dump(2));
}

} // namespace

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

void add_signals_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto json = std::make_shared<bool>(false);
    CLI::App* command =
        app.add_subcommand("signals", "list the signals of lamp control: name, unit, range, who writes them, and whether a CAN bus may");
    command->add_flag("--json", *json, "print JSON");
    command->callback([json, &chosen] {
        chosen = [json] {
            *json ? print_signals_json() : print_signals();
            return 0;
        };
    });
}

} // namespace fernlicht
