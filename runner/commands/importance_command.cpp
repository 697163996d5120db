#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/importance/importance_run.h"
#include "runner/files/page_link.h"
#include "runner/write/document.h"
#include "scenarios/values/files.h"
#include "scenarios/yaml/library_file.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct ImportanceFlags {
    std::filesystem::path drive, recipe;
    std::string reading, rating, row, photometer, lamp_set, road, frames, out;
    std::vector<std::string> lamps;
    int trials = 20;
    std::uint64_t seed = 1;
    const OutputFormat* tables = nullptr;
};

int tell_importance(const ImportanceFlags& flags, const std::vector<std::string>& command) {
    if (flags.reading.empty() && flags.rating.empty())
        throw InputError({{}, 0, 0, "--reading"}, "is missing", "a reading, or a row of a rating (--rating, --row)");
    if (!flags.rating.empty() && !flags.recipe.empty())
        refuse_flag("--recipe", "it with --rating", "lamp files that need none");
    ImportanceRequest request;
    if (flags.rating.empty()) {
        DriveEdits edits;
        edits.lamps = lamps_of(flags.lamps);
        edits.lamp_recipe = flags.recipe;
        if (!flags.road.empty())
            edits.road = flags.road;
        request.drive = read_drive(named_file("drive", flags.drive, "DRIVE"), edits);
    } else
        request.row = {read_rating(library_file("rating", flags.rating, "", {{}, 0, 0, "--rating"})), flags.row, flags.photometer,
                       flags.drive};
    request.lamp_set = flags.lamp_set;
    request.reading = flags.reading;
    request.ticks = tick_range(flags.frames);
    request.check = flags.trials;
    request.seed = flags.seed;
    request.folder = result_folder(flags.out, (request.row ? request.row->rating.name : request.drive.name) + "-importance");
    request.command = command;
    request.write = [&request, &flags](const ImportanceResult& result) {
        write_file(request.folder / "importance.json", json_text(as_json(result, importance_members)));
        write_file(request.folder / "importance.csv", importance_csv(result));
        if (const std::string exr = importance_exr(result); !exr.empty())
            write_file(request.folder / "importance.exr", exr);
        write_document(document(result), result, request.folder, "report", flags.tables);
    };
    const ImportanceResult result = run_importance(request);
    fmt::print("{}\n{}\n", document_text(document(result)), page_link(request.folder / "report.html"));
    return result.value.number() && agrees(result) ? 0 : 1;
}

} // namespace

void add_importance_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<ImportanceFlags>();
    CLI::App* sub = app.add_subcommand("importance", "find where in the beam a reading of a drive is decided");
    add_shared(*sub, "DRIVE", flags->drive)->required();
    CLI::Option* const reading =
        sub->add_option("--reading", flags->reading, fmt::format("one of {}", importance_readings))->option_text("READING");
    CLI::Option* const rating = add_shared(*sub, "--rating", flags->rating)->excludes(reading);
    sub->add_option("--row", flags->row, "row of the rating, whose drive is played")->option_text("ROW")->needs(rating);
    sub->add_option("--photometer", flags->photometer, "look at this photometer of the row alone")->option_text("NAME")->needs(rating);
    add_shared(*sub, "--lamp-set", flags->lamp_set)->default_str("the first");
    add_shared(*sub, "--lamp", flags->lamps)->excludes(rating);
    add_recipe_flag(*sub, flags->recipe);
    add_shared(*sub, "--road", flags->road)->excludes(rating);
    add_shared(*sub, "--frames", flags->frames)->excludes(rating);
    sub->add_option("--trials", flags->trials, "smooth random changes of the lamps with which the drive is read again; 0: none")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    add_seed_flag(*sub, flags->seed);
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    sub->footer(
        fmt::format("With --rating, the margin of a row in place of a reading; DRIVE is then a file of lamp sets or a drive that has "
                    "them. Ours are {}. Exit code 1 where the reading is not measured, or the smallest changes are not foretold. "
                    "docs/importance.md tells more.",
                    fmt::join(library_names("rating"), ", ")));
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return tell_importance(*flags, command); }; });
}

} // namespace fernlicht
