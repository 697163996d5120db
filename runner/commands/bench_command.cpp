#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
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
    add_shared(*sub, "DRIVE", flags->drive)->default_str("bench");
    add_shared(*sub, "--lamp-set", flags->lamp_set)->default_str("the first");
    add_shared(*sub, "--techniques", flags->techniques)->default_str("all");
    add_shared(*sub, "--count", flags->count)->default_str(fmt::format("{}, or all of a shorter drive", default_bench_moments));
    add_shared(*sub, "--rounds", flags->rounds)->capture_default_str();
    add_seed_flag(*sub, flags->seed);
    add_shared(*sub, "--resolution", flags->resolution)->default_str("the drive's");
    add_shared(*sub, "--backend", flags->backend);
    add_light_pass_flag(*sub, flags->light_pass);
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    add_shared(*sub, "--quiet", flags->quiet);
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return bench(*flags, command); }; });
}

} // namespace fernlicht
