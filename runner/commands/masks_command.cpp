#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/masks/masks_run.h"
#include "runner/files/page_link.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/yaml/library_file.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct MasksFlags {
    std::filesystem::path drive;
    std::string lamps, full_light = "high", rating = "adb-track", out;
    std::vector<std::string> margins{"0,0.25,0.5,1,1.5,2"};
    const OutputFormat* tables = nullptr;
};

std::vector<double> margins_of(const std::vector<std::string>& lists) {
    constexpr double most_deg = 10.0;
    constexpr std::size_t most_margins = 20;
    std::vector<double> margins;
    for (const std::string& item : items_of("--margins", lists)) {
        double deg = -1.0;
        const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), deg);
        if (error != std::errc{} || end != item.data() + item.size() || !(deg >= 0.0 && deg <= most_deg))
            refuse_flag("--margins", item, "degrees from 0 to 10");
        margins.push_back(deg);
    }
    if (margins.size() > most_margins)
        refuse_flag("--margins", fmt::format("{} margins", margins.size()), "at most 20");
    return margins;
}

int tell_masks(const MasksFlags& flags, const std::vector<std::string>& command) {
    MasksRequest request;
    DriveEdits edits;
    if (!flags.lamps.empty())
        edits.lamp_sets = flags.lamps;
    request.margins_deg = margins_of(flags.margins);
    request.drive = read_drive(named_file("drive", flags.drive, "DRIVE"), edits);
    request.limits = read_rating(library_file("rating", flags.rating, "", {{}, 0, 0, "--rating"}));
    request.against = flags.full_light;
    request.folder = result_folder(flags.out, request.drive.name + "-masks");
    request.command = command;
    request.write = [&request, &flags](const MasksFound& found) {
        write_file(request.folder / "masks.json", json_text(as_json(found, masks_members)));
        write_file(request.folder / "masks.csv", masks_csv(found));
        write_file(request.folder / "moments.csv", masks_moments_csv(found));
        write_document(document(found), found, request.folder, "report", flags.tables);
    };
    const MasksFound found = run_masks(request);
    fmt::print("{}\n{}\n", document_text(document(found)), page_link(request.folder / "report.html"));
    return 0;
}

} // namespace

void add_masks_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<MasksFlags>();
    CLI::App* sub = app.add_subcommand("masks", "weigh what masks of an adaptive beam cost the driver against what they spare others");
    add_shared(*sub, "DRIVE", flags->drive)->required();
    sub->add_option("--margins", flags->margins, "margins of the masks that are tried, in degrees, beside the lamp sets' own")
        ->option_text("DEG,...")
        ->allow_extra_args(false)
        ->default_str(flags->margins.front());
    sub->add_option("--full-light", flags->full_light, "lamp set whose light counts as full")->option_text("NAME")->capture_default_str();
    add_shared(*sub, "--lamps", flags->lamps);
    add_shared(*sub, "--rating", flags->rating)->capture_default_str();
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    sub->footer("The rating's photometers and limits hold for others. docs/pixel-lamps.md tells more.");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return tell_masks(*flags, command); }; });
}

} // namespace fernlicht
