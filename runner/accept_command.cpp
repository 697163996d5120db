#include "runner/accept_command.h"

#include "runner/checked_json.h"
#include "runner/output_folder.h"
#include "runner/reference_store.h"
#include "runner/summary.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

RunContext context_of(const CheckedJson& report) {
    const CheckedJson json = report.at("context");
    RunContext context;
    context.backend = json.at("backend").text();
    context.gl_renderer = json.at("gl_renderer").text();
    context.cpu = json.at("cpu").text();
    return context;
}

Reading reading_of(const CheckedJson& row) {
    const CheckedJson frame = row.at("frame");
    return {row.at("name").text(), row.at("value").number_or_null(), row.at("unit").text(), "", frame.is_null() ? -1 : frame.whole(), ""};
}

/// A frame's file: below the run's folder, wherever a report of others would lead.
std::filesystem::path frame_file(const std::filesystem::path& run_folder, const CheckedJson& exr) {
    const std::filesystem::path path = exr.text();
    if (path.is_absolute() || std::ranges::find(path, std::filesystem::path("..")) != path.end())
        exr.refuse("a path below the run's folder");
    return run_folder / path;
}

/// Key and frames of each lamp set that was played.
AcceptedReference reference_of(const CheckedJson& played, const RunContext& context, const std::filesystem::path& run_folder) {
    if (const CheckedJson done = played.at("ticks_done"); done.whole() != played.at("ticks_planned").whole())
        done.refuse("all moments that were planned: an incomplete run is no reference");
    AcceptedReference reference;
    reference.key = reference_key(played.at("drive").text(), played.at("variant").text(), played.at("technique").text(), context);
    for (const CheckedJson& frame : played.at("frames").items())
        if (const CheckedJson exr = frame.at("exr"); !exr.is_null())
            reference.frames.push_back({frame.at("frame").whole(), frame.at("view").text(), frame_file(run_folder, exr)});
    return reference;
}

/// Rows tell drive and lamp set by name.
void add_row(std::vector<AcceptedReference>& references, const CheckedJson& row) {
    const std::string drive = row.at("drive").text(), variant = row.at("variant").text();
    for (AcceptedReference& reference : references)
        if (reference.key.drive == drive && reference.key.variant == variant)
            if (Reading reading = reading_of(row); !is_of_time(reading))
                reference.readings.push_back(std::move(reading));
}

} // namespace

Accepted accept_run(const std::filesystem::path& run_folder, const std::filesystem::path& references_folder) {
    if (is_marked_incomplete(run_folder))
        throw InputError({run_folder, 0, 0, {}}, "holds an incomplete run", "a complete one");
    const CheckedJson report = CheckedJson::read(run_folder / "report.json");
    report.expect_schema("fernlicht report", 1);
    if (const CheckedJson complete = report.at("complete"); !complete.truth())
        complete.refuse("a complete run");
    const RunContext context = context_of(report);
    std::vector<AcceptedReference> references;
    for (const CheckedJson& played : report.at("drives").items())
        references.push_back(reference_of(played, context, run_folder));
    for (const CheckedJson& row : report.at("rows").items())
        add_row(references, row);
    store_references(references_folder, references);
    Accepted accepted;
    accepted.drives = references.size();
    for (const AcceptedReference& reference : references) {
        accepted.frames += reference.frames.size();
        accepted.readings += reference.readings.size();
    }
    return accepted;
}

void add_accept_command(CLI::App& app, std::function<int()>& chosen) {
    struct Flags {
        std::string run, to = "references";
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = app.add_subcommand("accept", "take a run's results as references for later runs; judges nothing");
    command->add_option("RUN", flags->run, "folder of a complete run")->required();
    command->add_option("--to", flags->to, "folder of references")->capture_default_str();
    command->callback([flags, &chosen] {
        chosen = [flags] {
            const Accepted accepted = accept_run(flags->run, flags->to);
            fmt::print("accepted into {}: {} lamp sets with {} frames and {} readings\n", flags->to, accepted.drives, accepted.frames,
                       accepted.readings);
            return 0;
        };
    });
}

} // namespace fernlicht
