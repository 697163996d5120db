#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/experiments/accuracy/studies/studies.h"
#include "runner/experiments/run/run_drives.h"
#include "runner/files/page_link.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct AccuracyFlags {
    std::vector<std::filesystem::path> drives;
    std::vector<std::string> techniques, resolutions, shadow_maps, beams;
    std::string lamp_set, target_error = "0.5%", backend = "auto", out;
    const OutputFormat* tables = nullptr;
    std::vector<std::string> diagrams{"techniques"};
    SweepRequest sweep;
    bool quiet = false;
};

std::vector<std::pair<int, int>> sizes_of(const char* flag, const std::vector<std::string>& texts, int most) {
    std::vector<std::pair<int, int>> sizes;
    for (const std::string& text : items_of(flag, texts)) {
        sizes.push_back(two_numbers(flag, text, 'x', false, "WIDTHxHEIGHT, e.g. 512x384"));
        if (std::min(sizes.back().first, sizes.back().second) < 16 || std::max(sizes.back().first, sizes.back().second) > most)
            refuse_flag(flag, text, "16 to 8192 each way");
    }
    return sizes;
}

std::vector<std::string> diagrams_of(const std::vector<std::string>& lists) {
    const std::vector<std::string> known = diagram_names(), asked = items_of("--diagrams", lists);
    for (const std::string& name : asked)
        if (name != "all" && std::ranges::find(known, name) == known.end())
            refuse_flag(
                "--diagrams", name,
                "all, techniques, reference, classical, solvers, control, extent, beam, weather, metrics, step, traffic or shadows");
    return std::ranges::find(asked, "all") != asked.end() ? known : asked;
}

int accuracy(const AccuracyFlags& flags, const std::vector<std::string>& command) {
    AccuracyRequest request;
    request.diagrams = diagrams_of(flags.diagrams);
    request.sweep = flags.sweep;
    request.sweep.lamp_set = flags.lamp_set;
    request.sweep.target_error = share_of("--target-error", flags.target_error);
    request.sweep.techniques = items_of("--techniques", flags.techniques);
    request.sweep.resolutions = sizes_of("--resolutions", flags.resolutions, 8192);
    request.sweep.shadow_maps = sizes_of("--shadow-maps", flags.shadow_maps, 8192);
    request.sweep.beams = beams_of(flags.beams);
    for (const std::filesystem::path& file : flags.drives)
        request.drives.push_back(read_drive(named_file("drive", file, "DRIVE")));
    refuse_equal_names(request.drives);
    request.backend = flags.backend;
    request.folder = result_folder(flags.out, "accuracy");
    request.command = command;
    request.quiet = flags.quiet;
    request.write = [&](const AccuracyResult& result) {
        write_file(request.folder / "accuracy.json", json_text(as_json(result, accuracy_members)));
        write_file(request.folder / "accuracy.csv", accuracy_csv(result));
        write_document(document(result), result, request.folder, "accuracy", flags.tables);
    };
    const AccuracyResult result = run_accuracy(request);
    fmt::print("{}\n{}\n", document_text(document(result)), page_link(request.folder / "accuracy.html"));
    if (!result.interrupted.empty())
        fmt::print("incomplete: {}\n", result.interrupted);
    for (const std::string& missing : result.missing)
        fmt::print("missing: {}\n", missing);
    const bool measured = std::ranges::any_of(result.diagrams, [](const WorkPrecision& diagram) {
        return std::ranges::any_of(diagram.rows, [](const WorkPrecisionRow& row) { return row.measured(); });
    });
    return result.interrupted.empty() && measured ? 0 : 1;
}

} // namespace

void add_accuracy_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<AccuracyFlags>();
    CLI::App* sub = app.add_subcommand("accuracy", "compare the techniques with the reference: error against run time");
    sub->add_option("DRIVE", flags->drives, "drive files (YAML)")->required();
    sub->add_option(
           "--diagrams", flags->diagrams,
           "all, or some of techniques, reference, classical, solvers, control, extent, beam, weather, metrics, step, traffic, shadows; "
           "else techniques")
        ->allow_extra_args(false);
    sub->add_option("--lamp-set", flags->lamp_set, "lamp set of the drives (default: the first of each)");
    sub->add_option("--techniques", flags->techniques, "comma-separated names (default: all)")->allow_extra_args(false);
    sub->add_option("--resolutions", flags->resolutions,
                    "WIDTHxHEIGHT,...: the first for all, the others varied (default: the drive's, a half and a quarter of it)")
        ->allow_extra_args(false);
    sub->add_option("--shadow-maps", flags->shadow_maps,
                    "WIDTHxHEIGHT,...: the first for all, the others varied (default: 1024x512, and twice, half and a quarter of it)")
        ->allow_extra_args(false);
    sub->add_option("--beams", flags->beams,
                    "float, eight-bit or WIDTHxHEIGHTxBITS,...: the first for all, the others varied (default: the drive's and four more)")
        ->allow_extra_args(false);
    sub->add_flag("--full", flags->sweep.full, "every technique with every resolution, shadow map and beam (default: vary one at a time)");
    sub->add_option("--count", flags->sweep.moments, "number of moments, spread evenly over the drive")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    sub->add_option("--rounds", flags->sweep.rounds, "number of timing rounds; in each, every configuration renders the moments once")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    sub->add_option("--target-error", flags->target_error, "target standard error of each reference pixel, e.g. 0.5% or 0.005")
        ->capture_default_str();
    sub->add_option("--max-samples", flags->sweep.max_samples, "maximum samples per reference pixel")
        ->check(CLI::Range(16, 1 << 20))
        ->capture_default_str();
    add_seed_flag(*sub, flags->sweep.seed, "seed of the reference and of the order in each round");
    sub->add_option("--backend", flags->backend, backend_names);
    sub->add_option("--out", flags->out, "new or empty folder for the results");
    add_tables_flag(*sub, flags->tables);
    sub->add_flag("--quiet", flags->quiet, "show no progress");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return accuracy(*flags, command); }; });
}

} // namespace fernlicht
