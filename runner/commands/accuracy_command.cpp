#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/accuracy/studies/studies.h"
#include "runner/experiments/run/run_drives.h"
#include "runner/files/log.h"
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
        tell(LogLevel::warning, "incomplete: " + result.interrupted);
    for (const std::string& missing : result.missing)
        tell(LogLevel::warning, "missing: " + missing);
    const bool measured = std::ranges::any_of(result.diagrams, [](const WorkPrecision& diagram) {
        return std::ranges::any_of(diagram.rows, [](const WorkPrecisionRow& row) { return row.measured(); });
    });
    return result.interrupted.empty() && measured ? 0 : 1;
}

} // namespace

void add_accuracy_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<AccuracyFlags>();
    CLI::App* sub = app.add_subcommand("accuracy", "compare the techniques with the reference: error against run time");
    add_shared(*sub, "DRIVES", flags->drives)->required();
    sub->add_option("--diagrams", flags->diagrams,
                    "diagrams to draw: techniques, reference, classical, solvers, control, extent, beam, weather, metrics, step, traffic, "
                    "shadows, or all")
        ->option_text("NAME,...")
        ->allow_extra_args(false)
        ->default_str("techniques");
    add_shared(*sub, "--lamp-set", flags->lamp_set)->default_str("the first");
    add_shared(*sub, "--techniques", flags->techniques)->default_str("all");
    sub->add_option("--resolutions", flags->resolutions, "sizes of the pictures")
        ->option_text("WIDTHxHEIGHT,...")
        ->allow_extra_args(false)
        ->default_str("the drive's, a half and a quarter of it");
    sub->add_option("--shadow-maps", flags->shadow_maps, "texels of each shadow map")
        ->option_text("WIDTHxHEIGHT,...")
        ->allow_extra_args(false)
        ->default_str("1024x512, and twice, half and a quarter of it");
    add_shared(*sub, "--beams", flags->beams)->default_str("the drive's and four more");
    sub->add_flag("--full", flags->sweep.full, "take every technique with every resolution, shadow map and beam, not one at a time");
    add_shared(*sub, "--count", flags->sweep.moments)->check(CLI::Range(1, 1000))->capture_default_str();
    add_shared(*sub, "--rounds", flags->sweep.rounds)->check(CLI::Range(1, 100000))->capture_default_str();
    add_shared(*sub, "--target-error", flags->target_error)->capture_default_str();
    add_shared(*sub, "--max-samples", flags->sweep.max_samples)->check(CLI::Range(16, 1 << 20))->capture_default_str();
    add_seed_flag(*sub, flags->sweep.seed);
    add_shared(*sub, "--backend", flags->backend);
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    add_shared(*sub, "--quiet", flags->quiet);
    sub->footer("Everything is rendered with the first of --resolutions, --shadow-maps and --beams, then with each other one in its place. "
                "docs/accuracy.md tells more.");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return accuracy(*flags, command); }; });
}

} // namespace fernlicht
