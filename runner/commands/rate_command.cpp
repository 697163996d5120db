#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/rating/rating_run.h"
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
struct RateFlags {
    std::string rating, lamp_set, out;
    std::filesystem::path lamps;
    const OutputFormat* tables = nullptr;
};

int tell_rating(const RateFlags& flags, const std::vector<std::string>& command) {
    RatingRequest request;
    request.rating = read_rating(library_file("rating", flags.rating, "", {{}, 0, 0, "RATING"}));
    request.lamps = flags.lamps;
    request.lamp_set = flags.lamp_set;
    request.folder = result_folder(flags.out, request.rating.name);
    request.command = command;
    request.write = [&request, &flags](const RatingFound& found) {
        write_file(request.folder / "rating.json", json_text(as_json(found, rating_members)));
        write_file(request.folder / "rating.csv", rating_csv(found));
        write_file(request.folder / "light.csv", light_csv(found));
        write_document(document(found), found, request.folder, "report", flags.tables);
    };
    const RatingFound found = run_rating(request);
    fmt::print("{}\n{}\n", document_text(document(found)), page_link(request.folder / "report.html"));
    return all_within(found) ? 0 : 1;
}

} // namespace

void add_rate_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<RateFlags>();
    CLI::App* sub = app.add_subcommand("rate", "judge one lamp set by a rating: drives, limits over distance, points");
    sub->add_option("RATING", flags->rating, fmt::format("rating: a file (YAML), or {}", fmt::join(library_names("rating"), ", ")))
        ->required();
    add_shared(*sub, "--lamps", flags->lamps)->required();
    add_shared(*sub, "--lamp-set", flags->lamp_set)->default_str("the first");
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    sub->footer("Exit code 1 where a limit is exceeded or a row not measured. docs/ratings.md tells more.");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return tell_rating(*flags, command); }; });
}

} // namespace fernlicht
