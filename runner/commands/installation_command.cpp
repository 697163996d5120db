#include "runner/commands/commands.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/installation/installation_run.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <sstream>

namespace fernlicht {
namespace {

struct InstallationFlags {
    std::filesystem::path drive, lamps;
    std::string lamp_set;
    std::vector<std::string> loads;
    bool json = false;
};

/// "NAME=FRONT_KG,REAR_KG"
LoadState load_of(const std::string& typed) {
    const std::size_t sign = typed.find('=');
    LoadState load{.name = typed.substr(0, sign)};
    char comma = 0;
    std::string rest;
    std::istringstream weights(sign == std::string::npos ? "" : typed.substr(sign + 1));
    const auto possible = [](double kg) { return kg >= -2000.0 && kg <= 5000.0; }; // as of a drive's `load`
    if (!(weights >> load.front_kg >> comma >> load.rear_kg) || comma != ',' || weights >> rest || load.name.empty() ||
        !possible(load.front_kg) || !possible(load.rear_kg))
        throw InputError({{}, 0, 0, "--load"}, "found '" + printable(typed) + "'",
                         "NAME=KG_ON_FRONT_AXLE,KG_ON_REAR_AXLE, each from -2000 to 5000");
    return load;
}

int tell_installation(const InstallationFlags& flags) {
    DriveEdits edits;
    if (!flags.lamps.empty())
        edits.lamp_sets = flags.lamps;
    InstallationRequest request;
    for (const std::string& load : flags.loads)
        request.loads.push_back(load_of(load));
    request.drive = read_drive(named_file("drive", flags.drive, "DRIVE"), edits);
    request.lamp_set = flags.lamp_set;
    const InstallationFound found = run_installation(request);
    fmt::print("{}", flags.json ? installation_json(found) : document_text(document(found)));
    return found.good() ? 0 : 1;
}

} // namespace

void add_installation_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto flags = std::make_shared<InstallationFlags>();
    CLI::App* sub =
        app.add_subcommand("installation", "hold a drive's low beams against UN R48: inclination under loads, bend light's kink");
    add_shared(*sub, "DRIVE", flags->drive)->required();
    add_shared(*sub, "--lamps", flags->lamps);
    add_shared(*sub, "--lamp-set", flags->lamp_set)->default_str("the first");
    sub->add_option("--load", flags->loads,
                    "a load beyond the car with its driver, in place of R48's states for a usual car and of the drive's own `load`")
        ->option_text("NAME=FRONT_KG,REAR_KG")
        ->allow_extra_args(false);
    add_shared(*sub, "--json", flags->json);
    sub->footer("Exit code 1 where something is not met or not measured. docs/regulations.md tells more.");
    sub->callback([flags, &chosen] { chosen = [flags] { return tell_installation(*flags); }; });
}

} // namespace fernlicht
