#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/improve/improve_run.h"
#include "runner/experiments/study/study_run.h"
#include "runner/files/page_link.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct ImproveFlags {
    std::filesystem::path lamp, recipe, study;
    std::vector<std::filesystem::path> drives;
    std::vector<std::string> gains, kept, kept_rows, only;
    std::string frames, out, regulation, as = "ies";
    std::optional<double> change_percent, change_cd, flux_percent, steepness, floor_cd;
    bool left_hand_traffic = false;
    double narrowest_deg = 1.0;
    const OutputFormat* tables = nullptr;
};

std::vector<NamedDrive> named_drives(const ImproveFlags& flags, const std::filesystem::path& lamp) {
    std::vector<NamedDrive> drives;
    for (const std::filesystem::path& file : flags.drives) {
        DriveEdits edits;
        edits.lamps = {{"", lamp}};
        edits.lamp_recipe = lamp == flags.lamp ? flags.recipe : "";
        Drive drive = read_drive(file, edits);
        const std::string name = drive.name;
        drives.push_back({name, std::move(drive)});
    }
    return drives;
}

/// The study's cells that have the lamp on both sides, in right-hand traffic and by the study's first technique.
std::vector<NamedDrive> named_cells(const ImproveFlags& flags, const std::filesystem::path& lamp) {
    Study study = read_study(flags.study);
    std::vector<bool> has(study.lamps.size());
    for (std::size_t i = 0; i < study.lamps.size(); ++i) {
        StudyLamp& one = study.lamps[i];
        std::error_code ignored;
        has[i] = std::filesystem::equivalent(one.left, flags.lamp, ignored) && std::filesystem::equivalent(one.right, flags.lamp, ignored);
        if (has[i])
            one.left = one.right = lamp;
    }
    std::vector<NamedDrive> drives;
    for (const StudyCell& cell : chosen_cells(study, items_of("--only", flags.only)))
        if (has[cell.lamp] && cell.technique == 0 && !study.conditions.mirror[cell.mirror])
            drives.push_back({cell.name, cell_drive(study, cell)});
    if (drives.empty())
        throw InputError({flags.study, 0, 0, {}}, "has no cell with this lamp as both low beams", flags.lamp.string() + " among its lamps");
    return drives;
}

int tell_improvement(const ImproveFlags& flags, const std::vector<std::string>& command) {
    if (flags.drives.empty() == flags.study.empty())
        refuse_flag("--drive", flags.study.empty() ? "neither --drive nor --cells-of" : "both --drive and --cells-of", "one of them");
    if (flags.gains.empty())
        refuse_flag("--gain", "none", "at least one reading to be gained");
    ImproveRequest request;
    request.lamp = flags.lamp;
    request.lamp_options.recipe = flags.recipe;
    request.extension = "." + flags.as;
    request.drives = [&flags](const std::filesystem::path& lamp) {
        return flags.study.empty() ? named_drives(flags, lamp) : named_cells(flags, lamp);
    };
    for (const std::string& gain : flags.gains)
        request.demands.push_back(gain_of(gain));
    for (const std::string& kept : flags.kept)
        request.demands.push_back(kept_of(kept));
    request.ticks = tick_range(flags.frames);
    if (flags.change_percent)
        request.limits.change_share = 0.01 * *flags.change_percent;
    request.limits.change_cd = flags.change_cd;
    if (flags.flux_percent)
        request.limits.flux_share = 0.01 * *flags.flux_percent;
    request.limits.steepness = flags.steepness;
    request.regulation = flags.regulation;
    request.kept_rows = flags.kept_rows;
    if (flags.regulation.empty() && !flags.kept_rows.empty())
        refuse_flag("--keep-row", flags.kept_rows.front(), "--regulation, whose row it is");
    request.left_hand_traffic = flags.left_hand_traffic;
    request.floor_cd = flags.floor_cd;
    request.narrowest_deg = flags.narrowest_deg;
    request.folder = result_folder(flags.out, flags.lamp.stem().string() + "-improve");
    request.command = command;
    request.write = [&request, &flags](const ImproveResult& result) {
        write_file(request.folder / "improve.json", json_text(as_json(result, improve_members)));
        write_document(document(result), result, request.folder, "report", flags.tables);
    };
    const ImproveResult result = run_improve(request);
    fmt::print("{}\n{}\n{}\n", document_text(document(result)), (request.folder / result.written).string(),
               page_link(request.folder / "report.html"));
    return improved(result) ? 0 : 1;
}

} // namespace

void add_improve_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<ImproveFlags>();
    CLI::App* sub = app.add_subcommand("improve", "find the smallest change of a lamp that gains what is asked of readings");
    sub->add_option("LAMP", flags->lamp, "lamp file, low beams on both sides of every drive")->required();
    sub->add_option("--drive", flags->drives, "drive to play (YAML)")->option_text("DRIVE")->allow_extra_args(false);
    sub->add_option("--cells-of", flags->study, "in place of --drive: the cells of this study that have the lamp")->option_text("STUDY");
    add_shared(*sub, "--only", flags->only);
    sub->add_option("--gain", flags->gains,
                    "'[DRIVE:]READING by AMOUNT', in its unit or %, for the better; a reading that `importance` explains")
        ->option_text("GAIN")
        ->allow_extra_args(false);
    sub->add_option("--keep", flags->kept, "'[DRIVE:]READING' that gets no worse, 'READING within AMOUNT', 'READING at least|most FIGURE'")
        ->option_text("BOUND")
        ->allow_extra_args(false);
    add_shared(*sub, "--regulation", flags->regulation);
    sub->add_option("--keep-row", flags->kept_rows, "row of the regulation that gets no worse, such as 'zone III'")
        ->option_text("ROW")
        ->allow_extra_args(false);
    add_shared(*sub, "--left-hand-traffic", flags->left_hand_traffic);
    sub->add_option("--max-change", flags->change_percent, "the most that a sample may change, per cent of it")
        ->option_text("PERCENT")
        ->check(CLI::Range(0.1, 1e4));
    sub->add_option("--max-change-cd", flags->change_cd, "the most that a sample may change, candela")
        ->option_text("CD")
        ->check(CLI::Range(0.1, 1e6));
    sub->add_option("--max-flux", flags->flux_percent, "the most that the flux may grow, per cent; may be negative")
        ->option_text("PERCENT")
        ->check(CLI::Range(-90.0, 1000.0));
    sub->add_option("--max-steepness", flags->steepness, "let the steepest place between samples become at most N times as steep")
        ->check(CLI::Range(1.0, 100.0));
    sub->add_option("--floor-cd", flags->floor_cd, "candela that a change counts against beside the light that is there")
        ->option_text("CD")
        ->check(CLI::Range(1.0, 1e6))
        ->default_str("0.1 % of the peak");
    sub->add_option("--narrowest", flags->narrowest_deg,
                    "degrees of H, half of it in V: narrower bends of the change count more than its size")
        ->option_text("DEG")
        ->check(CLI::Range(0.2, 10.0))
        ->capture_default_str();
    sub->add_option("--as", flags->as, "format of the lamp that is written")->check(CLI::IsMember({"ies", "csv"}))->capture_default_str();
    add_recipe_flag(*sub, flags->recipe);
    add_shared(*sub, "--frames", flags->frames);
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    sub->footer(
        "With --regulation its rows get no worse than it allows. Exit code 1 where not all that was asked is met. docs/improve.md tells "
        "more.");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return tell_improvement(*flags, command); }; });
}

} // namespace fernlicht
