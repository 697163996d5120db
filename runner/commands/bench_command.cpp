#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/experiments/bench/bench_run.h"
#include "runner/files/page_link.h"
#include "runner/write/document.h"
#include "scenarios/values/files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct BenchFlags {
    std::filesystem::path drive = "bench";
    std::string lamp_set, resolution, backend = "auto", out;
    const OutputFormat* tables = nullptr;
    std::vector<std::string> techniques;
    std::optional<int> count;
    LightPass light_pass = LightPass::automatic;
    int rounds = 21;
    std::uint64_t seed = 1;
    bool quiet = false;
};

int bench(const BenchFlags& flags, const std::vector<std::string>& command) {
    if (flags.rounds < 1 || flags.rounds > 100000)
        refuse_flag("--rounds", fmt::format("{}", flags.rounds), "1 to 100000");
    DriveEdits edits;
    if (!flags.resolution.empty())
        edits.resolution = resolution_of(flags.resolution);
    BenchRequest request;
    request.drive = read_drive(named_file("drive", flags.drive, "DRIVE"), edits);
    request.lamp_set = flags.lamp_set;
    request.techniques = items_of("--techniques", flags.techniques);
    request.moments = flags.count;
    request.rounds = flags.rounds;
    request.seed = flags.seed;
    request.backend = flags.backend;
    request.light_pass = flags.light_pass;
    request.folder = result_folder(flags.out, "bench");
    request.command = command;
    request.quiet = flags.quiet;
    request.write = [&](const BenchResult& result) {
        write_file(request.folder / "bench.json", bench_json(result));
        write_file(request.folder / "bench.csv", bench_csv(result));
        write_document(document(result), result, request.folder, "bench", flags.tables);
    };
    request.write_plot = [&](const Plot& plot) { write_plot(plot, request.folder / plot.name); };
    const BenchResult result = run_bench(request);
    fmt::print("{}\n{}\n", document_text(document(result)), page_link(request.folder / "bench.html"));
    return result.interrupted.empty() ? 0 : 1;
}

} // namespace

void add_bench_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<BenchFlags>();
    CLI::App* sub = app.add_subcommand("bench", "time the techniques against one another");
    sub->add_option("DRIVE", flags->drive, "drive file (YAML) whose moments are rendered")->capture_default_str();
    sub->add_option("--lamp-set", flags->lamp_set, "lamp set of the drive (default: its first)");
    sub->add_option("--techniques", flags->techniques, "comma-separated names (default: all)")->allow_extra_args(false);
    sub->add_option(
        "--count", flags->count,
        fmt::format("number of moments, spread evenly over the drive (default: {}, or all of a shorter drive)", default_bench_moments));
    sub->add_option("--rounds", flags->rounds, "number of rounds; in each, every technique renders the moments once")
        ->capture_default_str();
    add_seed_flag(*sub, flags->seed, "seed of the order in each round");
    sub->add_option("--resolution", flags->resolution, "WIDTHxHEIGHT (default: the drive's)");
    sub->add_option("--backend", flags->backend, backend_names);
    add_light_pass_flag(*sub, flags->light_pass);
    sub->add_option("--out", flags->out, "new or empty folder for the results");
    add_tables_flag(*sub, flags->tables);
    sub->add_flag("--quiet", flags->quiet, "show no progress");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return bench(*flags, command); }; });
}

} // namespace fernlicht
