#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/fit/fit_run.h"
#include "runner/files/page_link.h"
#include "runner/write/document.h"
#include "scenarios/values/files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct FitFlags {
    std::filesystem::path drive, points, recipe;
    std::string lamp_set, road, out;
    std::vector<std::string> lamps, hold;
    const OutputFormat* tables = nullptr;
};

FitRequest request_of(const FitFlags& flags) {
    FitRequest request;
    DriveEdits edits;
    edits.lamps = lamps_of(flags.lamps);
    edits.lamp_recipe = flags.recipe;
    if (!flags.road.empty())
        edits.road = flags.road;
    request.hold = items_of("--hold", flags.hold);
    request.drive = read_drive(named_file("drive", flags.drive, "DRIVE"), edits);
    request.lamp_set = flags.lamp_set;
    request.points = flags.points;
    request.folder = result_folder(flags.out, request.drive.name + "-fit");
    return request;
}

int fit_points(const FitFlags& flags, const std::vector<std::string>& command) {
    FitRequest request = request_of(flags);
    request.command = command;
    request.write = [&request, &flags](const FitResult& result) {
        write_file(request.folder / "fit.json", json_text(as_json(result, fit_members)));
        write_file(request.folder / "fit.csv", fit_csv(result));
        write_file(request.folder / "fitted.yaml", write_drive(result.fitted_drive));
        write_document(document(result), result, request.folder, "report", flags.tables);
    };
    const FitResult result = run_fit(request);
    fmt::print("{}\n{}\n", document_text(document(result)), page_link(request.folder / "report.html"));
    return good(result) ? 0 : 1;
}

std::string column_help() {
    std::string text = "The points are a CSV file with the names of its columns in the first line:\n";
    for (const auto& [name, meaning] : lux_point_columns())
        text += fmt::format("  {:<20} {}\n", name, meaning);
    return text +
           "Exit code 1 where the residuals are larger than the uncertainties say, or nothing could be fitted. docs/fit.md tells more.";
}

} // namespace

void add_fit_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<FitFlags>();
    CLI::App* sub = app.add_subcommand("fit", "fit aim, flux and height of each lamp to measured lux points");
    add_shared(*sub, "DRIVE", flags->drive)->required();
    sub->add_option("--points", flags->points, "CSV file: place, direction, lux and uncertainty of each reading")
        ->option_text("FILE")
        ->required();
    add_shared(*sub, "--lamp-set", flags->lamp_set)->default_str("the first");
    sub->add_option("--hold", flags->hold, "keep the drive's value of pitch, yaw, flux or height, or of one lamp: left.height")
        ->option_text("NAME,...")
        ->allow_extra_args(false);
    add_shared(*sub, "--lamp", flags->lamps);
    add_recipe_flag(*sub, flags->recipe);
    add_shared(*sub, "--road", flags->road);
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    sub->footer(column_help());
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return fit_points(*flags, command); }; });
}

} // namespace fernlicht
